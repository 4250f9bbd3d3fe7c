// Measures as in Knupp (2001) and the Verdict library's report (Stimpson et al. 2007), from plain vectors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/mesh/quality.hpp>

#include <algorithm>
#include <numbers>

namespace palpate {
namespace {

/// Edge (a, b) and the two other corners (c, d) of each of the six edges.
constexpr int edge_corners[6][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}};

/// Outward normal times twice the area of the face opposite each corner.
std::array<Vec3, 4> face_normals(const Corners& x) {
  return {cross(x[2] - x[1], x[3] - x[1]), cross(x[3] - x[0], x[2] - x[0]), cross(x[1] - x[0], x[3] - x[0]), cross(x[2] - x[0], x[1] - x[0])};
}

}  // namespace

Corners corners_of(const TetMesh& mesh, int tet) {
  const auto& t = mesh.tets[tet];
  return {mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]], mesh.points[t[3]]};
}

Vec3 centroid(const Corners& x) { return 0.25 * (x[0] + x[1] + x[2] + x[3]); }

double jacobian(const Corners& x) { return dot(x[1] - x[0], cross(x[2] - x[0], x[3] - x[0])); }

std::array<double, 6> dihedral_degrees(const Corners& x) {
  const auto n = face_normals(x);
  std::array<double, 6> angles;
  for (int e = 0; e < 6; ++e) {
    const Vec3 &p = n[edge_corners[e][2]], &q = n[edge_corners[e][3]];  // the faces that meet at the edge
    angles[e] = std::atan2(norm(cross(p, q)), -dot(p, q)) * 180 / std::numbers::pi;
  }
  return angles;
}

double smallest_dihedral_sine(const Corners& x) {
  // sin θ at an edge of length l between faces of area A1, A2:  3 V l / (2 A1 A2)
  const auto n = face_normals(x);
  const double six_volumes = jacobian(x);
  double areas[4], smallest = 1;
  for (int i = 0; i < 4; ++i) areas[i] = norm(n[i]);
  for (const auto& [a, b, c, d] : edge_corners) {
    const double product = areas[c] * areas[d];
    if (!(product > 0)) return -1;
    smallest = std::min(smallest, six_volumes * norm(x[b] - x[a]) / product);
  }
  return smallest;
}

double radius_ratio(const Corners& x) {
  // r = 3V/A;  R = |a² (b×c) + b² (c×a) + c² (a×b)| / 12V
  const Vec3 a = x[1] - x[0], b = x[2] - x[0], c = x[3] - x[0];
  const double volume = jacobian(x) / 6;
  double area = 0;
  for (const Vec3& n : face_normals(x)) area += norm(n) / 2;
  const double reach = norm(dot(a, a) * cross(b, c) + dot(b, b) * cross(c, a) + dot(c, c) * cross(a, b));
  if (!(area > 0) || !(reach > 0)) return 0;
  return 3 * (3 * volume / area) / (reach / (12 * std::abs(volume)));
}

double scaled_jacobian(const Corners& x) {
  double largest = 0;
  for (int i = 0; i < 4; ++i) {
    double product = 1;
    for (int j = 0; j < 4; ++j)
      if (j != i) product *= norm(x[j] - x[i]);
    largest = std::max(largest, product);
  }
  return largest > 0 ? std::numbers::sqrt2 * jacobian(x) / largest : 0;
}

Spread spread_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  return {values.front(), values[values.size() / 100], values[values.size() / 2]};
}

QualityTable quality_of(const TetMesh& mesh) {
  QualityTable table;
  std::vector<double> dihedral, ratio, scaled, jacobians;
  for (int t = 0; t < mesh.tets.size(); ++t) {
    const Corners x = corners_of(mesh, t);
    const auto angles = dihedral_degrees(x);
    for (double angle : angles) ++table.dihedral_histogram[std::clamp(static_cast<int>(angle / 10), 0, 17)];
    table.largest_dihedral_deg = std::max(table.largest_dihedral_deg, *std::max_element(angles.begin(), angles.end()));
    dihedral.push_back(*std::min_element(angles.begin(), angles.end()));
    if (dihedral.back() < dihedral[table.worst_tet]) table.worst_tet = t;
    ratio.push_back(radius_ratio(x));
    scaled.push_back(scaled_jacobian(x));
    jacobians.push_back(jacobian(x));
  }
  table.smallest_dihedral_deg = spread_of(std::move(dihedral));
  table.radius_ratio = spread_of(std::move(ratio));
  table.scaled_jacobian = spread_of(std::move(scaled));
  table.smallest_jacobian_mm3 = spread_of(std::move(jacobians)).min;
  return table;
}

Json to_json(const QualityTable& table) {
  const auto spread = [](const Spread& s) { return Json{{"min", s.min}, {"one_percent", s.one_percent}, {"median", s.median}}; };
  Json smallest = spread(table.smallest_dihedral_deg);
  smallest["max"] = table.largest_dihedral_deg;
  return {{"dihedral_deg", smallest},
          {"radius_ratio", spread(table.radius_ratio)},
          {"scaled_jacobian", spread(table.scaled_jacobian)},
          {"smallest_jacobian_mm3", table.smallest_jacobian_mm3},
          {"dihedral_histogram", {{"bin_deg", 10}, {"count", table.dihedral_histogram}}}};
}

}  // namespace palpate
