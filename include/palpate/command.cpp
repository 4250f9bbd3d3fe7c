// Parsing (CLI11), cards and commit: the life of every executable.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <palpate/command.hpp>

#include <CLI/CLI.hpp>

#include <sys/resource.h>

#include <chrono>
#include <iostream>
#include <map>
#include <sstream>
#include <thread>

#include <palpate/nearest.hpp>
#include <palpate/outputs.hpp>

namespace palpate {
namespace fs = std::filesystem;

struct Command::State {
  Usage usage;
  std::vector<std::string> arguments;
  Json options = Json::object();  ///< every option's value, common ones too
  std::map<std::string, fs::path> inputs, targets;
  std::vector<std::pair<std::string, fs::path>> added_inputs;
  std::map<std::string, PendingOutput> outputs;
  std::vector<std::string> warnings;
  std::vector<Check> checks;
  Json notes = Json::object();
};

namespace {

[[noreturn]] void misuse(const std::string& what, const std::string& where, const std::string& next) {
  throw Failure(ExitCode::misuse, what, where, next);
}

double parse_number(const OptionSpec& option, const std::string& text) {
  std::size_t end = 0;
  double value = 0;
  try {
    value = std::stod(text, &end);
  } catch (const std::exception&) {
    end = 0;
  }
  const bool whole = option.kind != OptionKind::integer || value == std::floor(value);
  if (end == 0 || end != text.size() || !std::isfinite(value) || !whole)
    misuse("not a " + std::string(option.kind == OptionKind::integer ? "whole " : "") + "number: " + text, "--" + option.name,
           "a number in " + option.unit);
  if (!option.range.contains(value)) {
    std::ostringstream range;
    range << "a value from " << option.range.min << " to " << option.range.max << " " << option.unit;
    misuse("out of range: " + text, "--" + option.name, range.str());
  }
  return value;
}

Json parse_point(const OptionSpec& option, const std::string& text) {
  Json point = Json::array();
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) point.push_back(parse_number(option, part));
  if (point.size() != 3) misuse("not a point: " + text, "--" + option.name, "three numbers in mm: 12.5,-3,40");
  return point;
}

Json parse_value(const OptionSpec& option, const std::string& text) {
  switch (option.kind) {
    case OptionKind::real: return parse_number(option, text);
    case OptionKind::integer: return static_cast<long>(parse_number(option, text));
    case OptionKind::points: return parse_point(option, text);
    case OptionKind::choice:
      for (const auto& choice : option.choices)
        if (choice == text) return text;
      misuse("unknown choice: " + text, "--" + option.name, "did you mean " + nearest_name(text, option.choices) + "?");
    default: return text;
  }
}

std::vector<OptionSpec> all_options(const Usage& usage) {
  std::vector<OptionSpec> options = usage.options;
  options.insert(options.end(), common_options().begin(), common_options().end());
  return options;
}

std::vector<ArgumentSpec> all_arguments(const Usage& usage) {
  std::vector<ArgumentSpec> arguments = usage.inputs;
  arguments.insert(arguments.end(), usage.outputs.begin(), usage.outputs.end());
  return arguments;
}

/// Words CLI11 left over: options nobody knows, or too many files.
void reject_extras(const Usage& usage, const std::vector<std::string>& extras) {
  if (extras.empty()) return;
  const std::string word = extras.front();
  if (!word.starts_with("-")) misuse("one file too many: " + word, "", "see " + usage.program() + " --help");
  std::vector<std::string> known;
  for (const auto& option : all_options(usage)) known.push_back("--" + option.name);
  misuse("unknown option: " + word, "", "did you mean " + nearest_name(word.substr(0, word.find('=')), known) + "?");
}

fs::path without_trailing_slash(const std::string& text) {
  const fs::path path(text);
  return path.has_filename() || !path.has_parent_path() ? path : path.parent_path();
}

void parse(Command::State& state) {
  CLI::App app;
  app.set_help_flag();
  app.allow_extras();
  std::map<std::string, std::vector<std::string>> given;
  std::map<std::string, bool> flags;
  const auto options = all_options(state.usage);
  for (const auto& option : options) {
    if (option.kind == OptionKind::flag)
      app.add_flag("--" + option.name, flags[option.name]);
    else
      app.add_option("--" + option.name, given[option.name])->expected(1)->allow_extra_args(false)->multi_option_policy(
          option.kind == OptionKind::points ? CLI::MultiOptionPolicy::TakeAll : CLI::MultiOptionPolicy::Throw);
  }
  const auto arguments = all_arguments(state.usage);
  std::vector<std::string> paths(arguments.size());
  for (std::size_t i = 0; i < arguments.size(); ++i) app.add_option(arguments[i].name, paths[i]);
  try {
    app.parse(std::vector<std::string>(state.arguments.rbegin(), state.arguments.rend()));
  } catch (const CLI::ParseError& error) {
    misuse(error.what(), "", "see " + state.usage.program() + " --help");
  }
  reject_extras(state.usage, app.remaining());
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (paths[i].empty())
      misuse("missing: " + arguments[i].name + " (" + arguments[i].meaning + ")", "", state.usage.program() + " --help shows the usage");
    (i < state.usage.inputs.size() ? state.inputs : state.targets)[arguments[i].name] = without_trailing_slash(paths[i]);
  }
  for (const auto& option : options) {
    Json value = option.default_value;
    if (option.kind == OptionKind::flag) value = flags[option.name];
    for (const auto& text : given[option.name])
      if (option.kind == OptionKind::points) value.push_back(parse_value(option, text));
      else value = parse_value(option, text);
    state.options[option.name] = value;
  }
}

void expect_inputs(const Command::State& state) {
  for (const auto& spec : state.usage.inputs) {
    const fs::path& path = state.inputs.at(spec.name);
    if (!fs::exists(path)) throw Failure(ExitCode::unreadable, "no such " + std::string(spec.kind == ArgumentKind::file ? "file" : "folder"), path.string(), "check the name of: " + spec.name);
    if (fs::is_directory(path) != (spec.kind != ArgumentKind::file))
      throw Failure(ExitCode::misuse, spec.kind == ArgumentKind::file ? "a folder, where a file is read" : "a file, where a folder is read",
                    path.string(), spec.meaning);
  }
  for (const auto& option : state.usage.options)
    if (option.kind == OptionKind::file && !state.options[option.name].is_null() && !fs::is_regular_file(state.options[option.name].get<std::string>()))
      throw Failure(ExitCode::unreadable, "no such file", state.options[option.name].get<std::string>(), "check --" + option.name);
}

fs::path side_output_path(const Command::State& state, const SideOutputSpec& side) {
  const fs::path& main = state.targets.at(side.of);
  std::string name = main.filename().string();
  for (const char* extension : {".nii.gz", ".seg.nrrd"})
    if (name.ends_with(extension)) return main.parent_path() / (name.substr(0, name.size() - std::string(extension).size()) + side.suffix);
  return main.parent_path() / (fs::path(name).stem().string() + side.suffix);
}

void open_outputs(Command::State& state) {
  const bool force = state.options["force"].get<bool>();
  for (const auto& spec : state.usage.outputs) {
    const auto kind = spec.kind == ArgumentKind::file ? PendingOutput::Kind::file : PendingOutput::Kind::folder;
    state.outputs.emplace(spec.name, PendingOutput(state.targets.at(spec.name), kind, force));
  }
  for (const auto& side : state.usage.side_outputs)
    state.outputs.emplace(side.name, PendingOutput(side_output_path(state, side), PendingOutput::Kind::file, force));
}

/// Files of a card are named relative to the card, so that a folder of results can be moved.
Json file_json(const std::string& name, const fs::path& path, const fs::path& card_folder, const Json& hash) {
  const fs::path relative = fs::absolute(path).lexically_normal().lexically_proximate(fs::absolute(card_folder).lexically_normal());
  return {{"name", name}, {"path", relative.generic_string()}, {"sha256", hash}};
}

enum class Hashes { include, omit };

/// The card as far as it is known before run(): what `--skip-current` compares.
Json card_of(const Command::State& state, Hashes hashes) {
  const fs::path folder = fs::absolute(state.targets.at(state.usage.outputs.front().name)).parent_path();
  Json options = Json::object();
  for (const auto& o : state.usage.options)
    if (o.kind == OptionKind::file && !state.options[o.name].is_null())
      options[o.name] = {{"value", fs::proximate(state.options[o.name].get<std::string>(), folder).generic_string()}, {"unit", o.unit}};
    else
      options[o.name] = {{"value", state.options[o.name]}, {"unit", o.unit}};
  Json inputs = Json::array();
  const auto add = [&](const std::string& name, const fs::path& path, bool hashed) {
    inputs.push_back(file_json(name, path, folder, hashed && hashes == Hashes::include ? Json(sha256(path)) : Json()));
  };
  for (const auto& spec : state.usage.inputs) add(spec.name, state.inputs.at(spec.name), spec.kind != ArgumentKind::open_folder);
  for (const auto& o : state.usage.options)
    if (o.kind == OptionKind::file && !state.options[o.name].is_null()) add(o.name, state.options[o.name].get<std::string>(), true);
  for (const auto& [name, path] : state.added_inputs) add(name, path, true);
  return {{"schema", "palpate-card/1"},
          {"tool", state.usage.program()},
          {"version", PALPATE_VERSION},
          {"command", state.arguments},
          {"options", options},
          {"inputs", inputs},
          {"outputs", Json::array()},
          {"units", "mm, t, s, N, MPa"},
          {"space", "LPS"},
          {"seed", state.options["seed"]}};
}

Json check_json(const Check& check) {
  Json json = {{"name", check.name}, {"value", check.value}, {"limit", check.limit}, {"pass", check.pass}};
  if (!check.where.empty()) json["where"] = check.where;
  return json;
}

void throw_failed_checks(const std::vector<Check>& checks) {
  std::string what, where;
  for (const Check& check : checks) {
    if (check.pass) continue;
    what += "\n  check failed: " + check.name + " is " + check.value.dump() + ", must be " + check.limit;
    if (where.empty()) where = check.where;
  }
  if (!what.empty()) throw Failure(ExitCode::check_failed, "the result is not delivered" + what, where, "other options; --verbose says more");
}

std::string plain_name(const Command::State& state, const std::string& output) {
  return state.outputs.at(output).target().string();
}

/// Cards first, then outputs: killed in between, a card that matches no bytes is left, and the stage runs again.
void commit(Command::State& state, Json card) {
  const fs::path folder = fs::absolute(state.targets.at(state.usage.outputs.front().name)).parent_path();
  for (const auto& [name, output] : state.outputs) {
    if (!fs::exists(output.temporary())) throw std::logic_error("run() did not write the output " + name);
    card["outputs"].push_back(file_json(name, output.target(), folder, sha256(output.temporary())));
  }
  for (const auto& spec : state.usage.outputs) {
    PendingOutput pending(card_path(plain_name(state, spec.name)), PendingOutput::Kind::file, true);
    write_json(pending.temporary(), card);
    pending.commit();
  }
  for (auto& [name, output] : state.outputs) output.commit();
}

double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return std::round(usage.ru_maxrss / 102.4) / 10;
}

void execute(Command& command, RunFunction run) {
  Command::State& state = command.state();
  expect_inputs(state);
  if (state.usage.outputs.empty()) return run(command);
  if (state.options["skip-current"].get<bool>() &&
      card_is_current(card_of(state, Hashes::omit), state.targets.at(state.usage.outputs.front().name))) {
    command.print("current");
    return;
  }
  open_outputs(state);
  const auto start = std::chrono::steady_clock::now();
  run(command);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  throw_failed_checks(state.checks);
  Json card = card_of(state, Hashes::include);
  card["threads"] = command.threads();
  card["seconds"] = std::round(seconds * 1000) / 1000;
  card["peak_memory_mb"] = peak_memory_mb();
  card["warnings"] = state.warnings;
  card["checks"] = Json::array();
  for (const Check& check : state.checks) card["checks"].push_back(check_json(check));
  card["notes"] = state.notes;
  commit(state, std::move(card));
}

Json catalogue_json(const Usage& usage) {
  Json entries = Json::array();
  if (usage.catalogue)
    for (const auto& entry : usage.catalogue()) entries.push_back(to_json(entry));
  return entries;
}

/// --help and its kin; true when one of them was asked for.
bool answered_question(const Usage& usage, const std::vector<std::string>& arguments) {
  for (const auto& word : arguments) {
    if (word == "--help") std::cout << help_text(usage);
    else if (word == "--version") std::cout << usage.program() << " " << PALPATE_VERSION << "\n";
    else if (word == "--describe") std::cout << describe(usage).dump(2) << "\n";
    else if (word == "--xml") std::cout << slicer_xml(usage);
    else if (word == "--catalogue") std::cout << catalogue_json(usage).dump(2) << "\n";
    else continue;
    return true;
  }
  return false;
}

int report(const std::string& program, ExitCode code, const std::string& message) {
  std::cerr << program << ": " << message << "\n";
  return static_cast<int>(code);
}

int run_command(const Usage& usage, RunFunction run, const std::vector<std::string>& arguments) {
  if (!answered_question(usage, arguments)) {
    Command command(usage, arguments);
    execute(command, run);
  }
  return std::cout.flush() ? 0 : 3;
}

bool answered_group_question(const Group& group, const std::string& word) {
  if (word == "--help") std::cout << help_text(group);
  else if (word == "--version") std::cout << group.program << " " << PALPATE_VERSION << "\n";
  else if (word == "--describe") std::cout << describe(group).dump(2) << "\n";
  else if (word == "--xml") std::cout << slicer_xml(group);
  else if (word == "--catalogue") std::cout << "[]\n";
  else return false;
  return true;
}

/// Runs `work`; whatever it throws becomes a message and an exit code.
template <class Work>
int guarded(const std::string& program, Work work) {
  try {
    return work();
  } catch (const Failure& failure) {
    return report(program, failure.code(), failure.what());
  } catch (const fs::filesystem_error& error) {
    return report(program, ExitCode::unreadable, error.what());
  } catch (const std::bad_alloc&) {
    return report(program, ExitCode::refused, "not enough memory\n  try:   a coarser mesh or scan, or a larger machine");
  } catch (const std::exception& error) {
    return report(program, ExitCode::defect, std::string("a defect of ours: ") + error.what() + "\n  try:   please report it with the command line");
  }
}

}  // namespace

Command::Command(const Usage& usage, const std::vector<std::string>& arguments) : state_(std::make_shared<State>()) {
  state_->usage = usage;
  state_->arguments = arguments;
  parse(*state_);
}

const fs::path& Command::input(const std::string& name) const { return state_->inputs.at(name); }
fs::path Command::output(const std::string& name) const { return state_->outputs.at(name).temporary(); }
fs::path Command::final_output(const std::string& name) const { return state_->outputs.at(name).target(); }

bool Command::has(const std::string& option) const { return !state_->options.at(option).is_null(); }
double Command::real(const std::string& option) const { return state_->options.at(option).get<double>(); }
long Command::integer(const std::string& option) const { return state_->options.at(option).get<long>(); }
std::string Command::text(const std::string& option) const { return state_->options.at(option).get<std::string>(); }
bool Command::flag(const std::string& option) const { return state_->options.at(option).get<bool>(); }
fs::path Command::file(const std::string& option) const { return state_->options.at(option).get<std::string>(); }
std::vector<Vec3> Command::points(const std::string& option) const { return state_->options.at(option).get<std::vector<Vec3>>(); }

int Command::threads() const {
  const long asked = integer("threads");
  return asked > 0 ? static_cast<int>(asked) : std::max(1u, std::thread::hardware_concurrency());
}
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
void Command::add_input(const std::string& name, const fs::path& path) { state_->added_inputs.emplace_back(name, path); }

int run_program(int argc, char** argv, UsageFunction usage_of, RunFunction run) {
  Usage usage;
  usage_of(usage);
  return guarded(usage.program(), [&] { return run_command(usage, run, {argv + 1, argv + argc}); });
}

int run_group(int argc, char** argv, Group group, const std::vector<GroupCommand>& commands, OtherwiseFunction otherwise) {
  for (const GroupCommand& command : commands) {
    Usage usage;
    usage.prefix = group.program + " ";
    command.usage_of(usage);
    group.commands.push_back(std::move(usage));
  }
  std::vector<std::string> rest(argv + 1, argv + argc);
  if (rest.empty()) return guarded(group.program, [&]() -> int { misuse("missing: a command", "", "see " + group.program + " --help"); });
  const std::string word = rest.front();
  rest.erase(rest.begin());
  for (std::size_t i = 0; i < commands.size(); ++i)
    if (group.commands[i].name == word)
      return guarded(group.commands[i].program(), [&] { return run_command(group.commands[i], commands[i].run, rest); });
  return guarded(group.program, [&] {
    if (answered_group_question(group, word)) return std::cout.flush() ? 0 : 3;
    return otherwise(word, rest);
  });
}

}  // namespace palpate
