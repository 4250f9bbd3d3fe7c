// The stages installed beside this program, and what each says about itself.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include <palpate/json.hpp>

namespace palpate {

/// The executables palpate-<stage> of a folder.
class Programs {
 public:
  explicit Programs(std::filesystem::path folder) : folder_(std::move(folder)) {}

  std::vector<std::string> stages() const;  ///< in alphabetical order
  bool has(const std::string& stage) const;
  std::filesystem::path path(const std::string& stage) const { return folder_ / ("palpate-" + stage); }
  /// What the stage answers to "--describe" or "--catalogue". Throws Failure(unreadable) when it is missing or does not answer in JSON.
  Json ask(const std::string& stage, const std::string& question) const;

 private:
  std::filesystem::path folder_;
};

/// Every stage's catalogue entries in one list, each with its "program".
Json whole_catalogue(const Programs& programs);

/// The list as text: by kind, name, sentence, reference, parameters with unit, range and typical value.
std::string catalogue_text(const Json& catalogue);

}  // namespace palpate
