// Text files, read and written whole.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>

namespace palpate {

/// The whole file. Throws Failure(unreadable).
std::string read_text(const std::filesystem::path& path);

/// Replaces the file's content. Throws Failure(unreadable) when not every byte could be written (full disk, no permission).
void write_text(const std::filesystem::path& path, const std::string& text);

}  // namespace palpate
