// Calling another of Palpate's programs, from the folder of this one.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

namespace palpate {

/// Runs palpate-<name> to its end; its messages go where ours go, its result to nowhere. Returns its exit code; it is killed when we are.
/// Throws Failure(unreadable) when the program is not there.
int call_program(const std::string& name, const std::vector<std::string>& arguments);

}  // namespace palpate
