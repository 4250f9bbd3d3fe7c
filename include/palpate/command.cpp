// What run() sees of its command line, and what it may say.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <palpate/command.hpp>

#include <iostream>

#include <palpate/command_card.hpp>
#include <palpate/command_state.hpp>

namespace palpate {
namespace fs = std::filesystem;
namespace {

/// labels.nii.gz with the suffix ".sheet.png" → labels.sheet.png
fs::path side_output_path(const Command::State& state, const SideOutputSpec& side) {
  const fs::path& main = state.arguments.outputs.at(side.of);
  std::string name = main.filename().string();
  for (const char* extension : {".nii.gz", ".seg.nrrd"})
    if (name.ends_with(extension))
      return main.parent_path() / (name.substr(0, name.size() - std::string(extension).size()) + side.suffix);
  return main.parent_path() / (fs::path(name).stem().string() + side.suffix);
}

}  // namespace

Command::Command(const Usage& usage, const std::vector<std::string>& words) : state_(std::make_shared<State>()) {
  state_->usage = usage;
  state_->words = words;
  state_->arguments = parse_arguments(usage, words);
  for (const auto& [name, path] : state_->arguments.outputs) state_->targets[name] = path;
  for (const auto& side : usage.side_outputs) state_->targets[side.name] = side_output_path(*state_, side);
}

const fs::path& Command::input(const std::string& name) const { return state_->arguments.inputs.at(name); }
const std::vector<fs::path>& Command::inputs(const std::string& name) const { return state_->arguments.several.at(name); }
fs::path Command::output(const std::string& name) const { return state_->outputs.at(name).temporary(); }
fs::path Command::final_output(const std::string& name) const { return state_->targets.at(name); }

bool Command::has(const std::string& option) const { return !state_->arguments.options.at(option).is_null(); }
double Command::real(const std::string& option) const { return state_->arguments.options.at(option).get<double>(); }
long Command::integer(const std::string& option) const { return state_->arguments.options.at(option).get<long>(); }
std::string Command::text(const std::string& option) const { return state_->arguments.options.at(option).get<std::string>(); }
bool Command::flag(const std::string& option) const { return state_->arguments.options.at(option).get<bool>(); }
fs::path Command::file(const std::string& option) const { return state_->arguments.options.at(option).get<std::string>(); }
std::vector<Vec3> Command::points(const std::string& option) const {
  return state_->arguments.options.at(option).get<std::vector<Vec3>>();
}

int Command::threads() const { return thread_count(*state_); }
std::uint64_t Command::seed() const { return integer("seed"); }
bool Command::verbose() const { return flag("verbose"); }

Progress Command::progress(const std::string& label, std::size_t total) const { return Progress(label, total, flag("quiet")); }
void Command::say(const std::string& message) const {
  if (!flag("quiet")) std::cerr << state_->usage.program() << ": " << message << "\n";
}
void Command::print(const std::string& result) const { std::cout << result << "\n"; }
void Command::warn(const std::string& message) {
  state_->warnings.push_back(message);
  say("warning: " + message);
}
void Command::check(const Check& check) { state_->checks.push_back(check); }
void Command::note(const std::string& key, Json value) { state_->notes[key] = std::move(value); }
Json Command::identity() const { return identity_of(*state_); }
void Command::add_input(const std::string& name, const fs::path& path) { hash_input(*state_, name, path); }

}  // namespace palpate
