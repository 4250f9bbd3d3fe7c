// Trapped fluid: not offered.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/register.hpp>

namespace palpate::shortcuts {

Effect trapped_fluid() {
  Effect effect;
  effect.entry = {"clamp", "trapped_fluid", "fluid in the tube is squeezed aside and presses back", "", {}};
  effect.clamp_only = true;
  effect.absent = "the solver has no pressure that keeps a volume";
  return effect;
}

}  // namespace palpate::shortcuts
