// Choosing a filter, and how noisy the scan is.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/smoothing.hpp>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace palpate::smoothing {

Filter by_name(const std::string& name) {
  for (const Filter& filter : all())
    if (filter.about.name == name) return filter;
  throw std::logic_error("no filter " + name);
}

double noise_sd(const Scan& scan) {
  const auto& n = scan.grid.size;
  double sum = 0;
  std::size_t count = 0;
  for (int k = 0; k < n[2]; ++k)
    for (int j = 1; j + 1 < n[1]; ++j)
      for (int i = 1; i + 1 < n[0]; ++i, ++count) {
        const auto row = [&](int y) { return scan(i - 1, y, k) - 2.0 * scan(i, y, k) + scan(i + 1, y, k); };
        sum += std::abs(row(j - 1) - 2 * row(j) + row(j + 1));
      }
  return count == 0 ? 0 : std::sqrt(std::numbers::pi / 2) * sum / (6.0 * static_cast<double>(count));
}

double default_width_mm(const Grid& grid) { return 0.7 * std::cbrt(grid.voxel_mm3()); }

}  // namespace palpate::smoothing
