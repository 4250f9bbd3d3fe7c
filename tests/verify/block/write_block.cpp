// Writes a block 40 x 40 x 20 mm of tetrahedra, finer towards the edges of a square patch in the middle of its top (z = 20):
// test-block mesh.vtu EDGE_MM INSIDE OUTSIDE DEPTH HALF. EDGE_MM: cells at the patch's edge and at the top; the numbers of cells from
// there to the patch's middle, to the block's side and to its bottom, growing geometrically; half the patch's side in mm (20, with
// OUTSIDE 0: the whole top).
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdlib>

#include <tests/verify/shapes.hpp>

using namespace palpate;

namespace {

/// Coordinates from −20 to 20, finest at ±patch.
std::vector<double> across(double patch, double edge, int inside, int outside) {
  std::vector<double> half, all;
  const auto inner = verify::graded(edge, 1, patch, inside - 1);
  const auto outer = outside ? verify::graded(edge, 1, 20 - patch, outside - 1) : std::vector<double>{0};
  for (auto d = inner.rbegin(); d != inner.rend(); ++d) half.push_back(patch - *d);
  for (std::size_t i = 1; i < outer.size(); ++i) half.push_back(patch + outer[i]);
  for (auto x = half.rbegin(); x + 1 != half.rend(); ++x) all.push_back(-*x);
  half.front() = 0;
  all.insert(all.end(), half.begin(), half.end());
  return all;
}

}  // namespace

int main(int, char** argv) {
  const double edge = std::atof(argv[2]);
  const auto xy = across(std::atof(argv[6]), edge, std::atoi(argv[3]), std::atoi(argv[4]));
  const auto depth = verify::graded(edge, 1, 20, std::atoi(argv[5]) - 1);
  std::vector<double> z;
  for (auto d = depth.rbegin(); d != depth.rend(); ++d) z.push_back(20 - *d);
  write_mesh(argv[1], verify::mesh_of(verify::brick(xy, xy, z)));
}
