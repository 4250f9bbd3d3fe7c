// The case of a set with the effects the loop has added, for palpate-solve.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include <loop/methods/session.hpp>

namespace palpate::loop {

/// case.toml (palpate-case/1): the set's own case, or one for its simple shape, with the fitted law, its effects as [[effect]] tables or as
/// friction and bulk modulus, and `run` as tool. What the solver has no table for (rig, force cell) or means otherwise (support, pre-stress)
/// stands as a comment with its value. `motion`: lines of [tool] and [steps] that say how it moves.
std::string case_text(const Session& session, const Model& model, const Run& run, const std::string& motion);

/// The same for the first fitted run, pressed to its depth at its speed. Empty when there is nothing to press (homogeneous tests).
std::string case_file(const Session& session, const Model& model);

/// True when the case has a table or a key for this active effect.
bool in_case(const Session& session, const Model& model, const Active& active);

}  // namespace palpate::loop
