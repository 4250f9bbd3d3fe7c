// report.json: verdict, errors before and after, parameters, candidates, blind spots, next experiment, and the curves of the plots.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <palpate/json.hpp>
#include <loop/forward/solved_curves.hpp>
#include <loop/methods/searched.hpp>

namespace palpate::loop {

Json noise_json(const Session& session);
Json blind_spots_json(const Session& session, const Finding& finding);
Json candidates_json(const Session& session, const Finding& finding);
/// Value, 95 % interval, unit of every fitted number.
Json parameters_json(const Session& session, const Fit& fit);
/// The cheapest run that separates what is left; free ones first.
Json next_experiment(const Session& session, const Finding& finding);
/// The verdict in one sentence a surgeon understands.
std::string sentence(const Session& session, const Finding& finding);
/// What the fitted runs alone say: verdict, residuals before and after, candidates. Sealed runs stay sealed.
Json diagnosis_json(const Session& session, const Finding& finding);
/// Errors before and after on the sealed runs, together and by run.
Json validation_json(const Session& session, const Finding& finding, int looks);
/// Experiments, the cheapest first.
Json plan_json(const Session& session, const Finding& finding);
/// Everything; opens the sealed runs, of which `looks` says how often this happened in this folder before.
Json report_json(const Session& session, const Finding& finding, int looks);
/// What each solve of a site gave.
Json solves_json(const std::vector<SiteCurve>& curves);
/// What the search says with curves of finite and of small strain.
Json tried_json(const std::vector<CurveTried>& curves);
/// curves.csv: run, role, t, u, phase, measured, before, after, noise of every block.
std::string curves_csv(const Session& session, const Finding& finding);

}  // namespace palpate::loop
