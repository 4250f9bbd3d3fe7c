// Filling by gmsh (Geuzaine & Remacle 2009): discrete surfaces, Delaunay tetrahedra, its own optimisation.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/mesh/fill.hpp>

#include <gmsh.h>

#include <algorithm>
#include <unordered_map>

#include <palpate/errors.hpp>
#include <pipeline/mesh/gmsh_session.hpp>

namespace palpate {
namespace {

void add_surface(const Surface& surface, const std::vector<Shell>& shells) {
  std::vector<bool> placed(surface.points.size(), false);
  for (int s = 0; s < shells.size(); ++s) {
    const int tag = s + 1;
    gmsh::model::addDiscreteEntity(2, tag);
    std::vector<std::size_t> nodes, triangles, corners;
    std::vector<double> coordinates;
    for (int t : shells[s].triangles) {
      triangles.push_back(t + 1);
      for (int i : surface.triangles[t]) {
        corners.push_back(i + 1);
        if (placed[i]) continue;
        placed[i] = true;
        nodes.push_back(i + 1);
        coordinates.insert(coordinates.end(), surface.points[i].begin(), surface.points[i].end());
      }
    }
    gmsh::model::mesh::addNodes(2, tag, nodes, coordinates);
    gmsh::model::mesh::addElementsByType(tag, 2, triangles, corners);
  }
}

void add_bodies(const std::vector<Shell>& shells, const std::vector<Body>& bodies) {
  for (int s = 0; s < shells.size(); ++s) gmsh::model::geo::addSurfaceLoop({s + 1}, s + 1);
  for (int b = 0; b < bodies.size(); ++b) {
    std::vector<int> loops = {bodies[b].outer + 1};
    for (int hole : bodies[b].holes) loops.push_back(hole + 1);
    gmsh::model::geo::addVolume(loops, b + 1);
  }
  gmsh::model::geo::synchronize();
}

/// Points of the surface keep their index; gmsh's own follow in order of their tag.
TetMesh collect(const Surface& surface, const std::vector<Body>& bodies) {
  TetMesh mesh;
  mesh.points = surface.points;
  std::unordered_map<std::size_t, int> index_of;
  for (int i = 0; i < surface.points.size(); ++i) index_of[i + 1] = i;
  std::vector<std::pair<std::size_t, Vec3>> inner;
  for (int b = 0; b < bodies.size(); ++b) {
    std::vector<std::size_t> tags;
    std::vector<double> xyz, parametric;
    gmsh::model::mesh::getNodes(tags, xyz, parametric, 3, b + 1);
    for (std::size_t n = 0; n < tags.size(); ++n) inner.push_back({tags[n], {xyz[3 * n], xyz[3 * n + 1], xyz[3 * n + 2]}});
  }
  std::sort(inner.begin(), inner.end());
  for (const auto& [tag, x] : inner) {
    index_of[tag] = static_cast<int>(mesh.points.size());
    mesh.points.push_back(x);
  }
  for (int b = 0; b < bodies.size(); ++b) {
    std::vector<std::size_t> tags, corners;
    gmsh::model::mesh::getElementsByType(4, tags, corners, b + 1);
    for (std::size_t t = 0; t < tags.size(); ++t) {
      std::array<int, 4> tet;
      for (int k = 0; k < 4; ++k) {
        const auto found = index_of.find(corners[4 * t + k]);
        if (found == index_of.end())
          throw Failure(ExitCode::check_failed, "gmsh had to change the surface to fill it", "", "a finer --edge, or palpate-surface with more smoothing");
        tet[k] = found->second;
      }
      mesh.tets.push_back(tet);
      mesh.tet_region.push_back(bodies[b].region);
    }
  }
  return mesh;
}

/// "…, intersection (2.9,-148.2,-1268.7)" → " (2.9,-148.2,-1268.7) mm"; empty when gmsh names no place.
std::string place_in(const std::string& words) {
  const std::string mark = "intersection (";
  const auto start = words.find(mark), end = words.find(')', start == std::string::npos ? 0 : start);
  if (start == std::string::npos || end == std::string::npos) return "";
  return "near " + words.substr(start + mark.size() - 1, end - start - mark.size() + 2) + " mm";
}

[[noreturn]] void fail(const std::vector<std::string>& errors, const std::string& thrown) {
  std::string words;
  for (const auto& line : errors) words += (words.empty() ? "" : "; ") + line;
  throw Failure(ExitCode::check_failed, "gmsh could not fill the surface: " + (words.empty() ? thrown : words), place_in(words),
                "a finer --edge where the organ is thin, or palpate-surface with more smoothing");
}

}  // namespace

Filling fill(const Surface& surface, const std::vector<Shell>& shells, const std::vector<Body>& bodies, const SizeField& sizes) {
  const GmshSession session;
  try {
    add_surface(surface, shells);
    add_bodies(shells, bodies);
    gmsh::model::mesh::setSizeCallback([&](int, int, double x, double y, double z) { return sizes.at({x, y, z}); });
    gmsh::model::mesh::generate(3);
    if (!session.lines("Error").empty()) fail(session.lines("Error"), "");
    gmsh::model::mesh::optimize("", true);
    gmsh::model::mesh::optimize("Relocate3D", false, 3);
    return {collect(surface, bodies), session.lines("Warning")};
  } catch (const Failure&) {
    throw;
  } catch (const std::exception& error) {
    fail(session.lines("Error"), error.what());
  } catch (const std::string& error) {
    fail(session.lines("Error"), error);
  } catch (int) {
    fail(session.lines("Error"), "it gave no reason");
  }
}

}  // namespace palpate
