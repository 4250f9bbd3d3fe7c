// A command line, parsed and checked against a program's usage.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <palpate/usage.hpp>

namespace palpate {

struct Arguments {
  Json options = Json::object();  ///< every option's value, common ones too; null when not given and without default
  std::map<std::string, std::filesystem::path> inputs, outputs;  ///< by the names usage() gave; "dicom/" is "dicom"
  std::map<std::string, std::vector<std::filesystem::path>> several;  ///< all of an input of which there may be several
};

/// Throws Failure(misuse): a missing file, one too many, an unknown option or choice (naming the nearest), a value that is no
/// number, not finite or out of range, an output whose extension is not that of its example in usage().
Arguments parse_arguments(const Usage& usage, const std::vector<std::string>& words);

}  // namespace palpate
