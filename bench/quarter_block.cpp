// Writes a quarter of the block of bench/calculix: [0, 20]³ mm, its planes of symmetry at x = 0 and y = 0, bricks of six tetrahedra that get
// finer towards the edges of a square patch of the top and towards the top.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <tests/verify/shapes.hpp>

using namespace palpate;

namespace {

/// Coordinates from 0 to `end`, as the given power of even ones: finer there above 1.
std::vector<double> towards(double end, int cells, double power) {
  std::vector<double> places;
  for (int i = 0; i <= cells; ++i) places.push_back(end * (1 - std::pow(1 - double(i) / cells, power)));
  return places;
}

}  // namespace

/// bench-quarter-block mesh.vtu HALF POWER INSIDE OUTSIDE DEPTH: half the patch's side in mm; cells in it, from there to the block's side, and along 20 mm of depth.
int main(int argc, char** argv) {
  if (argc != 7) return std::fputs("bench-quarter-block mesh.vtu HALF POWER INSIDE OUTSIDE DEPTH\n", stderr), 2;
  constexpr double side = 20;
  const double half = std::atof(argv[2]), power = std::atof(argv[3]);
  const int inside = std::atoi(argv[4]), outside = std::atoi(argv[5]), depth = std::atoi(argv[6]);
  auto across = towards(half, inside, power);
  const auto beyond = towards(side - half, outside, power);
  for (int i = outside - 1; i >= 0; --i) across.push_back(side - beyond[i]);
  write_mesh(argv[1], verify::mesh_of(verify::brick(across, across, towards(side, depth, power))));
}
