// One run of a command: inputs, --skip-current, run(), checks, cards, commit.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <palpate/execute.hpp>

#include <chrono>

#include <palpate/command_card.hpp>
#include <palpate/command_state.hpp>

namespace palpate {
namespace fs = std::filesystem;
namespace {

void expect_inputs(const Command::State& state) {
  const auto expect = [](const ArgumentSpec& spec, const fs::path& path) {
    const bool file = spec.kind == ArgumentKind::file;
    if (!fs::exists(path))
      throw Failure(ExitCode::unreadable, file ? "no such file" : "no such folder", path.string(),
                    "check the name of: " + spec.name);
    if (fs::is_directory(path) == file)
      throw Failure(ExitCode::misuse, file ? "a folder, where a file is read" : "a file, where a folder is read", path.string(),
                    spec.meaning);
  };
  for (const auto& spec : state.usage.inputs) {
    if (!spec.several) expect(spec, state.arguments.inputs.at(spec.name));
    else
      for (const fs::path& path : state.arguments.several.at(spec.name)) expect(spec, path);
  }
  for (const auto& [name, path] : declared_inputs(state)) {
    if (!fs::exists(path)) throw Failure(ExitCode::unreadable, "no such file", path.string(), "check --" + name);
    expect_not_an_output(state, path);
  }
}

void expect_distinct_outputs(const Command::State& state) {
  std::map<fs::path, std::string> names;
  for (const auto& [name, target] : state.targets) {
    const auto [other, is_new] = names.emplace(fs::weakly_canonical(fs::absolute(target)), name);
    if (!is_new)
      throw Failure(ExitCode::misuse, name + " and " + other->second + " have the same name", target.string(),
                    "another name for one of them");
  }
}

void open_outputs(Command::State& state) {
  const bool force = state.arguments.options.at("force").get<bool>();
  expect_distinct_outputs(state);
  for (const auto& spec : state.usage.outputs) {
    const auto kind = spec.kind == ArgumentKind::file ? PendingOutput::Kind::file : PendingOutput::Kind::folder;
    const auto leftovers = state.usage.continues ? PendingOutput::Leftovers::handed_over : PendingOutput::Leftovers::removed;
    state.outputs.emplace(spec.name, PendingOutput(state.targets.at(spec.name), kind, force, leftovers));
  }
  for (const auto& side : state.usage.side_outputs)
    state.outputs.emplace(side.name, PendingOutput(state.targets.at(side.name), PendingOutput::Kind::file, force));
}

void throw_failed_checks(const std::vector<Check>& checks) {
  std::string what, where;
  for (const Check& check : checks) {
    if (check.pass) continue;
    what += "\n  check failed: " + check.name + " is " + check.value.dump() + ", must be " + check.limit;
    if (where.empty()) where = check.where;
  }
  if (!what.empty())
    throw Failure(ExitCode::check_failed, "the result is not delivered" + what, where, "other options; --verbose says more");
}

/// Every byte is on the disk before the first name changes. Cards are renamed first: killed in between, a card that matches no
/// bytes is left, and the stage runs again.
void commit(Command::State& state, double seconds) {
  for (const auto& [name, output] : state.outputs)
    if (!fs::exists(output.temporary())) throw std::logic_error("run() did not write the output " + name);
  const Json card = card_after(state, seconds);
  std::vector<PendingOutput> cards;
  for (const auto& spec : state.usage.outputs) {
    cards.emplace_back(card_path(state.targets.at(spec.name)), PendingOutput::Kind::file, true);
    write_json(cards.back().temporary(), card);
  }
  for (const auto& pending : cards) pending.flush();
  for (const auto& [name, output] : state.outputs) output.flush();
  for (auto& pending : cards) pending.commit();
  for (auto& [name, output] : state.outputs) output.commit();
}

bool is_current(const Command::State& state) {
  if (!state.arguments.options.at("skip-current").get<bool>() || state.usage.outputs.empty()) return false;
  if (!card_is_current(card_before(state), state.targets.at(state.usage.outputs.front().name))) return false;
  for (const auto& [name, target] : state.targets) remove_leftovers(target);
  return true;
}

}  // namespace

void execute(Command& command, RunFunction run) {
  Command::State& state = command.state();
  expect_inputs(state);
  if (is_current(state)) {
    command.print("current");
    return;
  }
  open_outputs(state);
  if (!state.outputs.empty()) hash_inputs(state);
  const auto start = std::chrono::steady_clock::now();
  run(command);
  throw_failed_checks(state.checks);
  if (!state.outputs.empty()) commit(state, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
}

}  // namespace palpate
