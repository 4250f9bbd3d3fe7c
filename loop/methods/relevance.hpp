// What makes a fitted effect a finding: within its plausible range, changing forces enough, and carried by the tests that were made.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <loop/methods/session.hpp>

namespace palpate::loop {

/// An amplitude at the edge of its plausible range says that another effect is meant. Of the last effect.
bool at_the_edge(const Fit& fit);

/// Whether all fitted runs are one kind of homogeneous test.
bool one_kind_of_test(const Set& set);

/// Data of one kind of test that change little but would change another test at the same I1 beyond all proportion do not carry a law: what it
/// says of the other test is made up.
bool made_up(const Session& session, const Model& before, const Model& after);

/// Whether the last effect of a model changes forces by more than repeatability and curves are known to; of a further effect that is to be claimed: by more than the form of the first is known to.
bool matters(const Session& session, const Model& model, bool as_further);

/// Whether the last effect of a model lowers the error in N at all: fits in which every block of a run weighs alike, with it and without. What explains only what noise was thought
/// to be is none; on a clamp, or of changes of an organ's own curve, where the fit is within noise already, what lowers it by less than a fifth. Of effects that lateral forces or a rigid block show: true.
bool lowers_error(const Session& session, const Model& model);

/// How much the last effect of a model changes the fitted forces, in deviations of noise, over the first `blocks` rows: the curves.
double whitened_change_by_last(const Session& session, Model model, int blocks);

/// Misfit beyond one per block.
double excess(const Session& session, double chi2);

}  // namespace palpate::loop
