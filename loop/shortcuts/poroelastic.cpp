// poroelastic: not offered.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/register.hpp>

namespace palpate::shortcuts {

Effect poroelastic() {
  Effect effect;
  effect.entry = {"stress", "poroelastic", "fluid is squeezed out of the tissue", "", {}};
  effect.absent = "it needs a field of its own in the solver";
  return effect;
}

}  // namespace palpate::shortcuts
