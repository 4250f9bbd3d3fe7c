// fibres: not offered.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/register.hpp>

namespace palpate::shortcuts {

Effect fibres() {
  Effect effect;
  effect.entry = {"material", "fibres", "the tissue is stiffer along its fibres", "", {}};
  effect.absent = "no closed form of an anisotropic contact; it needs a line tool and the solver's hgo law";
  return effect;
}

}  // namespace palpate::shortcuts
