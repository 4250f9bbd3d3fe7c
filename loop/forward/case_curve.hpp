// The elastic curve of a case and what changes it, from solves: on its own mesh, and on one that is finer under the tool.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>

#include <loop/forward/backbone.hpp>
#include <loop/forward/case_words.hpp>
#include <loop/forward/site_curve.hpp>
#include <loop/forward/site_solve.hpp>

namespace palpate::loop {

/// Solves the case as neo-Hookean on its own mesh and on one with edges half as long under the tool (palpate-remesh), and, for a case of one material, on its own mesh
/// every departure that `start` may have or turn to, and a motion with relaxation (memory_length). The curve is extrapolated from the meshes; changes are those on its own, or on the set's search_mesh
/// against the curve there (decision 045).
/// `law_open`: another law may be asked for; `inclusions_mm`: depths at which an inclusion may lie under this place. Gives the curve of the base, without departures. Throws as
/// `solved` does where the base fails; of a departure that fails the curve says so.
SolvedCurve solve_case(const SiteJob& job, const Site& site, const Tissue& start, bool law_open, const std::vector<double>& inclusions_mm, int threads, SiteCurve& curve);

/// What solve_case solves as its base: `start` without departures, of a case of one material; else `start`.
Tissue base_of_case(const Set& set, const Tissue& start);

}  // namespace palpate::loop
