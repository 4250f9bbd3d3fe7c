// From the voxels a method chose to one clean piece: opening, islands, closing, holes.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include <pipeline/image/mask.hpp>

namespace palpate {

enum class Islands { largest, seeded, all };
enum class Holes { fill, keep };

struct Cleaning {
  double opening_mm = 0, closing_mm = 0;
  Islands islands = Islands::largest;
  double minimum_mm3 = 0;
  Holes holes = Holes::fill;
  std::vector<VoxelIndex> seeds;
};

/// Voxels left after each step, for the card.
struct CleaningStep {
  std::string name;
  std::size_t voxels;
};

/// Opening cuts bridges before islands are told apart; closing and filling come last, as they may join and enclose.
Mask cleaned(const Mask& mask, const Cleaning& cleaning, std::vector<CleaningStep>& steps);

}  // namespace palpate
