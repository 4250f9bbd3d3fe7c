// What friction remembers when a step is found: of tools where every point was and its shear, of organs every point's anchor on the other surface.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <solver/implicit/assembly.hpp>

namespace palpate::implicit {

/// Of a state that was found with this contact; of empty sums: at rest, where nothing touches.
void remember_slips(const Model& model, const ContactSums& contact, State& state);

/// Of points between organs that carried these shears and slid beyond their bounds by so much (in the order of State::pair_pressures), on a mesh where
/// no step was found yet.
void anchor_again(const Model& model, const std::vector<contact::PairSlip>& carried, State& state);

}  // namespace palpate::implicit
