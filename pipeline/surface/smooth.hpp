// Smoothing that keeps the volume: Taubin's low-pass filter, and an offset along the normals that restores what is missing.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include <palpate/mesh_files.hpp>

namespace palpate {

/// `passes` times a step x += λ L x and a step back x += μ L x, with L the mean of the neighbours minus the point,
/// λ = 0.5, μ = −0.53 (Taubin 1995, pass band 0.1).
void taubin_smooth(Surface& surface, int passes);

/// Draws the points of the given triangles, and those within `rings` edges of them, towards the mean of their neighbours,
/// `passes` times by half.
void relax_around(Surface& surface, const std::vector<int>& triangles, int rings, int passes);

/// Moves all points along their normals by one distance so that the surface encloses `mm3` (Newton, dV/dδ = Σ |a_v|, a_v the area
/// vector of point v). Returns the distance in mm.
double restore_volume(Surface& surface, double mm3);

}  // namespace palpate
