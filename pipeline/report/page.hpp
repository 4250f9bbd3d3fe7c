// The page: everything about a study in one HTML file that needs no other.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include <pipeline/report/drawings.hpp>
#include <pipeline/report/study.hpp>

namespace palpate {

/// The whole file.
std::string page_html(const Study& study, const Drawings& drawings);

}  // namespace palpate
