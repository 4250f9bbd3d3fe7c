// μ = E / (2 (1 + ν)), κ = E / (3 (1 − 2 ν)); ν up to ½.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <solver/materials/law.hpp>

namespace palpate::materials {

inline double hooke_shear_modulus(std::span<const double> p) { return p[0] / (2 * (1 + p[1])); }
inline double hooke_bulk_modulus(std::span<const double> p) {
  return p[1] < 0.5 ? p[0] / (3 * (1 - 2 * p[1])) : std::numeric_limits<double>::infinity();
}
inline std::vector<Parameter> hooke_parameters() {
  return {{"E", "MPa", {1e-9, 1e6}, 0.02, "Young's modulus"}, {"nu", "1", {0, 0.5}, 0.5, "Poisson's ratio; ½: incompressible"}};
}

}  // namespace palpate::materials
