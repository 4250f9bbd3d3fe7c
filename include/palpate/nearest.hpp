// The known name nearest to a misspelt one, by edit distance (Levenshtein 1966).
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

namespace palpate {

/// The nearest of `known`; empty when `known` is empty.
std::string nearest_name(const std::string& name, const std::vector<std::string>& known);

}  // namespace palpate
