// Structured tetrahedral meshes for known answers: bricks of hexahedra and shells of prisms, cut into tetrahedra.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <algorithm>
#include <functional>
#include <map>
#include <vector>

#include <palpate/mesh_files.hpp>
#include <solver/implicit/model.hpp>

namespace palpate::verify {

using Eigen::Vector3d;

/// Turns tetrahedra of negative volume round.
inline void orient(implicit::Model& model) {
  for (auto& t : model.tets) {
    const auto& p = model.points;
    if ((p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).dot(p[t[3]] - p[t[0]]) < 0) std::swap(t[2], t[3]);
  }
}

/// Faces that belong to one tetrahedron, outward.
inline std::vector<std::array<int, 3>> boundary(const implicit::Model& model) {
  std::map<std::array<int, 3>, std::pair<int, std::array<int, 3>>> count;
  constexpr int local[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  for (const auto& t : model.tets)
    for (const auto& l : local) {
      const std::array<int, 3> face = {t[l[0]], t[l[1]], t[l[2]]};
      auto key = face;
      std::sort(key.begin(), key.end());
      auto& entry = count[key];
      ++entry.first;
      entry.second = face;
    }
  std::vector<std::array<int, 3>> faces;
  for (const auto& [key, entry] : count)
    if (entry.first == 1) faces.push_back(entry.second);
  return faces;
}

/// A brick with nodes at the given coordinates; each cell cut into six tetrahedra around its diagonal (Kuhn).
inline implicit::Model brick(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& z) {
  implicit::Model model;
  const int nx = x.size(), ny = y.size(), nz = z.size();
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) model.points.push_back({x[i], y[j], z[k]});
  const auto id = [&](int i, int j, int k) { return (k * ny + j) * nx + i; };
  constexpr int order[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  for (int k = 0; k + 1 < nz; ++k)
    for (int j = 0; j + 1 < ny; ++j)
      for (int i = 0; i + 1 < nx; ++i)
        for (const auto& path : order) {
          int at[3] = {i, j, k};
          std::array<int, 4> tet;
          tet[0] = id(i, j, k);
          for (int s = 0; s < 3; ++s) {
            ++at[path[s]];
            tet[s + 1] = id(at[0], at[1], at[2]);
          }
          model.tets.push_back(tet);
        }
  orient(model);
  model.faces = boundary(model);
  model.tet_material.assign(model.tets.size(), 0);
  return model;
}

/// As a file's mesh of one region, "block".
inline TetMesh mesh_of(const implicit::Model& model) {
  TetMesh mesh;
  for (const auto& p : model.points) mesh.points.push_back({p.x(), p.y(), p.z()});
  mesh.tets = model.tets;
  mesh.tet_region.assign(mesh.tets.size(), 1);
  mesh.faces = model.faces;
  mesh.face_region.assign(mesh.faces.size(), 1);
  mesh.region_names = {{1, "block"}};
  return mesh;
}

inline std::vector<double> uniform(double from, double to, int cells) {
  std::vector<double> x;
  for (int i = 0; i <= cells; ++i) x.push_back(from + (to - from) * i / cells);
  return x;
}

/// `fine` cells of equal size over [0, inner], then growing by a factor so that `coarse` more reach `outer`.
inline std::vector<double> graded(double inner, int fine, double outer, int coarse) {
  std::vector<double> x = uniform(0, inner, fine);
  const double first = inner / fine, length = outer - inner;
  double low = 1.0 + 1e-9, high = 10;
  for (int i = 0; i < 200; ++i) {  // first · (q + … + q^coarse) = length
    const double q = 0.5 * (low + high);
    (first * q * (std::pow(q, coarse) - 1) / (q - 1) < length ? low : high) = q;
  }
  double step = first, at = inner;
  for (int i = 0; i < coarse; ++i) x.push_back(at += (step *= low));
  x.back() = outer;
  return x;
}

/// One eighth of a thick sphere: an octant of n × n triangles, `layers` radii; each prism cut into three tetrahedra.
inline implicit::Model thick_sphere_octant(double inner, double outer, int n, int layers) {
  implicit::Model model;
  std::map<std::pair<int, int>, int> of;
  std::vector<Vector3d> directions;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; i + j <= n; ++j) {
      of[{i, j}] = directions.size();
      directions.push_back(Vector3d(i, j, n - i - j).normalized());
    }
  std::vector<std::array<int, 3>> triangles;
  for (int i = 0; i < n; ++i)
    for (int j = 0; i + j < n; ++j) {
      triangles.push_back({of[{i, j}], of[{i + 1, j}], of[{i, j + 1}]});
      if (i + j + 1 < n) triangles.push_back({of[{i + 1, j}], of[{i + 1, j + 1}], of[{i, j + 1}]});
    }
  const int ring = directions.size();
  for (int l = 0; l <= layers; ++l)
    for (const auto& d : directions) model.points.push_back(inner * std::pow(outer / inner, double(l) / layers) * d);
  for (int l = 0; l < layers; ++l)
    for (auto t : triangles) {
      std::sort(t.begin(), t.end());  // the same diagonal on a shared side
      const int a = l * ring, b = a + ring;
      model.tets.push_back({a + t[0], a + t[1], a + t[2], b + t[2]});
      model.tets.push_back({a + t[0], a + t[1], b + t[1], b + t[2]});
      model.tets.push_back({a + t[0], b + t[0], b + t[1], b + t[2]});
    }
  orient(model);
  model.faces = boundary(model);
  model.tet_material.assign(model.tets.size(), 0);
  return model;
}

inline materials::Law law_named(const std::string& name) {
  for (const auto& law : materials::all())
    if (law.entry.name == name) return law;
  throw std::logic_error("no law " + name);
}

inline elements::Material material(const std::string& name, std::vector<double> parameters) {
  elements::Material m{law_named(name), std::move(parameters), 0};
  m.bulk_modulus = m.law.bulk_modulus(m.parameters);
  return m;
}

inline tools::Shape tool_named(const std::string& name) {
  for (const auto& tool : tools::all())
    if (tool.entry.name == name) return tool;
  throw std::logic_error("no tool " + name);
}

inline effects::Effect effect_named(const std::string& name) {
  for (const auto& effect : effects::all())
    if (effect.entry.name == name) return effect;
  throw std::logic_error("no effect " + name);
}

/// Coulomb's coefficient; infinite: what touches sticks.
inline void rub(contact::Tool& tool, double friction) {
  if (friction > 0) tool.tractions.push_back({effect_named("friction"), {friction}});
}

/// Holds a component of every node for which `where` is true.
inline void hold(implicit::Model& model, int component, const std::function<bool(const Vector3d&)>& where, double value = 0) {
  for (std::size_t i = 0; i < model.points.size(); ++i)
    if (where(model.points[i])) model.prescribed.push_back({int(i), component, value});
}

}  // namespace palpate::verify
