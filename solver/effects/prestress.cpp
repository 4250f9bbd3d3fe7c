// The tissue is under an isotropic tension p that the pressure p of blood or fluid balances: nothing moves at rest, and deformed it is
// stiffer, as a string is. (elements/turgor.hpp; initial stress: Holzapfel 2000, Nonlinear Solid Mechanics, §3.4.)
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/effects/effect.hpp>

namespace palpate::effects {

Effect prestress() {
  return {.entry = {"effect", "prestress", "perfusion or turgor: the tissue is under tension, what fills it under pressure; as stiff more as a string is",
                    "Holzapfel 2000, Nonlinear Solid Mechanics, section 3.4 (initial stress)",
                    {{"p_kPa", "kPa", {0, 1000}, 1, "the tension, and the pressure that balances it"}}},
          .start = {.begin = [](const Eigen::Vector3d&, std::span<const double> p, Start& start) { start.turgor += 1e-3 * p[0]; }}};
}

}  // namespace palpate::effects
