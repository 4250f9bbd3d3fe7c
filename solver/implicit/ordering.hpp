// The order in which a sparse matrix of nodes with four unknowns each is eliminated: nested dissection of the graph of nodes by METIS.
// (Karypis and Kumar 1998, SIAM J. Sci. Comput. 20:359.)
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

namespace palpate::implicit {

/// Place of every unknown in the elimination, one-based; `rows`, `columns`: entries, one-based, one of each pair (i, j), (j, i) is enough.
/// The same for the same pattern, in every run. `unknowns`: a multiple of four.
std::vector<int> nested_dissection(int unknowns, const std::vector<int>& rows, const std::vector<int>& columns);

}  // namespace palpate::implicit
