// TOML by toml++, with a record of every key that was asked for.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <palpate/settings.hpp>

#include <cmath>
#include <set>
#include <sstream>
#include <toml++/toml.h>

#include <palpate/errors.hpp>
#include <palpate/nearest.hpp>
#include <palpate/text_file.hpp>

namespace palpate {

struct Settings::Node {
  std::shared_ptr<toml::table> document;  ///< keeps `table` alive
  const toml::table* table = nullptr;
  std::filesystem::path file;
  std::string name;  ///< "solver.tool"; empty for the root
  std::set<std::string> asked;
  std::vector<std::shared_ptr<Node>> children;
};

namespace {

[[noreturn]] void misuse(const Settings& s, const std::string& key, const std::string& what, const std::string& next = "") {
  throw Failure(ExitCode::misuse, what, s.where(key), next);
}

const toml::node* find(const Settings::Node& node, const std::string& key) { return node.table->get(key); }

Json to_json(const toml::node& node) {
  if (const auto* array = node.as_array()) {
    Json json = Json::array();
    for (const auto& item : *array) json.push_back(to_json(item));
    return json;
  }
  if (node.is_boolean()) return node.as_boolean()->get();
  if (node.is_integer()) return node.as_integer()->get();
  if (node.is_floating_point()) return node.as_floating_point()->get();
  if (node.is_string()) return node.as_string()->get();
  return {};
}

/// The node of a sub-table: one for all who open it, so that what one of them asked for counts.
std::shared_ptr<Settings::Node> child_of(const std::shared_ptr<Settings::Node>& parent, const std::string& key,
                                         const toml::table& table) {
  for (const auto& child : parent->children)
    if (child->table == &table) return child;
  parent->children.push_back(
      std::make_shared<Settings::Node>(Settings::Node{parent->document, &table, parent->file, parent->name + key + ".", {}, {}}));
  return parent->children.back();
}

}  // namespace

Settings Settings::read(const std::filesystem::path& path) {
  auto node = std::make_shared<Node>();
  node->file = path;
  try {
    node->document = std::make_shared<toml::table>(toml::parse(read_text(path), path.string()));
  } catch (const toml::parse_error& error) {
    std::ostringstream where;
    where << path.string() << ":" << error.source().begin.line;
    throw Failure(ExitCode::unreadable, "not valid TOML: " + std::string(error.description()), where.str());
  }
  node->table = node->document.get();
  return Settings(node);
}

bool Settings::has(const std::string& key) const {
  node_->asked.insert(key);
  return find(*node_, key) != nullptr;
}

double Settings::real(const std::string& key, Range range) const {
  const Json json = value(key);
  if (!json.is_number() || !std::isfinite(json.get<double>())) misuse(*this, key, "not a finite number: " + key);
  expect_in(range, key, json);
  return json.get<double>();
}

void Settings::expect_in(Range range, const std::string& key, const Json& number) const {
  if (range.contains(number.get<double>())) return;
  std::ostringstream next;
  next << "a value from " << range.min << " to " << range.max;
  misuse(*this, key, "out of range: " + key + " = " + number.dump(), next.str());
}

double Settings::real(const std::string& key, double fallback, Range range) const {
  return has(key) ? real(key, range) : fallback;
}

long Settings::integer(const std::string& key, long fallback, Range range) const {
  if (!has(key)) return fallback;
  const double x = real(key, range);
  if (x != std::floor(x)) misuse(*this, key, "not a whole number: " + key);
  return static_cast<long>(x);
}

bool Settings::flag(const std::string& key, bool fallback) const {
  if (!has(key)) return fallback;
  const Json json = value(key);
  if (!json.is_boolean()) misuse(*this, key, "not true or false: " + key);
  return json.get<bool>();
}

std::string Settings::text(const std::string& key) const {
  const Json json = value(key);
  if (!json.is_string()) misuse(*this, key, "not text: " + key, "put it in quotes");
  return json.get<std::string>();
}

std::string Settings::text(const std::string& key, const std::string& fallback) const { return has(key) ? text(key) : fallback; }

std::string Settings::choice(const std::string& key, const std::vector<std::string>& choices) const {
  const std::string name = text(key);
  if (std::find(choices.begin(), choices.end(), name) == choices.end())
    misuse(*this, key, "unknown " + key + ": " + name, "did you mean " + nearest_name(name, choices) + "?");
  return name;
}

std::vector<double> Settings::reals(const std::string& key, Range range) const {
  const Json json = value(key);
  std::vector<double> numbers;
  if (json.is_array())
    for (const auto& item : json)
      if (item.is_number() && std::isfinite(item.get<double>())) numbers.push_back(item.get<double>());
  if (!json.is_array() || numbers.size() != json.size()) misuse(*this, key, "not a list of finite numbers: " + key);
  for (const auto& item : json) expect_in(range, key, item);
  return numbers;
}

Vec3 Settings::vec3(const std::string& key) const {
  const auto numbers = reals(key);
  if (numbers.size() != 3) misuse(*this, key, "not three numbers: " + key, key + " = [x, y, z]");
  return {numbers[0], numbers[1], numbers[2]};
}

Vec3 Settings::vec3(const std::string& key, const Vec3& fallback) const { return has(key) ? vec3(key) : fallback; }

Settings Settings::table(const std::string& key) const {
  if (!has(key)) misuse(*this, "", "missing table: [" + key + "]");
  const toml::table* inner = find(*node_, key)->as_table();
  if (!inner) misuse(*this, key, "not a table: " + key, "[" + key + "]");
  return Settings(child_of(node_, key, *inner));
}

std::vector<Settings> Settings::tables(const std::string& key) const {
  std::vector<Settings> list;
  if (!has(key)) return list;
  if (const auto* single = find(*node_, key)->as_table()) return {Settings(child_of(node_, key, *single))};
  const toml::array* array = find(*node_, key)->as_array();
  if (!array) misuse(*this, key, "not a list of tables: " + key, "[[" + key + "]]");
  for (const auto& item : *array) {
    if (!item.is_table()) misuse(*this, key, "not a list of tables: " + key, "[[" + key + "]]");
    list.push_back(Settings(child_of(node_, key, *item.as_table())));
  }
  return list;
}

Json Settings::value(const std::string& key) const {
  if (!has(key)) {
    // A key nobody asked for so far is the likely misspelling of the missing one.
    std::vector<std::string> unasked;
    for (const auto& name : keys())
      if (!node_->asked.contains(name)) unasked.push_back(name);
    misuse(*this, "", "missing key: " + node_->name + key,
           unasked.empty() ? "" : "is it written \"" + nearest_name(key, unasked) + "\" here?");
  }
  return to_json(*find(*node_, key));
}

std::vector<std::string> Settings::keys() const {
  std::vector<std::string> names;
  for (const auto& [key, item] : *node_->table) names.emplace_back(key.str());
  return names;
}

double Settings::number_at(const std::string& path) const {
  const auto number = node_->document->at_path(path).value<double>();
  if (!number) misuse(*this, "", "the file has no number " + path, "a path such as material.mu, effect[0].tau_s[1] or tool.aim_mm[0]");
  return *number;
}

void Settings::shift(const std::string& path, double change) {
  const double number = number_at(path) + change;
  const auto end = path.rfind(path.back() == ']' ? '[' : '.');
  auto& document = *node_->document;
  if (path.back() == ']') {
    auto& list = *document.at_path(path.substr(0, end)).as_array();
    list.replace(list.begin() + std::stoi(path.substr(end + 1)), number);
  } else {
    (end == std::string::npos ? document : *document.at_path(path.substr(0, end)).as_table()).insert_or_assign(path.substr(end + 1), number);
  }
}

const std::filesystem::path& Settings::file() const { return node_->file; }

std::string Settings::where(const std::string& key) const {
  const toml::node* node = key.empty() ? nullptr : find(*node_, key);
  const auto line = (node ? node->source() : node_->table->source()).begin.line;
  return node_->file.string() + (line ? ":" + std::to_string(line) : "");
}

void Settings::expect_all_read() const {
  for (const auto& key : keys()) {
    if (node_->asked.contains(key)) continue;
    const std::vector<std::string> known(node_->asked.begin(), node_->asked.end());
    misuse(*this, key, "unknown key: " + node_->name + key, "did you mean " + nearest_name(key, known) + "?");
  }
  for (const auto& child : node_->children) Settings(child).expect_all_read();
}

}  // namespace palpate
