// Breadth first over the edges.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/mesh/shell_order.hpp>

#include <algorithm>
#include <numeric>
#include <utility>

namespace palpate {
namespace {

/// Old numbers in their new order.
std::vector<int> layers(const ShellMesh& mesh) {
  const int n = static_cast<int>(mesh.points.size());
  std::vector<std::vector<int>> beside(n);
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) beside[t[k]].push_back(t[(k + 1) % 3]), beside[t[(k + 1) % 3]].push_back(t[k]);
  std::vector<int> order;
  std::vector<char> seen(n, 0);
  const auto take = [&](int i) {
    if (!std::exchange(seen[i], 1)) order.push_back(i);
  };
  for (int i = 0; i < n; ++i)
    if (mesh.end[i] == 1) take(i);
  std::size_t at = 0;
  for (int next = 0; static_cast<int>(order.size()) < n; ++next) {
    for (; at < order.size(); ++at)
      for (int neighbour : beside[order[at]]) take(neighbour);
    if (next < n) take(next);
  }
  return order;
}

template <class T>
void permute(std::vector<T>& values, const std::vector<int>& order) {
  std::vector<T> now;
  now.reserve(values.size());
  for (int i : order) now.push_back(values[i]);
  values = std::move(now);
}

}  // namespace

void order_along(ShellMesh& mesh) {
  const auto order = layers(mesh);
  std::vector<int> number(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) number[order[i]] = static_cast<int>(i);
  permute(mesh.points, order);
  permute(mesh.thickness_mm, order);
  permute(mesh.end, order);
  permute(mesh.end_direction, order);
  for (auto& t : mesh.triangles)
    for (int& i : t) i = number[i];
  std::vector<int> triangles(mesh.triangles.size());
  std::iota(triangles.begin(), triangles.end(), 0);
  std::stable_sort(triangles.begin(), triangles.end(), [&](int a, int b) { return *std::min_element(mesh.triangles[a].begin(), mesh.triangles[a].end()) < *std::min_element(mesh.triangles[b].begin(), mesh.triangles[b].end()); });
  permute(mesh.triangles, triangles);
  permute(mesh.triangle_region, triangles);
}

}  // namespace palpate
