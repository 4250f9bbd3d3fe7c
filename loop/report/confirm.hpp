// What was found, put into palpate-solve: does the force change there as the loop's shortcut says?
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <functional>

#include <palpate/json.hpp>
#include <loop/methods/search.hpp>

namespace palpate::loop {

/// A fitted run solved without and with the effects that the solver knows. Changes of force, N, at some 25 samples of the run.
struct Confirmation {
  std::string run;
  std::vector<std::string> effects;   ///< put into the solver
  std::vector<std::string> observed;  ///< of rig, force cell or tool: nothing to solve
  std::vector<std::string> left_out;  ///< the solver has nothing that means the same
  std::string failure;                ///< what stopped the solver; empty: nothing
  double ratio = 1;                   ///< least squares: the solver's change over the shortcut's
  double apart = 0;                   ///< what that leaves of the solver's change (rms, relative)
  double taken = 1;                   ///< size that the row has taken from the solver; `ratio` is what is left of it
  int nodes = 0, solves = 0;
  /// The solver was asked, and says the same within thresholds::confirm_share; or nothing needed to be asked.
  bool confirmed() const;
};

/// The run is the one that the effects change most. On a simple shape's mesh of our own or on the case's; the mesh's own error cancels, as forces are compared
/// with the same mesh without effect. A case that does not remember is solved going in only. Empty `solver`: nothing is solved. Solves are kept in `kept`, `scratch` is worked in.
Confirmation confirmed(const Session& session, const Model& model, const std::filesystem::path& solver, const std::filesystem::path& kept, const std::filesystem::path& scratch, int threads,
                       const std::function<void(const std::string&)>& remark);

/// Where what was found has the solver's course but not its size, in a case: the row takes the solver's size, and everything is fitted anew to the runs. The confirmation then tells
/// of the size that is left, to first order none.
void take_size(Session& session, Finding& finding, Confirmation& confirmation);

Json confirmation_json(const Confirmation& confirmation);

/// One sentence for people; empty when there was nothing to confirm.
std::string told(const Confirmation& confirmation);

}  // namespace palpate::loop
