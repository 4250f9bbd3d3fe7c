// The P1+/P1 mini-element: linear displacement and pressure on a tetrahedron, plus an interior bubble for the displacement,
// linear on each of the four sub-tetrahedra that share the barycentre; the bubble is condensed inside the element.
// (Arnold, Brezzi, Fortin 1984, A stable finite element for the Stokes equations, Calcolo 21:337.)
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <array>
#include <vector>

#include <palpate/catalogue.hpp>
#include <solver/elements/material.hpp>

namespace palpate::elements {

using Vec16 = Eigen::Matrix<double, 16, 1>;
using Mat16 = Eigen::Matrix<double, 16, 16>;

/// Rest shape: gradients of the four linear shape functions (3 × 4, 1/mm) and volume (mm³).
struct Tetrahedron {
  Eigen::Matrix<double, 3, 4> gradients;
  double volume = 0;
};

/// Throws std::domain_error unless the volume is positive. `X`: corners in columns, mm.
Tetrahedron tetrahedron(const Eigen::Matrix<double, 3, 4>& X);

/// What an element's sub-tetrahedra remember, one after the other, and since when.
struct History {
  const double* memory = nullptr;  ///< 4 × Material::memory() numbers; none needed without effects
  double time = 0, dt = 0;         ///< s
};

/// Unknowns node by node: (u_x, u_y, u_z, p) × 4; bubble displacement in mm.
struct ElementState {
  Vec16 nodal;
  Eigen::Vector3d bubble;
  History history = {};
  const effects::Start* starts = nullptr;  ///< of the four sub-tetrahedra; none: as the material says
  const materials::KnownLaw* known = nullptr;  ///< of the four sub-tetrahedra: asked instead of the law
  materials::KnownLaw* learns = nullptr;       ///< of the four sub-tetrahedra: told what the law said
  materials::Asked asked = materials::Asked::all;
};

enum class ElementFault { none, inverted, bubble_not_positive, bubble_not_converged };

struct ElementSystem {
  Vec16 residual;                                  ///< internal minus body force; N and mm³
  Mat16 tangent;                                   ///< condensed, symmetric
  double internal_force = 0;                       ///< size of the terms that cancel in the residual, N
  double energy = 0;                               ///< the potential without body force, N mm; of a material with effects it is that of the step
  ElementFault fault = ElementFault::none;
};

/// Mean of a corner's shape function over the sub-tetrahedron opposite to the corner, and over the others.
constexpr double near_weight = 1.0 / 16, far_weight = 5.0 / 16;
constexpr double mean_weight(int corner, int sub) { return corner == sub ? near_weight : far_weight; }

/// Where the sub-tetrahedra's centroids lie, columns, mm. `X`: corners in columns.
Eigen::Matrix<double, 3, 4> sub_centroids(const Eigen::Matrix<double, 3, 4>& X);

/// Density of body force at the four sub-tetrahedra's centroids, columns, N/mm³.
using BodyForce = Eigen::Matrix<double, 3, 4>;

/// How the bubble answers: its columns of the tangent before condensation, and the inverse of its own block.
struct Condensation {
  Eigen::Matrix<double, 16, 3> columns;
  Eigen::Matrix3d inverse;
};

/// Solves the bubble in place (state.bubble), then condenses. With a fault, the system is not valid. `kept`: is told how it condensed.
ElementSystem mini_element(const Tetrahedron& rest, const Material& material, ElementState& state, const BodyForce& body_force,
                           Condensation* kept = nullptr);

/// The residual close to an equilibrium whose condensation is known, without a tangent; the bubble takes one linear step.
Vec16 residual_beside(const Tetrahedron& rest, const Material& material, ElementState& state, const BodyForce& body_force, const Condensation& known);

/// Mean deformation gradient, Cauchy stress's von Mises value (MPa) and J of an element whose bubble is solved.
struct ElementResult {
  double von_mises = 0, J = 0;
};
ElementResult mini_element_result(const Tetrahedron& rest, const Material& material, const ElementState& state);

/// Writes the memory that the element's sub-tetrahedra keep of an accepted step, in place: 4 × Material::memory() numbers.
void remember(const Tetrahedron& rest, const Material& material, const ElementState& state, double* memory);

/// Part of `palpate list`.
CatalogueEntry mini_tetrahedron_entry();

}  // namespace palpate::elements
