// The order of a wall's nodes: the same wall, layer after layer from its first end.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include <pipeline/mesh/shell_order.hpp>

using namespace palpate;

namespace {

constexpr int around = 9, rings = 20;

/// A tube whose nodes and triangles are shuffled; thickness says which node it was before.
ShellMesh shuffled() {
  std::vector<int> number(around * rings);
  for (int i = 0; i < around * rings; ++i) number[i] = i;
  std::mt19937 random(5);
  std::shuffle(number.begin(), number.end(), random);
  ShellMesh mesh;
  mesh.points.resize(number.size());
  mesh.thickness_mm.resize(number.size());
  mesh.end.assign(number.size(), 0);
  mesh.end_direction.assign(number.size(), Vec3{0, 0, 0});
  for (int r = 0; r < rings; ++r)
    for (int i = 0; i < around; ++i) {
      const int n = number[r * around + i], a = n, b = number[r * around + (i + 1) % around];
      mesh.points[n] = {std::cos(2 * M_PI * i / around), std::sin(2 * M_PI * i / around), 0.6 * r};
      mesh.thickness_mm[n] = 1 + r * around + i;
      if (r == 0 || r + 1 == rings) mesh.end[n] = r == 0 ? 1 : 2, mesh.end_direction[n] = {0, 0, r == 0 ? -1.0 : 1.0};
      if (r + 1 == rings) continue;
      const int c = number[(r + 1) * around + i], d = number[(r + 1) * around + (i + 1) % around];
      mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {b, d, c}});
      mesh.triangle_region.insert(mesh.triangle_region.end(), {r, r});
    }
  return mesh;
}

/// Region and corners, from the smallest on, in coordinates: of a triangle whatever its nodes are called.
std::multimap<double, std::array<Vec3, 3>> by_place(const ShellMesh& mesh) {
  std::multimap<double, std::array<Vec3, 3>> all;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::array<Vec3, 3> x{mesh.points[mesh.triangles[t][0]], mesh.points[mesh.triangles[t][1]], mesh.points[mesh.triangles[t][2]]};
    std::rotate(x.begin(), std::min_element(x.begin(), x.end()), x.end());
    all.insert({mesh.triangle_region[t] + 1e-3 * x[0][0] + 1e-6 * x[1][0] + 1e-9 * x[2][1], x});
  }
  return all;
}

}  // namespace

TEST(ShellOrder, TheWallStaysWhatItIs) {
  const ShellMesh before = shuffled();
  ShellMesh mesh = before;
  order_along(mesh);
  EXPECT_EQ(by_place(mesh), by_place(before));
  std::map<double, std::size_t> was;
  for (std::size_t i = 0; i < before.points.size(); ++i) was[before.thickness_mm[i]] = i;
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const std::size_t j = was.at(mesh.thickness_mm[i]);
    EXPECT_EQ(mesh.points[i], before.points[j]);
    EXPECT_EQ(mesh.end[i], before.end[j]);
    EXPECT_EQ(mesh.end_direction[i], before.end_direction[j]);
  }
}

TEST(ShellOrder, LayerAfterLayerFromTheFirstEnd) {
  ShellMesh mesh = shuffled();
  order_along(mesh);
  for (std::size_t i = 0; i + 1 < mesh.points.size(); ++i) EXPECT_LE(mesh.points[i][2], mesh.points[i + 1][2] + 1e-12) << i;
  for (std::size_t t = 0; t + 1 < mesh.triangles.size(); ++t)
    EXPECT_LE(*std::min_element(mesh.triangles[t].begin(), mesh.triangles[t].end()), *std::min_element(mesh.triangles[t + 1].begin(), mesh.triangles[t + 1].end()));
  for (const auto& t : mesh.triangles) EXPECT_LE(*std::max_element(t.begin(), t.end()) - *std::min_element(t.begin(), t.end()), 2 * around);
}

TEST(ShellOrder, PiecesAndNodesWithoutEndFollow) {
  ShellMesh mesh = shuffled();
  mesh.end.assign(mesh.end.size(), 0);
  mesh.points.push_back({9, 9, 9});  // belongs to nothing
  mesh.thickness_mm.push_back(999);
  mesh.end.push_back(0);
  mesh.end_direction.push_back({0, 0, 0});
  order_along(mesh);
  EXPECT_EQ(mesh.points.size(), around * rings + 1u);
  EXPECT_EQ(std::count(mesh.thickness_mm.begin(), mesh.thickness_mm.end(), 999), 1);
}
