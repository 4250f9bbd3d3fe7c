// What else explains it: one effect in place of several, one in place of another, the same one with another shape.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <loop/methods/search.hpp>

namespace palpate::loop {

/// One effect that explains as well as several is the better explanation.
void simplify(Session& session, Finding& finding);

/// Shapes that a fit cannot move (a reference rate, a kind of friction, a law) were chosen while what was taken later was still missing: each is chosen again beside the others.
void choose_shapes_again(Session& session, Fit& current, const std::vector<Candidate>& candidates);

/// Every active effect is exchanged for every other; a better exchange becomes the model, near ones become alternatives.
void exchange(Session& session, Finding& finding);

/// A further effect of the last step that passed the threshold but not relevance is not claimed, and the data do not exclude it: the finding together with it is an alternative.
void add_unproven(Session& session, Finding& finding, double threshold_p);

}  // namespace palpate::loop
