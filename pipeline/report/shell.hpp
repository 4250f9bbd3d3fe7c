// What every page has: head, style, script, footer; its sections.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

namespace palpate {

/// Nothing when there is no body.
std::string section(const std::string& id, const std::string& title, const std::string& body);

/// A table that may scroll sideways on a narrow screen.
std::string wide(const std::string& table);

/// The whole file, of HTML for the header and the main part; `versions` of Palpate that made what is shown.
std::string whole_page(const std::string& title, const std::string& header, const std::string& body, const std::string& versions);

}  // namespace palpate
