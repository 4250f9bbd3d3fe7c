// How an elastic curve may depart from that of a neo-Hookean tissue, in words that the closed forms and palpate-solve share.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <loop/forward/backbone.hpp>

namespace palpate::loop {

/// One way: another law (the null's own, or a stiffening), "compressibility", "capsule", "prestress", "thickness". Amplitudes have no modulus in them: of a capsule it is
/// E h/μ, of a pre-stress p/μ.
struct Departure {
  std::string name;
  double most;                          ///< amplitude beyond which it is not asked
  bool is_law;
  void (*add)(Tissue&, double amplitude);
  double (*amplitude)(const Tissue&);
  void (*remove)(Tissue&);              ///< the tissue without it; its initial shear modulus stays
  bool in(const Tissue& tissue) const { return amplitude(tissue) != 0; }
};

const std::vector<Departure>& departures();
const Departure& departure_named(const std::string& name);

/// Amplitude at which the closed form's force at this depth changes by `share`, or the departure's most; `share` itself of what the closed form does not know.
double amplitude_of(const Departure& departure, const Site& site, const Tissue& tissue, double depth_mm, double share);

/// Material of a case, with a skin and a pre-stress as effects: [material] and [[effect]] tables. Laws are neo-Hookean or the tissue's own, with one stiffening at most.
std::string material_text(const Tissue& tissue);

/// The [material] of a neo-Hookean law of modulus `mu` (MPa) with a stiffening of this kind (grid of the effect `stiffening`).
std::string stiffened_material(double mu, int kind, double amplitude);

}  // namespace palpate::loop
