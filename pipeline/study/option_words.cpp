// The stage's own description says what kind each option is; its ranges and choices are the stage's to judge.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/study/option_words.hpp>

#include <algorithm>
#include <map>

#include <palpate/errors.hpp>
#include <palpate/nearest.hpp>

namespace palpate {
namespace {

std::string with(std::string text, char from, char to) {
  std::replace(text.begin(), text.end(), from, to);
  return text;
}

[[noreturn]] void wrong_kind(const Settings& section, const std::string& key, const std::string& example) {
  throw Failure(ExitCode::misuse, "wrong kind of value: " + key + " = " + section.value(key).dump(), section.where(key), key + " = " + example);
}

bool is_point(const Json& value) {
  return value.is_array() && value.size() == 3 && std::all_of(value.begin(), value.end(), [](const Json& x) { return x.is_number(); });
}

std::string point_text(const Json& point) { return point[0].dump() + "," + point[1].dump() + "," + point[2].dump(); }

void add_points(std::vector<std::string>& words, const Settings& section, const std::string& key, const std::string& option) {
  const Json value = section.value(key);
  const Json list = is_point(value) ? Json::array({value}) : value;
  if (!list.is_array() || !std::all_of(list.begin(), list.end(), is_point)) wrong_kind(section, key, "[[x, y, z], [x, y, z]] in mm");
  for (const Json& point : list) words.push_back(option + "=" + point_text(point));
}

void add_option(std::vector<std::string>& words, const Settings& section, const std::string& key, const Json& described, const std::filesystem::path& base) {
  const std::string option = "--" + described.at("name").get<std::string>(), kind = described.at("kind");
  const Json value = section.value(key);
  if (kind == "points") return add_points(words, section, key, option);
  if (kind == "flag") {
    if (!value.is_boolean()) wrong_kind(section, key, "true");
    if (value.get<bool>()) words.push_back(option);
  } else if (kind == "real" || kind == "integer") {
    if (!value.is_number()) wrong_kind(section, key, "a number");
    words.push_back(option + "=" + value.dump());
  } else {
    if (!value.is_string()) wrong_kind(section, key, "\"text\"");
    words.push_back(option + "=" + (kind == "file" ? (base / value.get<std::string>()).lexically_normal().string() : value.get<std::string>()));
  }
}

}  // namespace

std::vector<std::string> option_words(const Settings& section, const std::vector<std::string>& reserved, const Json& described,
                                      const std::filesystem::path& base) {
  std::map<std::string, Json> known;
  for (const Json& option : described.at("options")) known[with(option.at("name"), '-', '_')] = option;
  for (const Json& option : described.at("common_options"))
    if (option.at("name") == "seed") known["seed"] = option;
  std::vector<std::string> names = reserved, words;
  for (const auto& [name, option] : known) names.push_back(name);
  for (const std::string& key : section.keys()) {
    if (std::find(reserved.begin(), reserved.end(), key) != reserved.end()) continue;
    if (!known.contains(key))
      throw Failure(ExitCode::misuse, described.at("name").get<std::string>() + " has no option for the key " + key, section.where(key),
                    "did you mean " + nearest_name(key, names) + "?");
    add_option(words, section, key, known.at(key), base);
  }
  return words;
}

}  // namespace palpate
