// The point of a triangle that is nearest to a block: distance d = min over x in the triangle of |x − block|, where it is and from where.
// A corner of the triangle, a corner of the block over the triangle, or the place where two edges pass each other.
// (Ericson 2005, Real-Time Collision Detection, §5.1.5 and §5.1.9.)
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>

#include <solver/explicit/wall.hpp>

namespace palpate::explicit_shell {

/// Weights of the corners at the point of the triangle a b c that is nearest to p.
std::array<double, 3> nearest(const Lanes& p, const Lanes& a, const Lanes& b, const Lanes& c);

struct NearBlock {
  std::array<double, 3> weights{1, 0, 0};  ///< of the triangle's corners
  Lanes apart{};                           ///< from the block to that point, mm
  double distance = 0;                     ///< mm; what lies beyond `within` is not looked for
};

/// `x`: the triangle's corners in the frame of the block, which reaches from −half to half. For triangles that the block does not touch.
NearBlock nearest_to_block(const std::array<Lanes, 3>& x, const Lanes& half, double within);

}  // namespace palpate::explicit_shell
