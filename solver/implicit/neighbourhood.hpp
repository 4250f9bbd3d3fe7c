// What is known of an equilibrium for the sake of runs close beside it (sensitivities): how its laws and bubbles answer.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <map>
#include <vector>

#include <solver/archive.hpp>
#include <solver/implicit/model.hpp>

namespace palpate::materials {

inline void keep(Archive& a, KnownLaw& x) {
  a(x.F, x.P, x.W);
  for (float& entry : x.A.reshaped()) a(entry);
}
inline void keep(Archive& a, LawShift& x) { a(x.P, x.W); }

}  // namespace palpate::materials

namespace palpate::implicit {

struct Neighbourhood {
  std::vector<std::vector<double>> parameters;         ///< of every material's law
  std::vector<materials::KnownLaw> laws;               ///< of every sub-tetrahedron
  std::vector<elements::Condensation> condensations;  ///< of every tetrahedron
  std::vector<char> slides;                            ///< of every point of a region force: frozen, as the set of what touches is
  std::vector<contact::Branch> on_tools;               ///< of friction's points, as State::slips; frozen too
  std::map<std::size_t, contact::KnownCoulomb> on_organs;  ///< of friction's points, by their place in State::pair_slips
};

/// Of every sub-tetrahedron; none where all laws have the known numbers.
using LawShifts = std::vector<materials::LawShift>;

inline void keep(Archive& a, Neighbourhood& x) { a(x.parameters, x.laws, x.slides); }  // condensations are made before they are read

}  // namespace palpate::implicit
