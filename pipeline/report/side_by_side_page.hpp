// The section of a study's page that sets results side by side, from what palpate-compare wrote.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>

namespace palpate {

/// HTML of compare.json; empty where the folder has none. Throws Failure(unreadable) when it is damaged.
std::string side_by_side_html(const std::filesystem::path& folder);

}  // namespace palpate
