// Graded bricks, mapped onto a disc for the cylinder, cut into tetrahedra along one diagonal (Kuhn 1960).
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/shape_mesh.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace palpate::loop {
namespace {

/// From `middle` both ways to `low` and `high`: three even steps, then growing.
std::vector<double> graded(double low, double high, double middle, double fine) {
  std::vector<double> x = {middle};
  for (double sign : {-1.0, 1.0}) {
    const double end = sign < 0 ? low : high;
    std::vector<double> steps;
    double reached = 0, step = fine;
    for (int i = 0; reached < std::abs(end - middle) - 1e-9; ++i) {
      reached += step;
      steps.push_back(reached);
      if (i >= 2) step *= 1.4;
    }
    for (double s : steps) x.push_back(middle + sign * s * std::abs(end - middle) / steps.back());
  }
  std::sort(x.begin(), x.end());
  x.erase(std::unique(x.begin(), x.end(), [](double a, double b) { return std::abs(a - b) < 1e-9; }), x.end());
  return x;
}

/// Further steps on both sides, growing, until `half` each way.
void widen(std::vector<double>& x, double half) {
  if (x.back() >= half) return;
  const double last = x[x.size() - 1] - x[x.size() - 2], room = half - x.back();
  std::vector<double> out;
  double reached = 0;
  for (double step = 1.4 * last; reached < room; step *= 1.4) out.push_back(reached += step);
  std::vector<double> all;
  for (double o : out) all.insert(all.begin(), -half + room - o * room / reached);
  all.insert(all.end(), x.begin(), x.end());
  for (double o : out) all.push_back(half - room + o * room / reached);
  x = std::move(all);
}

/// The unit square onto the unit disc (Fong 2015: x √(1 − y²/2), y √(1 − x²/2)).
void onto_disc(double& x, double& y) {
  const double old = x;
  x *= std::sqrt(1 - y * y / 2);
  y *= std::sqrt(1 - old * old / 2);
}

/// Faces that belong to one tetrahedron only, outward.
void add_faces(TetMesh& mesh) {
  std::map<std::array<int, 3>, std::pair<int, std::array<int, 3>>> count;
  constexpr int corners[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  for (const auto& t : mesh.tets)
    for (const auto& c : corners) {
      const std::array<int, 3> face = {t[c[0]], t[c[1]], t[c[2]]};
      std::array<int, 3> key = face;
      std::sort(key.begin(), key.end());
      auto& entry = count[key];
      ++entry.first;
      entry.second = face;
    }
  for (const auto& [key, entry] : count) {
    if (entry.first != 1) continue;
    const bool base = std::all_of(key.begin(), key.end(), [&](int n) { return std::abs(mesh.points[n][2]) < 1e-9; });
    mesh.faces.push_back(entry.second);
    mesh.face_region.push_back(base ? 2 : 3);
  }
}

}  // namespace

TetMesh shape_mesh(const Specimen& specimen, const Vec3& place, double fine, double wide) {
  Vec3 half = 0.5 * specimen.size_mm;
  auto x = graded(-half[0], half[0], std::clamp(place[0], -0.9 * half[0], 0.9 * half[0]), fine);
  auto y = graded(-half[1], half[1], std::clamp(place[1], -0.9 * half[1], 0.9 * half[1]), fine);
  if (wide > 0) {
    widen(x, std::abs(place[0]) + wide);
    widen(y, std::abs(place[1]) + wide);
    half = {x.back(), y.back(), half[2]};
  }
  const auto z = graded(0, specimen.size_mm[2], specimen.size_mm[2], fine);
  TetMesh mesh;
  mesh.region_names = {{1, "specimen"}, {2, "base"}, {3, "outside"}};
  for (double c : z)
    for (double b : y)
      for (double a : x) {
        double u = a / half[0], v = b / half[1];
        if (specimen.shape == "cylinder") onto_disc(u, v);
        mesh.points.push_back({u * half[0], v * half[1], c});
      }
  const int nx = static_cast<int>(x.size()), ny = static_cast<int>(y.size()), nz = static_cast<int>(z.size());
  constexpr int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  const int stride[3] = {1, nx, nx * ny};
  for (int k = 0; k + 1 < nz; ++k)
    for (int j = 0; j + 1 < ny; ++j)
      for (int i = 0; i + 1 < nx; ++i)
        for (int o = 0; o < 6; ++o) {
          const int a = i + nx * (j + ny * k), b = a + stride[orders[o][0]], c = b + stride[orders[o][1]], d = c + stride[orders[o][2]];
          mesh.tets.push_back(o < 3 ? std::array<int, 4>{a, b, c, d} : std::array<int, 4>{a, c, b, d});
          mesh.tet_region.push_back(1);
        }
  add_faces(mesh);
  return mesh;
}

}  // namespace palpate::loop
