// The header of every executable: a program defines usage() and run(); parsing, cards, temporary files, exit codes are here.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <palpate/card.hpp>
#include <palpate/errors.hpp>
#include <palpate/progress.hpp>
#include <palpate/usage.hpp>
#include <palpate/vec3.hpp>

namespace palpate {

/// What run() sees: parsed arguments, and where to put results.
class Command {
 public:
  /// Parses; throws Failure(misuse) naming the nearest known option or choice (parse_arguments).
  Command(const Usage& usage, const std::vector<std::string>& words);

  const std::filesystem::path& input(const std::string& name) const;
  /// All of an input of which there may be several.
  const std::vector<std::filesystem::path>& inputs(const std::string& name) const;
  /// Where to write an output or side output: a temporary name that becomes the real one when run() returns.
  /// A folder exists and is empty, or is what a killed run left (Usage::continues).
  std::filesystem::path output(const std::string& name) const;
  /// The name the user gave, for messages and for paths relative to it.
  std::filesystem::path final_output(const std::string& name) const;

  bool has(const std::string& option) const;  ///< given, or has a default
  double real(const std::string& option) const;
  long integer(const std::string& option) const;
  std::string text(const std::string& option) const;  ///< text and choice
  bool flag(const std::string& option) const;
  std::vector<Vec3> points(const std::string& option) const;
  std::filesystem::path file(const std::string& option) const;

  int threads() const;
  std::uint64_t seed() const;
  bool verbose() const;

  /// Progress of a long piece of work: a bar on a terminal, a plain line now and then elsewhere, nothing with --quiet.
  Progress progress(const std::string& label, std::size_t total) const;
  /// A message to the person (stderr), unless --quiet.
  void say(const std::string& message) const;
  /// A result (stdout).
  void print(const std::string& result) const;
  /// A message that also goes into the card.
  void warn(const std::string& message);

  /// Records a check in the card; failing ones end the program with exit code 4 after run(), and no output is kept.
  void check(const Check& check);
  /// Free facts of this stage for the card and the report: `notes[key] = value`.
  void note(const std::string& key, Json value);
  /// A file that is read besides the declared inputs (a case's mesh): hashed in the card. Throws Failure(misuse) when it is one
  /// of the outputs.
  void add_input(const std::string& name, const std::filesystem::path& path);

  /// What the outputs' bytes follow from: this very program, its options, threads, and the hashes of all inputs so far.
  Json identity() const;

  struct State;  // command_state.hpp
  State& state() { return *state_; }

 private:
  std::shared_ptr<State> state_;
};

using UsageFunction = void (*)(Usage&);
using RunFunction = void (*)(Command&);

/// The life of an executable: usage, parsing, --skip-current, run, checks, cards, commit. Returns the exit code. Without outputs
/// there is no card, and nothing to be current.
int run_program(int argc, char** argv, UsageFunction usage_of, RunFunction run);

/// One command of a group: its usage() and run().
struct GroupCommand {
  UsageFunction usage_of;
  RunFunction run;
};

/// The life of a program of several commands (`palpate run study.toml`). The first word chooses; a word that no command has goes
/// to `otherwise` with the rest of the line, which throws Failure(misuse) when it knows no such word either, and may not return.
using OtherwiseFunction = int (*)(const std::string& word, const std::vector<std::string>& arguments);
int run_group(int argc, char** argv, Group group, const std::vector<GroupCommand>& commands, OtherwiseFunction otherwise);

}  // namespace palpate

/// Defined by each program: what it is.
void usage(palpate::Usage& u);
/// Defined by each program: does it. Throws palpate::Failure.
void run(palpate::Command& c);
