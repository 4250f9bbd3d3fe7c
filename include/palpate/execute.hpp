// One run of a command, between its command line and its exit code. For run_program.cpp alone.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <palpate/command.hpp>

namespace palpate {

/// Checks the inputs, skips what is current, calls `run`, and commits outputs and cards. Throws Failure; then nothing is left
/// behind.
void execute(Command& command, RunFunction run);

}  // namespace palpate
