// The card of a running command: as it would be written, and as it is. For command.cpp and run_program.cpp alone.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <palpate/command.hpp>

namespace palpate {

/// The card as far as it is known before any input is read: what `--skip-current` compares. Inputs carry no hashes.
Json card_before(const Command::State& state);

/// The whole card; the outputs stand under their temporary names. `seconds`: of run().
Json card_after(const Command::State& state, double seconds);

/// See Command::identity().
Json identity_of(const Command::State& state);

/// Hashes the declared inputs (arguments and files given as options) into `state.inputs`.
void hash_inputs(Command::State& state);

/// One more input: `path` is hashed as it is now.
void hash_input(Command::State& state, const std::string& name, const std::filesystem::path& path);

/// Names of the declared inputs that are there: arguments, then files given as options.
std::vector<std::pair<std::string, std::filesystem::path>> declared_inputs(const Command::State& state);

/// Throws Failure(misuse) when `input` is one of the outputs or one of their cards, or lies in an output folder.
void expect_not_an_output(const Command::State& state, const std::filesystem::path& input);

/// `--threads`, or the number of cores for 0.
int thread_count(const Command::State& state);

}  // namespace palpate
