// Exact Euclidean distance on an anisotropic lattice: d²(p) = min over q inside of Σ_a h_a² (p_a − q_a)².
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include <pipeline/image/mask.hpp>

namespace palpate {

/// Squared distance in mm² from every voxel centre to the nearest centre inside; infinite when the mask is empty. Axes are taken
/// as orthogonal. Linear in the number of voxels: one lower envelope of parabolas per line and axis.
/// P. Felzenszwalb & D. Huttenlocher, Distance transforms of sampled functions, Theory of Computing 8 (2012), algorithm 1.
std::vector<float> squared_distance_mm2(const Mask& mask);

}  // namespace palpate
