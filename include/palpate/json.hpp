// The one door to the JSON library: ordered, so that files read as they were written.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>

namespace palpate {

using Json = nlohmann::ordered_json;

/// Parses a JSON file. Throws Failure(unreadable) naming file and position.
Json read_json(const std::filesystem::path& path);

/// Writes indented JSON; bytes that are not UTF-8 (names in old DICOM files) become U+FFFD. Throws Failure(unreadable) when the
/// disk is full.
void write_json(const std::filesystem::path& path, const Json& value);

}  // namespace palpate
