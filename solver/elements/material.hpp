// A material at work: a law and its numbers, with the effects on the stress around it, the first one innermost.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <vector>

#include <solver/effects/effect.hpp>
#include <solver/materials/law.hpp>
#include <solver/materials/volume_energy.hpp>

namespace palpate::elements {

/// An effect on the stress at work.
struct ActiveEffect : effects::Active {
  int memory_at = 0;  ///< where its part of a point's memory begins
  int memory = 0;     ///< how many numbers that is
};

struct Material {
  materials::Law law;
  std::vector<double> parameters;
  double bulk_modulus = 0;  ///< κ in MPa, may be infinite
  std::array<double, 2> volume_stiffening = {0, 0};  ///< 1/D2 and 1/D3 in MPa
  double density = 0;       ///< kg/m³, for gravity
  std::vector<ActiveEffect> effects = {};

  void add(const effects::Effect& effect, std::vector<double> effect_parameters);
  /// Numbers that a point remembers.
  int memory() const { return effects.empty() ? 0 : effects.back().memory_at + effects.back().memory; }

  /// The law alone, times a factor.
  materials::Response respond(const materials::Mat3& F, double modulus = 1, const materials::KnownLaw* known = nullptr, materials::KnownLaw* learns = nullptr, materials::Asked asked = materials::Asked::all) const;
  /// With its effects. `memory`: this->memory() numbers; point.kinematics is the law's.
  materials::Response respond(const effects::Point& point, const double* memory) const;
  /// The memory that an accepted step leaves, in place; the point asks for the stress alone.
  void remember(const effects::Point& point, double* memory) const;

  double shear_modulus() const { return law.shear_modulus(parameters); }
  materials::VolumeEnergy volume_energy(double modulus = 1) const {
    return {modulus * bulk_modulus, modulus * volume_stiffening[0], modulus * volume_stiffening[1]};
  }
};

}  // namespace palpate::elements
