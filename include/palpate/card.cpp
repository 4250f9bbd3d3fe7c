// Cards: hashing, checks, and the question whether an output is current.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <palpate/card.hpp>

#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <fstream>
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

bool same_files(const fs::path& output, const Json& files) {
  return std::all_of(files.begin(), files.end(), [&](const Json& file) {
    const fs::path path = from_card(output, file);
    return file.at("sha256").is_null() || (fs::exists(path) && sha256(path) == file.at("sha256").get<std::string>());
  });
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
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(path))
    if (entry.is_regular_file()) files.push_back(fs::relative(entry.path(), path));
  std::sort(files.begin(), files.end());
  Sha256 hash;
  for (const auto& file : files) {
    const std::string line = file.generic_string() + " " + sha256_file(path / file) + "\n";
    hash.add(line.data(), line.size());
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
    const Json &declared = now.at("inputs"), &recorded = card.at("inputs"), &outputs = card.at("outputs");
    if (declared.size() > recorded.size() || outputs.empty()) return false;
    for (std::size_t i = 0; i < declared.size(); ++i)
      if (declared[i].at("name") != recorded[i].at("name") || declared[i].at("path") != recorded[i].at("path")) return false;
    return same_files(output, recorded) && same_files(output, outputs);
  } catch (const Json::exception&) {
    return false;  // not a card of ours
  } catch (const Failure&) {
    return false;
  }
}

}  // namespace palpate
