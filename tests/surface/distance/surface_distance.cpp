// Prints the mean and largest distance between two surfaces (mm), the worse of the two directions: test-surface-distance A.vtp B.vtp
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstdio>

#include <pipeline/surface/distance.hpp>

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const auto a = palpate::read_surface(argv[1]), b = palpate::read_surface(argv[2]);
  const auto there = palpate::distance(a, b), back = palpate::distance(b, a);
  std::printf("%.6f %.6f\n", std::max(there.mean_mm, back.mean_mm), std::max(there.largest_mm, back.largest_mm));
}
