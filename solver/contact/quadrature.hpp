// Six points on a triangle, exact for polynomials of degree 4 (Dunavant 1985, Int. J. Numer. Meth. Eng. 21:1129, table II, p = 4).
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>

namespace palpate::contact {

constexpr int points_per_face = 6;

struct QuadraturePoint {
  double N[3];
  double weight;  ///< of the area
};

namespace dunavant {
constexpr double a1 = 0.445948490915965, w1 = 0.223381589678011;
constexpr double a2 = 0.091576213509771, w2 = 0.109951743655322;
}  // namespace dunavant

constexpr std::array<QuadraturePoint, points_per_face> quadrature = {
    {{{1 - 2 * dunavant::a1, dunavant::a1, dunavant::a1}, dunavant::w1},
     {{dunavant::a1, 1 - 2 * dunavant::a1, dunavant::a1}, dunavant::w1},
     {{dunavant::a1, dunavant::a1, 1 - 2 * dunavant::a1}, dunavant::w1},
     {{1 - 2 * dunavant::a2, dunavant::a2, dunavant::a2}, dunavant::w2},
     {{dunavant::a2, 1 - 2 * dunavant::a2, dunavant::a2}, dunavant::w2},
     {{dunavant::a2, dunavant::a2, 1 - 2 * dunavant::a2}, dunavant::w2}}};

}  // namespace palpate::contact
