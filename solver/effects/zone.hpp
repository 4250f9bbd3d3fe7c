// Of a zone with a soft edge: 1 inside, 0 outside, 6 t⁵ − 15 t⁴ + 10 t³ between (Perlin 2002, SIGGRAPH: twice continuous), so that answers
// have derivatives by its place and size.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <algorithm>

namespace palpate::effects {

/// How far a place at `distance` from the middle belongs to a zone of this radius; the edge's width is half inside and half outside. mm.
inline double inside(double distance, double radius, double edge) {
  const double t = std::clamp((radius - distance) / edge + 0.5, 0.0, 1.0);
  return t * t * t * (t * (6 * t - 15) + 10);
}

}  // namespace palpate::effects
