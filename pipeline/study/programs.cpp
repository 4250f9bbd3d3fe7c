// Stages answer --describe and --catalogue in JSON (include/palpate/command.cpp).
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/study/programs.hpp>

#include <unistd.h>

#include <algorithm>
#include <map>
#include <sstream>

#include <palpate/errors.hpp>
#include <pipeline/study/process.hpp>

namespace palpate {
namespace fs = std::filesystem;
namespace {

const std::string prefix = "palpate-";

std::string number_text(const Json& value, const char* when_null) {
  if (!value.is_number()) return when_null;
  std::ostringstream out;
  out << value.get<double>();
  return out.str();
}

void parameter_line(std::ostream& out, const Json& p) {
  const std::string unit = p.value("unit", "");
  out << "      " << p.value("name", "") << (unit.empty() || unit == "1" ? "" : " [" + unit + "]") << ": " << p.value("meaning", "") << ", "
      << number_text(p.value("min", Json()), "-∞") << " … " << number_text(p.value("max", Json()), "∞") << ", typically "
      << number_text(p.value("typical", Json()), "?") << "\n";
}

}  // namespace

std::vector<std::string> Programs::stages() const {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder_)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(prefix) && entry.is_regular_file() && access(entry.path().c_str(), X_OK) == 0) names.push_back(name.substr(prefix.size()));
  }
  std::sort(names.begin(), names.end());
  return names;
}

bool Programs::has(const std::string& stage) const {
  const auto names = stages();
  return std::find(names.begin(), names.end(), stage) != names.end();
}

Json Programs::ask(const std::string& stage, const std::string& question) const {
  const ProcessResult answer = run_process(path(stage), {question});
  Json json = Json::parse(answer.output, nullptr, false);
  if (answer.code != 0 || json.is_discarded())
    throw Failure(ExitCode::unreadable, "the program does not answer " + question + " in JSON", path(stage).string(), "build Palpate anew");
  return json;
}

Json whole_catalogue(const Programs& programs) {
  Json all = Json::array();
  for (const std::string& stage : programs.stages())
    for (Json entry : programs.ask(stage, "--catalogue")) {
      entry["program"] = prefix + stage;
      all.push_back(std::move(entry));
    }
  return all;
}

std::string catalogue_text(const Json& catalogue) {
  std::map<std::string, std::vector<const Json*>> by_kind;
  for (const Json& entry : catalogue) by_kind[entry.value("kind", "")].push_back(&entry);
  std::ostringstream out;
  for (const auto& [kind, entries] : by_kind) {
    out << kind << " (" << entries.front()->value("program", "") << ")\n";
    for (const Json* entry : entries) {
      const std::string reference = entry->value("reference", "");
      out << "  " << entry->value("name", "") << ": " << entry->value("sentence", "") << (reference.empty() ? "" : " [" + reference + "]") << "\n";
      for (const Json& p : entry->value("parameters", Json::array())) parameter_line(out, p);
    }
  }
  return out.str();
}

}  // namespace palpate
