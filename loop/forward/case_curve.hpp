// The elastic curve of a case and what changes it, from solves: on its own mesh, and on one that is finer under the tool.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>

#include <loop/forward/backbone.hpp>
#include <loop/forward/site_curve.hpp>
#include <loop/forward/site_solve.hpp>

namespace palpate::loop {

/// Solves the case as neo-Hookean on its own mesh and on one with edges half as long under the tool (palpate-remesh), and, for a case of one material, every
/// departure that `start` may have or turn to, on its own mesh. The curve is extrapolated from both meshes; changes are those on its own (decision 044).
/// Closed forms: `site`, with `start` as the null stands; `law_open`: another law may be asked for. Gives the curve of the base, without departures. Throws as `solved` does.
SolvedCurve solve_case(const SiteJob& job, const Site& site, const Tissue& start, bool law_open, int threads, SiteCurve& curve);

/// What solve_case solves as its base: `start` without departures, of a case of one material; else `start`.
Tissue base_of_case(const Set& set, const Tissue& start);

/// A case of several materials is solved as it is: a law of the loop stands for all of them.
bool has_one_material(const std::filesystem::path& case_file);

/// The mesh that a case names.
std::filesystem::path mesh_of_case(const std::filesystem::path& case_file);

/// A case's text without these tables, which are written anew.
std::string case_without(const std::string& text, const std::vector<std::string>& tables);

}  // namespace palpate::loop
