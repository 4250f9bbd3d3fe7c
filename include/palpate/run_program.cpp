// main() of a program and of a group of commands: questions answered, failures turned into messages and exit codes.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <palpate/command.hpp>

#include <iostream>

#include <palpate/execute.hpp>

namespace palpate {
namespace fs = std::filesystem;
namespace {

Json catalogue_json(const std::function<std::vector<CatalogueEntry>()>& catalogue) {
  Json entries = Json::array();
  if (catalogue)
    for (const auto& entry : catalogue()) entries.push_back(to_json(entry));
  return entries;
}

/// --help and its kin; true when one of them was asked for.
bool answered_question(const Usage& usage, const std::vector<std::string>& words) {
  for (const auto& word : words) {
    if (word == "--help")
      std::cout << help_text(usage);
    else if (word == "--version")
      std::cout << usage.program() << " " << PALPATE_VERSION << "\n";
    else if (word == "--describe")
      std::cout << describe(usage).dump(2) << "\n";
    else if (word == "--xml")
      std::cout << slicer_xml(usage);
    else if (word == "--catalogue")
      std::cout << catalogue_json(usage.catalogue).dump(2) << "\n";
    else
      continue;
    return true;
  }
  return false;
}

bool answered_question(const Group& group, const std::string& word) {
  if (word == "--help")
    std::cout << help_text(group);
  else if (word == "--version")
    std::cout << group.program << " " << PALPATE_VERSION << "\n";
  else if (word == "--describe")
    std::cout << describe(group).dump(2) << "\n";
  else if (word == "--xml")
    std::cout << slicer_xml(group);
  else if (word == "--catalogue")
    std::cout << catalogue_json(group.catalogue).dump(2) << "\n";
  else
    return false;
  return true;
}

void run_command(const Usage& usage, RunFunction run, const std::vector<std::string>& words) {
  if (answered_question(usage, words)) return;
  Command command(usage, words);
  execute(command, run);
}

int report(const std::string& program, ExitCode code, const std::string& message) {
  std::cerr << program << ": " << message << "\n";
  return static_cast<int>(code);
}

int defect(const std::string& program, const std::string& what) {
  return report(program, ExitCode::defect, "a defect of ours: " + what + "\n  try:   please report it with the command line");
}

/// Runs `work`, which returns an exit code; whatever it throws becomes a message and an exit code.
template <class Work>
int guarded(const std::string& program, const Work& work) {
  try {
    const int code = work();
    if (!std::cout.flush())
      throw Failure(ExitCode::unreadable, "cannot write the result", "standard output", "check free space (df -h)");
    return code;
  } catch (const Failure& failure) {
    return report(program, failure.code(), failure.what());
  } catch (const fs::filesystem_error& error) {
    return report(program, ExitCode::unreadable, error.what());
  } catch (const std::bad_alloc&) {
    return report(program, ExitCode::refused, "not enough memory\n  try:   a coarser mesh or scan, or a larger machine");
  } catch (const std::exception& error) {
    return defect(program, error.what());
  } catch (...) {
    return defect(program, "an exception of unknown type");
  }
}

int run_guarded(const Usage& usage, RunFunction run, const std::vector<std::string>& words) {
  return guarded(usage.program(), [&] {
    run_command(usage, run, words);
    return 0;
  });
}

}  // namespace

int run_program(int argc, char** argv, UsageFunction usage_of, RunFunction run) {
  Usage usage;
  usage_of(usage);
  return run_guarded(usage, run, {argv + 1, argv + argc});
}

int run_group(int argc, char** argv, Group group, const std::vector<GroupCommand>& commands, OtherwiseFunction otherwise) {
  for (const GroupCommand& command : commands) {
    Usage usage;
    usage.prefix = group.program + " ";
    command.usage_of(usage);
    group.commands.push_back(std::move(usage));
  }
  std::vector<std::string> rest(argv + 1, argv + argc);
  const std::string word = rest.empty() ? "" : rest.front();
  if (!rest.empty()) rest.erase(rest.begin());
  for (std::size_t i = 0; i < commands.size(); ++i)
    if (group.commands[i].name == word) return run_guarded(group.commands[i], commands[i].run, rest);
  return guarded(group.program, [&] {
    if (word.empty()) throw Failure(ExitCode::misuse, "missing: a command", "", "see " + group.program + " --help");
    return answered_question(group, word) ? 0 : otherwise(word, rest);
  });
}

}  // namespace palpate
