// What no effect of the catalogue does: the force drops at once while the tool moves on, or swings while the tool stands still.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include <loop/methods/session.hpp>

namespace palpate::loop {

struct Oddity {
  std::string kind{};      ///< sudden_drop or swing
  std::string run{};       ///< where it is largest
  double size = 0;         ///< of the drop or the swing, N (MPa)
  double t_s = 0, u_mm = 0;    ///< of a drop
  double frequency_Hz = 0;     ///< of a swing
  double strength = 0;     ///< drop: over the usual change between neighbours; swing: share of the scatter at rest that it explains
  std::string told{};      ///< in words
};

/// Of the residuals of all fitted runs, largest first.
std::vector<Oddity> oddities(const Session& session, const Model& model);

}  // namespace palpate::loop
