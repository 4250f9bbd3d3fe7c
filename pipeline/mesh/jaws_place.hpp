// Where jaws close on a tube, by its centre line and an angle about it: axis = R(angle, t) of −Y made at right angles to the centre line's direction t.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include <pipeline/mesh/centre_line.hpp>

namespace palpate {

struct JawsPlace {
  Vec3 centre, axis, along;  ///< mm; units: the way the upper jaw goes, the tube's direction
};

/// `place` in mm along the centre line, `angle_deg` right-handed about its direction. Where the tube runs along Y the angle counts from −Z.
JawsPlace jaws_at(const CentreLine& line, double place, double angle_deg);

/// The three lines of a case's [clamp].
std::string clamp_lines(const JawsPlace& jaws);

}  // namespace palpate
