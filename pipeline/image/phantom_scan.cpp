// Signal of a voxel = (mean intensity over its samples) × (1 + bias g(x)), then Rician noise, rounded.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/phantom_scan.hpp>

#include <algorithm>
#include <numbers>

#include <pipeline/image/rician_noise.hpp>
#include <pipeline/image/slices_in_parallel.hpp>

namespace palpate {
namespace {

/// How many of a voxel's samples lie in each part; what is missing to `total` lies outside.
struct Samples {
  std::vector<int> in_part;
  int total = 0;
};

/// No boundary of the organ, nor inside it of its parts, is nearer to x than this.
double clearance(const Organ& organ, const Vec3& x) {
  const double f = organ.shape(x);
  double nearest = std::abs(f);
  for (std::size_t p = 0; f <= 0 && p + 1 < organ.parts.size(); ++p) nearest = std::min(nearest, std::abs(organ.parts[p].shape(x)));
  return nearest;
}

double half_diagonal(const Affine& cell) { return 0.5 * (norm(cell.columns[0]) + norm(cell.columns[1]) + norm(cell.columns[2])); }

/// Samples of the parallelepiped `cell` moved to `centre`.
Samples sample(const Organ& organ, const Affine& cell, const Vec3& centre, int per_edge) {
  Samples s{std::vector<int>(organ.parts.size(), 0), 0};
  for (int k = 0; k < per_edge; ++k)
    for (int j = 0; j < per_edge; ++j)
      for (int i = 0; i < per_edge; ++i) {
        const int part = part_at(organ, centre + cell.linear({(i + 0.5) / per_edge - 0.5, (j + 0.5) / per_edge - 0.5, (k + 0.5) / per_edge - 0.5}));
        if (part != outside) ++s.in_part[part];
        ++s.total;
      }
  return s;
}

double mean_intensity(const Organ& organ, const Samples& s, double background) {
  double sum = 0;
  int inside = 0;
  for (std::size_t p = 0; p < s.in_part.size(); ++p) {
    sum += s.in_part[p] * organ.parts[p].intensity;
    inside += s.in_part[p];
  }
  return (sum + (s.total - inside) * background) / s.total;
}

/// A smooth field in [−1, 1] over the field of view, u in [−½, ½]³.
double coil_field(const Vec3& u) {
  constexpr double pi = std::numbers::pi;
  return (std::cos(pi * (u[0] + 0.35)) + std::cos(pi * (u[1] - 0.2)) + std::sin(pi * u[2])) / 3;
}

void label(PhantomImages& images, std::size_t voxel, const Organ& organ, const Samples& s) {
  int inside = 0;
  for (int n : s.in_part) inside += n;
  if (2 * inside < s.total) return;
  images.organ.voxels[voxel] = 1;
  images.parts.voxels[voxel] = organ.parts[std::max_element(s.in_part.begin(), s.in_part.end()) - s.in_part.begin()].label;
}

}  // namespace

PhantomImages render(const PhantomSpec& spec, std::uint64_t seed, int threads) {
  const Grid grid = scan_grid(spec);
  PhantomImages images;
  images.scan = {grid, std::vector<std::uint16_t>(grid.count())};
  images.organ = images.parts = {grid, std::vector<std::uint16_t>(grid.count())};
  const Affine& cell = grid.lps_from_voxel;
  Affine slab = cell;  // what a voxel averages over: its edges along rows and columns, the slice thickness across
  slab.columns[2] = spec.scan.slice_thickness_mm * unit(slab.columns[2]);
  const bool slices_touch = spec.scan.slice_thickness_mm == spec.scan.voxel_mm[2];
  const double radius = std::max(half_diagonal(slab), half_diagonal(cell)), step = norm(cell.columns[0]);
  const double sigma = spec.scan.noise * spec.organ.parts.back().intensity;
  slices_in_parallel(grid.size[2], threads, [&](int k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      Samples s, pure;
      for (int i = 0, pure_until = -1; i < grid.size[0]; ++i) {
        const std::size_t v = grid.at(i, j, k);
        const Vec3 centre = cell({double(i), double(j), double(k)});
        if (i > pure_until) {  // how far along the row is all the same tissue?
          pure_until = i + static_cast<int>(std::floor((clearance(spec.organ, centre) - radius) / step));
          if (i <= pure_until) pure = sample(spec.organ, cell, centre, 1);
        }
        s = i <= pure_until ? pure : sample(spec.organ, slab, centre, spec.scan.supersampling);
        const Vec3 u{(i + 0.5) / grid.size[0] - 0.5, (j + 0.5) / grid.size[1] - 0.5, (k + 0.5) / grid.size[2] - 0.5};
        const double signal = mean_intensity(spec.organ, s, spec.scan.background) * (1 + spec.scan.bias * coil_field(u));
        images.scan.voxels[v] = static_cast<std::uint16_t>(std::clamp(std::round(rician(signal, sigma, seed, v)), 0.0, 65535.0));
        if (!slices_touch && i > pure_until) s = sample(spec.organ, cell, centre, spec.scan.supersampling);
        label(images, v, spec.organ, s);
      }
    }
  });
  return images;
}

}  // namespace palpate
