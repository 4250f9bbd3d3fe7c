// The page: everything about a study in one HTML file that needs no other.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include <pipeline/report/drawings.hpp>
#include <pipeline/report/study.hpp>

namespace palpate {

/// HTML of what other programs left in the study's folder; may be empty.
struct Additions {
  std::string missing_effect;  ///< what the loop found
  std::string side_by_side;    ///< results compared
};

/// The whole file.
std::string page_html(const Study& study, const Drawings& drawings, const Additions& additions);

}  // namespace palpate
