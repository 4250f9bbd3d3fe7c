// Elastic curves from palpate-solve, as a process: one per tool and place, at the null's start parameters.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>

#include <loop/forward/model.hpp>

namespace palpate::loop {

/// True when every ball presses a bonded block or cylinder at least two and a half heights from its sides: a layer, of which the closed form is within 0.5 %
/// and a mesh that is solved in a minute within 3 % (decision 042).
bool is_wide_layer(const Set& set);

/// True when the set's specimen can be solved: a case, or a bonded block or cylinder.
bool can_be_solved(const Set& set);

/// Solves every tool and place of the set's indentations with `solver` (palpate-solve); what is in the folder `kept` already is not solved again. Throws
/// Failure(not_converged) naming the tool when a solve does not reach 60 % of its depth.
std::vector<SiteCurve> solved_curves(const Set& set, const std::filesystem::path& solver, const std::filesystem::path& kept, int threads,
                                     const std::function<void(const std::string&)>& remark);

/// What the curves of a case are off by goes to its set: half of what its two meshes differ by, as they differ; and a fifth of that in any other shape,
/// and from tool to tool. Nothing where there is one mesh.
void tell_mesh_errors(const std::vector<SiteCurve>& curves, Set& set);

}  // namespace palpate::loop
