// The card beside every output: what made it, from what, with which options, and what was checked.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <palpate/json.hpp>

namespace palpate {

/// One check: `pass` is value against limit, NaN never passes.
struct Check {
  std::string name;
  Json value;
  std::string limit;  ///< as text: "≥ 8 deg"
  bool pass = false;
  std::string where;  ///< place of the worst, in mm; may be empty
};

Check check_at_least(const std::string& name, double value, double limit, const std::string& unit = "");
Check check_at_most(const std::string& name, double value, double limit, const std::string& unit = "");
Check check_equal(const std::string& name, long value, long limit);
Check check_true(const std::string& name, bool value, const std::string& where = "");

/// `<output>.card.json`
std::filesystem::path card_path(const std::filesystem::path& output);

/// SHA-256 in hex of a file, or of a folder: the hash of its sorted relative names and file hashes.
std::string sha256(const std::filesystem::path& path);

/// SHA-256 in hex of these bytes.
std::string sha256_of_bytes(std::string_view bytes);

/// SHA-256 in hex of the sorted relative names of a folder's files; `except` and their cards do not count, nor does what is
/// still being written.
std::string sha256_of_names(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& except);

/// True when the card beside each of `card.outputs` says that the same tool, version and options made these very bytes from
/// these very inputs. `card` is the one that would be written now, its outputs without hashes.
bool card_is_current(const Json& card, const std::filesystem::path& first_output);

}  // namespace palpate
