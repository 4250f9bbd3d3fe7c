// The elastic force over depth of one site and tool, for closed forms; the backbone that the row of springs is cut from.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <loop/forward/tissue.hpp>

namespace palpate::loop {

/// Where a tool presses.
struct Site {
  Tool tool;
  Vec3 point_mm{0, 0, 0};
  double thickness_mm = 1e4;
  bool bonded = true;
};

/// F(δ) in N. Ball: Hertz 16/3 μ √R δ^1.5, times the exact factor of the layer, times the law's stress over Hooke's at the
/// representative uniaxial stretch 1 − a/(5R), a = √(Rδ) (Lin, Dimitriadis and Horkay 2009, J. Biomech. Eng. 131:094502; for
/// neo-Hooke and Fung it gives their closed forms). Flat punch: 8 a μ δ, likewise with 1 − δ/(5a). Skin: the deflection of Hertz'
/// solution stretches it: F = 2 c1 T δ + 3 c2 E h δ²/R (energies of tension and of stretch over that deflection). ν: 1/(2 (1 − ν)) and
/// the layer's own. Inclusion: F (1 + e s³/(1 + s³)), s = a/depth. Sides of a block or cylinder are not seen.
double elastic_force(const Site& site, const Tissue& tissue, double depth_mm);

}  // namespace palpate::loop
