// The order of cleaning.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/cleaning.hpp>

#include <cmath>

#include <pipeline/image/components.hpp>
#include <pipeline/image/morphology.hpp>

namespace palpate {
namespace {

Mask kept_islands(const Mask& mask, const Cleaning& cleaning) {
  const double voxels = std::ceil(cleaning.minimum_mm3 / mask.grid.voxel_mm3() * (1 - 1e-9));
  const Mask large = voxels > 1 ? pieces_of_at_least(mask, static_cast<std::size_t>(voxels)) : mask;
  switch (cleaning.islands) {
    case Islands::largest: return largest_piece(large);
    case Islands::seeded: return pieces_with(large, cleaning.seeds);
    case Islands::all: break;
  }
  return large;
}

}  // namespace

Mask cleaned(const Mask& mask, const Cleaning& cleaning, std::vector<CleaningStep>& steps) {
  Mask result = mask;
  const auto step = [&](const std::string& name, Mask next) {
    result = std::move(next);
    steps.push_back({name, count_inside(result)});
  };
  step("chosen", mask);
  step("opened", opened(result, cleaning.opening_mm));
  step("islands kept", kept_islands(result, cleaning));
  step("closed", closed(result, cleaning.closing_mm));
  if (cleaning.holes == Holes::fill) step("holes filled", holes_filled(result));
  return result;
}

}  // namespace palpate
