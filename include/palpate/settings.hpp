// TOML files people write, read so that every key must be asked for: a misspelt one is an error that names the nearest.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <palpate/catalogue.hpp>
#include <palpate/json.hpp>
#include <palpate/vec3.hpp>

namespace palpate {

/// One table of a TOML file. Every getter throws Failure(misuse) with file and line for a missing key, a wrong type, a number
/// out of range or not finite. Copies share the record of which keys were asked for.
class Settings {
 public:
  /// Reads a file. Throws Failure(unreadable) for a missing file or TOML syntax.
  static Settings read(const std::filesystem::path& path);

  bool has(const std::string& key) const;
  double real(const std::string& key, Range range = {}) const;
  double real(const std::string& key, double fallback, Range range = {}) const;
  long integer(const std::string& key, long fallback, Range range = {}) const;
  bool flag(const std::string& key, bool fallback) const;
  std::string text(const std::string& key) const;
  std::string text(const std::string& key, const std::string& fallback) const;
  /// One of `choices`, or an error that names the nearest.
  std::string choice(const std::string& key, const std::vector<std::string>& choices) const;
  Vec3 vec3(const std::string& key) const;
  Vec3 vec3(const std::string& key, const Vec3& fallback) const;
  std::vector<double> reals(const std::string& key, Range range = {}) const;
  /// A sub-table; throws when missing. Use has() first for an optional one.
  Settings table(const std::string& key) const;
  /// An array of tables [[key]], or a single [key]; empty when missing.
  std::vector<Settings> tables(const std::string& key) const;
  /// Any value as JSON (numbers, text, flags, arrays).
  Json value(const std::string& key) const;
  /// All keys of this table, in alphabetical order; does not count as asking for them.
  std::vector<std::string> keys() const;

  /// Adds `change` to a number of the file, "effect[0].tau_s[1]", in what all of its tables say. Throws Failure(misuse) when there is no
  /// such number.
  void shift(const std::string& path, double change);
  /// The number there; the same error.
  double number_at(const std::string& path) const;

  /// The file this came from, and "file:line" of a key (of the table itself for an empty key).
  const std::filesystem::path& file() const;
  std::string where(const std::string& key = "") const;

  /// Throws Failure(misuse) for the first key, here or in any sub-table that was opened, that nobody asked for.
  void expect_all_read() const;

  struct Node;

 private:
  void expect_in(Range range, const std::string& key, const Json& number) const;

  explicit Settings(std::shared_ptr<Node> node) : node_(std::move(node)) {}
  std::shared_ptr<Node> node_;
};

}  // namespace palpate
