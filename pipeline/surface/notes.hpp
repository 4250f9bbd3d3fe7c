// What the card of a surface says: ledger, pieces, shape; and what a person should be warned of.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <set>
#include <string>
#include <vector>

#include <palpate/command.hpp>
#include <pipeline/surface/build_surface.hpp>

namespace palpate {

/// "1,2" → {1, 2}. Throws Failure(misuse).
std::set<int> label_list(const std::string& text);

/// Names of the regions that occur: those of a brought surface, or from the card of the labels when there is one, else
/// "label_<n>".
RegionNames region_names(Command& command, const Surface& surface);

/// Adds the volume ledger, what was dropped and filled, and the measures of the written surface to the card.
void note_surface(Command& command, const Surface& written, const SurfaceLedger& ledger);

/// Sentences about what was left out, and about labels cut by the edge of the scan.
std::vector<std::string> warnings(const SurfaceLedger& ledger);

}  // namespace palpate
