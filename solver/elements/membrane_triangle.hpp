// A membrane on a triangle, three nodes, no bending: F = Σ x_a ⊗ ∇N_a (3 × 2) in the plane of the rest triangle, f_a = A N ∇N_a with N = ∂W/∂F.
// (Bonet and Wood 2008, Nonlinear Continuum Mechanics for Finite Element Analysis, §9; constant strain.)
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>

#include <solver/effects/effect.hpp>

namespace palpate::elements {

/// Unknowns: the three corners, x, y, z each. N and N/mm.
struct MembraneSystem {
  Eigen::Matrix<double, 9, 1> residual = Eigen::Matrix<double, 9, 1>::Zero();
  Eigen::Matrix<double, 9, 9> tangent = Eigen::Matrix<double, 9, 9>::Zero();
  double energy = 0;          ///< N mm
  double internal_force = 0;  ///< size of the terms that cancel in the residual, N
};

/// The layer `active` on the triangle `rest`, moved to `now`, mm.
MembraneSystem membrane_triangle(const effects::Active& active, const std::array<Eigen::Vector3d, 3>& rest, const std::array<Eigen::Vector3d, 3>& now);

}  // namespace palpate::elements
