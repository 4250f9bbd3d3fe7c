// Separable Gaussian reconstruction: G(x) = Σ_q w(x − q s) m_q, w normalised to sum one.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/surface/field.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace palpate {
namespace {

constexpr double reach = 4;  ///< of the kernel, in standard deviations: 6e-5 of its weight lies beyond

/// Weights of the samples first, first+1, … for one place on the new lattice.
struct Stencil {
  int first = 0;
  std::vector<float> weights;
};

/// Samples lie at 0, s, 2s, …; places at origin + p step. Samples outside count as zero.
std::vector<Stencil> stencils(int samples, double spacing, double sigma, int places, double origin, double step) {
  std::vector<Stencil> all(places);
  for (int p = 0; p < places; ++p) {
    const double x = origin + p * step;
    const int low = static_cast<int>(std::ceil((x - reach * sigma) / spacing));
    const int high = static_cast<int>(std::floor((x + reach * sigma) / spacing));
    double sum = 0;
    std::vector<double> weights;
    for (int q = low; q <= high; ++q) {
      const double z = (x - q * spacing) / sigma;
      weights.push_back(std::exp(-0.5 * z * z));
      sum += weights.back();
    }
    all[p].first = std::max(low, 0);
    for (int q = all[p].first; q <= std::min(high, samples - 1); ++q) all[p].weights.push_back(float(weights[q - low] / sum));
  }
  return all;
}

/// Applies stencils along one axis; the other two keep their size.
Scan resample(const Scan& in, int axis, const std::vector<Stencil>& places) {
  Scan out;
  out.grid.size = in.grid.size;
  out.grid.size[axis] = static_cast<int>(places.size());
  out.voxels.assign(out.grid.count(), 0);
  const auto& size = out.grid.size;
  std::array<int, 3> q{};
  for (q[2] = 0; q[2] < size[2]; ++q[2])
    for (q[1] = 0; q[1] < size[1]; ++q[1]) {
      float* row = &out.voxels[out.grid.at(0, q[1], q[2])];
      if (axis == 0) {
        const float* from = &in.voxels[in.grid.at(0, q[1], q[2])];
        for (int i = 0; i < size[0]; ++i)
          for (std::size_t w = 0; w < places[i].weights.size(); ++w) row[i] += places[i].weights[w] * from[places[i].first + w];
        continue;
      }
      const Stencil& place = places[q[axis]];
      for (std::size_t w = 0; w < place.weights.size(); ++w) {
        std::array<int, 3> source = q;
        source[axis] = place.first + static_cast<int>(w);
        const float* from = &in.voxels[in.grid.at(0, source[1], source[2])];
        for (int i = 0; i < size[0]; ++i) row[i] += place.weights[w] * from[i];
      }
    }
  return out;
}

/// At the voxels themselves.
Scan blur(const Scan& in, const std::array<double, 3>& sigma_mm) {
  const Vec3 spacing = in.grid.spacing();
  Scan out;
  for (int axis = 0; axis < 3; ++axis) {
    const auto places = stencils(in.grid.size[axis], spacing[axis], sigma_mm[axis], in.grid.size[axis], 0, spacing[axis]);
    out = resample(axis == 0 ? in : out, axis, places);
  }
  return out;
}

/// The value that `count` voxels exceed or reach.
float level_of_count(const Scan& scan, std::size_t count) {
  std::vector<float> values = scan.voxels;
  std::nth_element(values.begin(), values.begin() + (count - 1), values.end(), std::greater<>());
  return values[count - 1];
}

}  // namespace

double normal_quantile(double p) {
  const double tail = std::min(p, 1 - p);
  const double t = std::sqrt(-2 * std::log(tail));
  const double z = t - (2.515517 + t * (0.802853 + t * 0.010328)) / (1 + t * (1.432788 + t * (0.189269 + t * 0.001308)));
  return p < 0.5 ? -z : z;
}

double default_smooth_mm(const Grid& grid) {
  const Vec3 spacing = grid.spacing();
  return 1.5 * std::max({spacing[0], spacing[1], spacing[2]});
}

std::array<double, 3> gaussian_mm(const Grid& grid, double smooth_mm) {
  const Vec3 spacing = grid.spacing();
  std::array<double, 3> sigma{};
  for (int axis = 0; axis < 3; ++axis) sigma[axis] = std::max(smooth_mm, 0.5 * spacing[axis]);
  return sigma;
}

Scan consistent_weights(const Mask& mask, const std::array<double, 3>& sigma_mm, double slack_mm, int steps) {
  Scan weights{mask.grid, std::vector<float>(mask.voxels.begin(), mask.voxels.end())};
  const double sigma = *std::max_element(sigma_mm.begin(), sigma_mm.end());
  const float slack =
      float(0.5 * std::erf(slack_mm / (std::numbers::sqrt2 * sigma)));  // Φ(d/σ) − ½, the blurred value at a distance
  for (int step = 0; step < steps; ++step) {
    const Scan blurred = blur(weights, sigma_mm);
    const float level = level_of_count(blurred, std::count(mask.voxels.begin(), mask.voxels.end(), 1));
    for (std::size_t v = 0; v < weights.voxels.size(); ++v) {
      const float above = blurred.voxels[v] - level;
      if (mask.voxels[v] ? above < -slack : above > slack) weights.voxels[v] -= 2 * above;
    }
  }
  return weights;
}

Scan organ_field(const Scan& weights, const std::array<double, 3>& sigma_mm, double step_mm) {
  const Vec3 spacing = weights.grid.spacing();
  Scan field;
  Grid lattice;
  Vec3 start_voxel{};
  for (int axis = 0; axis < 3; ++axis) {
    const double margin = 2 * sigma_mm[axis] + 2 * step_mm;  // the blurred mask is below 3 % there
    lattice.size[axis] = static_cast<int>(std::ceil(((weights.grid.size[axis] - 1) * spacing[axis] + 2 * margin) / step_mm)) + 1;
    const auto places = stencils(weights.grid.size[axis], spacing[axis], sigma_mm[axis], lattice.size[axis], -margin, step_mm);
    field = axis == 0 ? resample(weights, axis, places) : resample(field, axis, places);
    lattice.lps_from_voxel.columns[axis] = (step_mm / spacing[axis]) * weights.grid.lps_from_voxel.columns[axis];
    start_voxel[axis] = -margin / spacing[axis];
  }
  lattice.lps_from_voxel.origin = weights.grid.lps_from_voxel(start_voxel);
  field.grid = lattice;
  for (float& f : field.voxels) f = float(normal_quantile(std::clamp(double(f), 1e-4, 1 - 1e-4)));
  return field;
}

}  // namespace palpate
