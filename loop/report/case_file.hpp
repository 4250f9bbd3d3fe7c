// The case of a set with the effects the loop has added, for palpate-solve.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include <loop/methods/session.hpp>

namespace palpate::loop {

/// case.toml (palpate-case/1): the set's own case, or one for its simple shape, with the fitted law, its effects as [[effect]] tables or as
/// friction and bulk modulus, and the first fitted run as tool. What the solver has no table for (rig, force cell, support, skin) stands as a
/// comment with its value. Empty when there is nothing to press (homogeneous tests).
std::string case_file(const Session& session, const Model& model);

}  // namespace palpate::loop
