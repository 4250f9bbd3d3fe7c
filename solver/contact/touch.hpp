// A point of contact with a tool, as effects on the traction see it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <solver/contact/tool.hpp>

namespace palpate::contact {

/// Whether a point slides: its bound says so, or, in a run close beside another, what it does there.
enum class Branch { by_bound, sticks, slides };

/// What friction remembers of a point: where it was, seen from the tool, and the shear it carried (turned back with the tool), when the
/// last step was found.
struct Slip {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< mm
  Eigen::Vector3d shear = Eigen::Vector3d::Zero();  ///< MPa
  Eigen::Vector3d place_before = Eigen::Vector3d::Zero(), shear_before = Eigen::Vector3d::Zero();  ///< of the step before; where it stuck, of this one: what a finer mesh goes on from
};

struct Touch {
  Eigen::Vector3d place;      ///< seen from the tool, mm
  tools::Distance distance;   ///< from the tool: gap, normal out of it, curvature
  double pressure = 0;        ///< MPa; 0 where nothing touches
  double pressure_slope = 0;  ///< −∂pressure/∂gap, MPa/mm
  double stiffness = 0;       ///< of elastic slip, MPa/mm
  Slip before;                ///< for what holds on
  Branch branch = Branch::by_bound;
};

}  // namespace palpate::contact
