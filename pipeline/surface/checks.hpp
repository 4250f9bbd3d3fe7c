// What a delivered surface must be, as checks for the card, each with the place of the first offence.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <vector>

#include <palpate/card.hpp>
#include <palpate/mesh_files.hpp>

namespace palpate {

/// What is asked of it.
struct SurfaceLimits {
  double volume_mm3 = 0;          ///< what it should enclose
  double volume_change = 0.02;    ///< relative
  double min_angle_deg = 15;      ///< of any triangle
  std::optional<int> components;  ///< exactly; else at least one
  std::optional<int> genus;       ///< of all components together, at most; else as found
};

/// Checks of the surface as it is on disk: closed, manifold, oriented outward, free of self-intersections, components, genus,
/// volume, angles.
std::vector<Check> surface_checks(const Surface& surface, const SurfaceLimits& limits);

/// The first check that fails, if any.
std::optional<Check> first_failed(const std::vector<Check>& checks);

}  // namespace palpate
