// Elastic curves from palpate-solve, as a process: one per tool and place, at the null's start parameters.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>

#include <loop/forward/model.hpp>

namespace palpate::loop {

/// What one solve gave: the smooth factor between solved and closed curve, c₀ + c₁ x + c₂ x², x = depth over the deepest.
struct SiteCurve {
  std::string tool;
  Vec3 point_mm{0, 0, 0};
  double deepest_mm = 1;
  std::array<double, 3> factor{1, 0, 0};
  double scatter = 0;  ///< rms of the solved factor about the smooth one, weighted by force: the mesh's own roughness
  int nodes = 0;
};

/// True when every ball presses a bonded block or cylinder at least two and a half heights from its sides: a layer, of which the closed form is within 0.5 %
/// and a mesh that is solved in a minute within 3 % (decision 042).
bool is_wide_layer(const Set& set);

/// True when the set's specimen can be solved: a case, or a bonded block or cylinder.
bool can_be_solved(const Set& set);

/// Solves every tool and place of the set's indentations with `solver` (palpate-solve), in a folder of its own that is removed. Throws
/// Failure(not_converged) naming the site when a solve does not reach 60 % of its depth.
std::vector<SiteCurve> solved_curves(const Set& set, const std::filesystem::path& solver, const std::filesystem::path& scratch, int threads,
                                     const std::function<void(const std::string&)>& remark);

}  // namespace palpate::loop
