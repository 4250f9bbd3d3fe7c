// The page: everything about a study in one HTML file that needs no other.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include <pipeline/report/drawings.hpp>
#include <pipeline/report/study.hpp>

namespace palpate {

/// The whole file. `missing_effect`: HTML of what the loop found in this study; may be empty.
std::string page_html(const Study& study, const Drawings& drawings, const std::string& missing_effect);

}  // namespace palpate
