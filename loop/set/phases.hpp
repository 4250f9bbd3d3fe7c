// Phases of a run from its displacement: load, hold, unload, rest.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <loop/set/set.hpp>

namespace palpate::loop {

/// One name per sample: `hold` where |du/dt| is under 2 % of the fastest (over a window of five samples), `load` and `unload` by its
/// sign; a slow stretch that lies under a third of the deepest point is `rest`. For compression tests load means away from rest.
std::vector<std::string> derived_phases(const Run& run);

}  // namespace palpate::loop
