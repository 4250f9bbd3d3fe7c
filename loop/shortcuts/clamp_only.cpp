// clamp_only: not offered.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/register.hpp>

namespace palpate::shortcuts {

Effect clamp_only() {
  Effect effect;
  effect.entry = {"clamp", "clamp_only", "self-contact knee, jaw angle, trapped fluid, extrusion", "", {}};
  effect.absent = "clamp runs come with the clamp";
  return effect;
}

}  // namespace palpate::shortcuts
