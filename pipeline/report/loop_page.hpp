// The page of a loop: verdict, curves before and after, residuals, candidates, blind spots.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include <pipeline/report/findings.hpp>

namespace palpate {

/// The verdict in a few words and in one sentence, for a section of a study's page. Throws Failure(unreadable) when the report lacks
/// what a page needs.
std::string verdict_html(const Findings& findings);

/// The whole file; throws like verdict_html.
std::string loop_page_html(const Findings& findings);

}  // namespace palpate
