// tool_pose: not offered.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/register.hpp>

namespace palpate::shortcuts {

Effect tool_pose() {
  Effect effect;
  effect.entry = {"tool", "tool_pose", "the tool is tilted or aims beside its point", "", {}};
  effect.absent = "on a flat layer it changes nothing but lateral force; it needs the aim's derivative from the solver";
  return effect;
}

}  // namespace palpate::shortcuts
