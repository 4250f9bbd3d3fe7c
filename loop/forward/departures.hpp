// How an elastic curve may depart from that of a neo-Hookean tissue, in words that the closed forms and palpate-solve share.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <loop/forward/backbone.hpp>

namespace palpate::loop {

/// One way: another law (the null's own, or a stiffening), "compressibility", "capsule".
struct Departure {
  std::string name;
  double most;                          ///< amplitude beyond which it is not asked
  void (*add)(Tissue&, double amplitude);
  bool (*in)(const Tissue&);
  void (*remove)(Tissue&);              ///< the tissue without it; its initial shear modulus stays
};

const std::vector<Departure>& departures();
const Departure& departure_named(const std::string& name);

/// Amplitude at which the closed form's force at this depth changes by `share`, or the departure's most.
double amplitude_of(const Departure& departure, const Site& site, const Tissue& tissue, double depth_mm, double share);

/// Material of a case, with a skin as an effect: [material] and [[effect]] tables. Laws are neo-Hookean or the tissue's own, with one stiffening at most.
std::string material_text(const Tissue& tissue);

/// The [material] of a neo-Hookean law of modulus `mu` (MPa) with a stiffening of this kind (grid of the effect `stiffening`).
std::string stiffened_material(double mu, int kind, double amplitude);

}  // namespace palpate::loop
