// Files of a card are named relative to the card, so that a folder of results can be moved.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <palpate/command_card.hpp>

#include <sched.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include <palpate/command_state.hpp>

namespace palpate {
namespace fs = std::filesystem;
namespace {

fs::path folder_of_card(const Command::State& state) {
  return fs::absolute(state.arguments.outputs.at(state.usage.outputs.front().name)).lexically_normal().parent_path();
}

std::string from_folder_of_card(const Command::State& state, const fs::path& path) {
  return fs::absolute(path).lexically_normal().lexically_proximate(folder_of_card(state)).generic_string();
}

Json file_json(const Command::State& state, const std::string& name, const fs::path& path, const Json& hash) {
  return {{"name", name}, {"path", from_folder_of_card(state, path)}, {"sha256", hash}};
}

bool is_open_folder(const Command::State& state, const std::string& name) {
  return std::any_of(state.usage.inputs.begin(), state.usage.inputs.end(),
                     [&](const ArgumentSpec& spec) { return spec.name == name.substr(0, name.find('[')) && spec.kind == ArgumentKind::open_folder; });
}

Json options_json(const Command::State& state) {
  Json json = Json::object();
  for (const auto& option : state.usage.options) {
    Json value = state.arguments.options.at(option.name);
    if (option.kind == OptionKind::file && !value.is_null()) value = from_folder_of_card(state, value.get<std::string>());
    json[option.name] = {{"value", value}, {"unit", option.unit}};
  }
  return json;
}

Json head(const Command::State& state, Json inputs) {
  return {{"schema", "palpate-card/1"},
          {"tool", state.usage.program()},
          {"version", PALPATE_VERSION},
          {"command", state.words},
          {"options", options_json(state)},
          {"inputs", std::move(inputs)},
          {"outputs", Json::array()},
          {"units", "mm, t, s, N, MPa"},
          {"space", "LPS"},
          {"seed", state.arguments.options.at("seed")}};
}

Json check_json(const Check& check) {
  Json json = {{"name", check.name}, {"value", check.value}, {"limit", check.limit}, {"pass", check.pass}};
  if (!check.where.empty()) json["where"] = check.where;
  return json;
}

double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return std::round(usage.ru_maxrss / 102.4) / 10;
}

bool lies_in(const fs::path& path, const fs::path& folder) {
  const fs::path inner = fs::weakly_canonical(fs::absolute(path)), outer = fs::weakly_canonical(fs::absolute(folder));
  return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

}  // namespace

std::vector<std::pair<std::string, fs::path>> declared_inputs(const Command::State& state) {
  std::vector<std::pair<std::string, fs::path>> inputs;
  for (const auto& spec : state.usage.inputs) {
    if (!spec.several) inputs.emplace_back(spec.name, state.arguments.inputs.at(spec.name));
    else
      for (const fs::path& path : state.arguments.several.at(spec.name)) inputs.emplace_back(spec.name + "[" + std::to_string(inputs.size()) + "]", path);
  }
  for (const auto& option : state.usage.options) {
    const Json& value = state.arguments.options.at(option.name);
    if (option.kind == OptionKind::file && !value.is_null()) inputs.emplace_back(option.name, value.get<std::string>());
  }
  return inputs;
}

Json card_before(const Command::State& state) {
  Json inputs = Json::array();
  for (const auto& [name, path] : declared_inputs(state)) inputs.push_back(file_json(state, name, path, {}));
  return head(state, std::move(inputs));
}

Json identity_of(const Command::State& state) {
  Json options = Json::object(), inputs = Json::array();
  for (const auto& option : state.usage.options)
    if (option.kind != OptionKind::file) options[option.name] = state.arguments.options.at(option.name);
  for (const auto& input : state.inputs) inputs.push_back({input.at("name"), input.at("sha256")});
  return {{"program", sha256("/proc/self/exe")}, {"options", options}, {"inputs", inputs}, {"threads", thread_count(state)},
          {"seed", state.arguments.options.at("seed")}};
}

void hash_inputs(Command::State& state) {
  std::vector<fs::path> own;
  for (const auto& [name, target] : state.targets) own.push_back(target);
  for (const auto& [name, path] : declared_inputs(state)) {
    if (!is_open_folder(state, name)) {
      hash_input(state, name, path);
      continue;
    }
    Json file = file_json(state, name, path, sha256_of_names(path, own));
    file["sha256_of"] = "names";
    state.inputs.push_back(file);
  }
}

void hash_input(Command::State& state, const std::string& name, const fs::path& path) {
  if (state.usage.outputs.empty()) return;  // no card
  expect_not_an_output(state, path);
  state.inputs.push_back(file_json(state, name, path, sha256(path)));
}

void expect_not_an_output(const Command::State& state, const fs::path& input) {
  for (const auto& [name, target] : state.targets)
    for (const fs::path& written : {target, card_path(target)})
      if (lies_in(input, written))
        throw Failure(ExitCode::misuse, "what is read would be replaced by the output " + name, input.string(),
                      "another name for the output");
}

Json card_after(const Command::State& state, double seconds) {
  Json card = head(state, state.inputs);
  for (const auto& [name, output] : state.outputs)
    card["outputs"].push_back(file_json(state, name, output.target(), sha256(output.temporary())));
  card["threads"] = thread_count(state);
  card["seconds"] = std::round(seconds * 1000) / 1000;
  card["peak_memory_mb"] = peak_memory_mb();
  card["warnings"] = state.warnings;
  card["checks"] = Json::array();
  for (const Check& check : state.checks) card["checks"].push_back(check_json(check));
  card["notes"] = state.notes;
  return card;
}

/// That this process may use: fewer than the machine has under taskset, or where a cluster deals them out.
int cores() {
  cpu_set_t ours;
  if (sched_getaffinity(0, sizeof ours, &ours) == 0) return CPU_COUNT(&ours);
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

int thread_count(const Command::State& state) {
  const long asked = state.arguments.options.at("threads").get<long>();
  return asked > 0 ? static_cast<int>(asked) : cores();
}

}  // namespace palpate
