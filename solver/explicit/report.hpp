// The result folder of a closing: history.csv, frames.pvd with frames/*.vtu, jaws.vtu, summary.json.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>

#include <palpate/command.hpp>

namespace palpate::explicit_shell {

/// True when the case file says scheme = "explicit".
bool is_explicit(const std::filesystem::path& path);

/// The life of `palpate-solve` with scheme = "explicit": reads the case, runs it, writes the folder, makes the checks.
void solve(Command& command);

}  // namespace palpate::explicit_shell
