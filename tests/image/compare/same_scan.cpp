// test-same-scan A B VALUE_TOLERANCE: exit 0 when both hold the same value at the same place, voxel by voxel, whatever their axes.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>

#include <palpate/nifti.hpp>

using namespace palpate;

namespace {

constexpr double place_tolerance_mm = 1e-3;

struct Worst {
  double place_mm = 0, value = 0;
  long outside = 0;
};

/// Each voxel of b against the voxel of a nearest to its centre.
Worst compare(const Scan& a, const Scan& b) {
  const Affine a_from_lps = a.grid.lps_from_voxel.inverse();
  Worst worst;
  for (int k = 0; k < b.grid.size[2]; ++k)
    for (int j = 0; j < b.grid.size[1]; ++j)
      for (int i = 0; i < b.grid.size[0]; ++i) {
        const Vec3 x = b.grid.lps_from_voxel({double(i), double(j), double(k)});
        const Vec3 u = a_from_lps(x);
        const int v[3] = {int(std::lround(u[0])), int(std::lround(u[1])), int(std::lround(u[2]))};
        if (v[0] < 0 || v[1] < 0 || v[2] < 0 || v[0] >= a.grid.size[0] || v[1] >= a.grid.size[1] || v[2] >= a.grid.size[2]) {
          ++worst.outside;
          continue;
        }
        const Vec3 y = a.grid.lps_from_voxel({double(v[0]), double(v[1]), double(v[2])});
        worst.place_mm = std::max(worst.place_mm, norm(x - y));
        worst.value = std::max(worst.value, std::abs(double(a(v[0], v[1], v[2])) - double(b(i, j, k))));
      }
  return worst;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  try {
    const auto a = read_scan(argv[1]), b = read_scan(argv[2]);
    const Worst worst = compare(a, b);
    std::cout << "voxels " << a.grid.count() << " and " << b.grid.count() << ", outside " << worst.outside << ", place " << worst.place_mm
              << " mm, value " << worst.value << "\n";
    const bool same = a.grid.count() == b.grid.count() && worst.outside == 0 && worst.place_mm <= place_tolerance_mm &&
                      worst.value <= std::atof(argv[3]);
    return same ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 3;
  }
}
