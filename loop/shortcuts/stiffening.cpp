// Another law: a term that leaves the initial modulus alone, with one amplitude.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/register.hpp>

namespace palpate::shortcuts {

Effect stiffening() {
  Effect effect;
  effect.entry = {"material", "stiffening", "the tissue stiffens with strain otherwise than the law says: another law", "Demiray 1972; Mooney 1940; Yeoh 1993; Ogden 1972",
                  {{"amplitude", "1", {-60, 60}, 0.05, "b; share of I2 in %; C20/mu; C30/mu; alpha − 2"},
                     {"law", "1", {0, 4}, 0, "0: fung_demiray, 1: mooney_rivlin, 2: yeoh C20, 3: yeoh C30, 4: ogden"}}};
  effect.repeats = true;
  effect.accuracy = 0.05;
  effect.separates = "two radii at two depths; another test (tension, shear)";
  effect.grid = {{0}, {1}, {2}, {3}, {4}};
  effect.refines = false;
  effect.tissue = [](double e, std::span<const double> shape, Tissue& tissue) {
    Stiffening& s = tissue.stiffening;
    double* of_law[] = {&s.exponential, &s.second, &s.square, &s.cube, &s.power};
    *of_law[static_cast<int>(shape[0])] += shape[0] == 1 ? e / 100 : e;
  };
  return effect;
}

}  // namespace palpate::shortcuts
