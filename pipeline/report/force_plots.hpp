// Curves of the history: force over depth, and the force's components over time where a tool holds, slides or lifts.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include <pipeline/report/study.hpp>

namespace palpate {

/// A figure with a curve per solve.
std::string force_plot(const Study& study);

/// A figure with Fx, Fy, Fz over time of every solve whose tool does not get deeper at each step; empty when all do.
std::string motion_plot(const Study& study);

}  // namespace palpate
