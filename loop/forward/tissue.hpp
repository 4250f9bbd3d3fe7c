// What the loop says of the tissue: law, and everything the effects of tissue, contact, geometry and support may change.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include <loop/forward/laws.hpp>

namespace palpate::loop {

struct PronyTerm {
  double g, tau_s;
};

struct Inclusion {
  Vec3 point_mm;    ///< of the site under which it lies
  double excess;    ///< stiffness at full influence, minus one
  double depth_mm;  ///< of its middle
};

/// A stretch of a tube's wall that is thicker than declared.
struct Zone {
  double excess, place_mm, half_mm;  ///< true over declared thickness, minus one; its middle along the tube, and half its length
};

struct Tissue {
  const Law* law = nullptr;
  std::vector<double> parameters;
  // The elastic curve.
  Stiffening stiffening;
  double nu = 0.5;
  double thickness_factor = 1;
  double tension_N_per_mm = 0;   ///< of a thin skin, or of the tissue under it
  double turgor_MPa = 0;         ///< tension all through the tissue, which a pressure in it balances; known from solves only
  double capsule_N_per_mm = 0;   ///< E h of a thin elastic skin
  std::vector<Inclusion> inclusions;
  std::vector<Zone> zones;       ///< of a clamped tube
  double jaw_angle_deg = 0;      ///< between the faces of a clamp's jaws
  double support_mm_per_N = 0;   ///< compliance of what carries the specimen
  double bed_mm_per_MPa = 0;     ///< softness of a bed of springs under a wide layer
  // Memory; lengths and rates are relative to the deepest point of the set.
  std::vector<PronyTerm> prony;
  double rate = 0, rate_reference_per_s = 0.01;
  double mullins = 0, mullins_scale = 0.3;
  double set_fraction = 0, set_yield = 0;
  double friction = 0;
  bool friction_slips = true;  ///< over the whole contact, as under dry compressible tissue; false: as solved for an incompressible one, which slips little
  double adhesion_J_per_m2 = 0;
  bool adhesion_on_retract_only = true;
};

}  // namespace palpate::loop
