// The two registers of effects: instruments (observation side) and shortcuts (tissue, contact, geometry, support in force space).
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <loop/forward/effect.hpp>

namespace palpate::instruments {
using loop::Effect, loop::Path, loop::Role, loop::Run, loop::Set, loop::Test;
/// Every effect of the folder, in alphabetical order (generated).
std::vector<Effect> all();
}  // namespace palpate::instruments

namespace palpate::shortcuts {
using loop::Effect, loop::Run, loop::Set, loop::Stiffening, loop::Tissue;
std::vector<Effect> all();
}  // namespace palpate::shortcuts

namespace palpate::loop {
/// Both registers: instruments first, they cost no solve.
const std::vector<Effect>& all_effects();
}  // namespace palpate::loop
