// Keys of a section as command-line options: name_with_underscores = value → --name-with-dashes=value.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include <palpate/settings.hpp>

namespace palpate {

/// The options of every key of `section` but `reserved`. `described` is the stage's --describe; files are relative to `base`.
/// Throws Failure(misuse) with file and line for a key that is no option (naming the nearest) and a value of the wrong kind.
std::vector<std::string> option_words(const Settings& section, const std::vector<std::string>& reserved, const Json& described,
                                      const std::filesystem::path& base);

}  // namespace palpate
