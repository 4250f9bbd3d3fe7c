// Cards: hashing, checks, and the question whether an output is current.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <palpate/card.hpp>

#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <memory>
#include <sstream>

#include <palpate/catalogue.hpp>
#include <palpate/errors.hpp>

namespace palpate {
namespace fs = std::filesystem;
namespace {

class Sha256 {
 public:
  Sha256() { EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr); }
  void add(const char* data, std::size_t size) { EVP_DigestUpdate(context_.get(), data, size); }
  std::string hex() {
    std::array<unsigned char, 32> digest{};
    EVP_DigestFinal_ex(context_.get(), digest.data(), nullptr);
    static const char* digits = "0123456789abcdef";
    std::string text;
    for (unsigned char byte : digest) text += {digits[byte >> 4], digits[byte & 15]};
    return text;
  }

 private:
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_{EVP_MD_CTX_new(), EVP_MD_CTX_free};
};

std::string sha256_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Failure(ExitCode::unreadable, "cannot read the file", path.string(), "check the name and the permissions");
  Sha256 hash;
  std::vector<char> block(1 << 20);
  while (file.read(block.data(), block.size()) || file.gcount() > 0) hash.add(block.data(), file.gcount());
  if (file.bad()) throw Failure(ExitCode::unreadable, "cannot read the file", path.string(), "check the disk");
  return hash.hex();
}

std::string number_text(double x) {
  std::ostringstream out;
  out << x;
  return out.str();
}

Check bounded(const std::string& name, double value, const char* sign, double limit, const std::string& unit, bool pass) {
  return {name, finite_or_null(value), std::string(sign) + " " + number_text(limit) + (unit.empty() ? "" : " " + unit), pass, ""};
}

/// All paths of a card are relative to its folder; this is where they point.
fs::path from_card(const fs::path& output, const Json& file) {
  return fs::absolute(output).parent_path() / file.at("path").get<std::string>();
}

std::vector<fs::path> paths_of(const fs::path& output, const Json& files) {
  std::vector<fs::path> paths;
  for (const auto& file : files) paths.push_back(from_card(output, file));
  return paths;
}

bool same_file(const fs::path& path, const Json& file, const std::vector<fs::path>& outputs) {
  if (!fs::exists(path)) return false;
  const bool names = file.value("sha256_of", "bytes") == "names";
  return (names ? sha256_of_names(path, outputs) : sha256(path)) == file.at("sha256").get<std::string>();
}

/// `output` is the one beside which the card lies.
bool same_files(const fs::path& output, const Json& card) {
  const auto outputs = paths_of(output, card.at("outputs"));
  for (const char* list : {"outputs", "inputs"})
    for (const auto& file : card.at(list))
      if (!same_file(from_card(output, file), file, outputs)) return false;
  return true;
}

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files.push_back(fs::relative(entry.path(), folder));
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

Check check_at_least(const std::string& name, double value, double limit, const std::string& unit) {
  return bounded(name, value, "≥", limit, unit, value >= limit);
}
Check check_at_most(const std::string& name, double value, double limit, const std::string& unit) {
  return bounded(name, value, "≤", limit, unit, value <= limit);
}
Check check_equal(const std::string& name, long value, long limit) {
  return {name, value, "= " + std::to_string(limit), value == limit, ""};
}
Check check_true(const std::string& name, bool value, const std::string& where) { return {name, value, "= true", value, where}; }

fs::path card_path(const fs::path& output) {
  fs::path plain = output.has_filename() ? output : output.parent_path();  // "dicom/" is "dicom"
  return plain += ".card.json";
}

std::string sha256(const fs::path& path) {
  if (!fs::is_directory(path)) return sha256_file(path);
  Sha256 hash;
  for (const auto& file : files_in(path)) {
    const std::string line = file.generic_string() + " " + sha256_file(path / file) + "\n";
    hash.add(line.data(), line.size());
  }
  return hash.hex();
}

std::string sha256_of_bytes(std::string_view bytes) {
  Sha256 hash;
  hash.add(bytes.data(), bytes.size());
  return hash.hex();
}

std::string sha256_of_names(const fs::path& folder, const std::vector<fs::path>& except) {
  std::vector<fs::path> own;
  for (const auto& path : except)
    for (const fs::path& written : {path, card_path(path)}) own.push_back(fs::weakly_canonical(fs::absolute(written)));
  Sha256 hash;
  for (const auto& file : files_in(folder)) {
    const bool counts = file.generic_string().find(".partial-") == std::string::npos &&
                        std::find(own.begin(), own.end(), fs::weakly_canonical(fs::absolute(folder / file))) == own.end();
    const std::string line = file.generic_string() + "\n";
    if (counts) hash.add(line.data(), line.size());
  }
  return hash.hex();
}

bool card_is_current(const Json& now, const fs::path& output) {
  const fs::path path = card_path(output);
  if (!fs::exists(path)) return false;
  try {
    const Json card = read_json(path);
    for (const char* key : {"tool", "version", "options", "seed"})
      if (card.at(key) != now.at(key)) return false;
    const Json &declared = now.at("inputs"), &recorded = card.at("inputs");
    if (declared.size() > recorded.size() || card.at("outputs").empty()) return false;
    for (std::size_t i = 0; i < declared.size(); ++i)
      if (declared[i].at("name") != recorded[i].at("name") || declared[i].at("path") != recorded[i].at("path")) return false;
    return same_files(output, card);
  } catch (const Json::exception&) {
    return false;  // not a card of ours
  } catch (const Failure&) {
    return false;
  }
}

}  // namespace palpate
