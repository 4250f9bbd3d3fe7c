// Forces of effects on regions of a wall: traction times the nodes' share of area, as loads from outside.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include <solver/archive.hpp>
#include <solver/effects/effect.hpp>
#include <solver/explicit/motion.hpp>

namespace palpate::explicit_shell {

/// An effect on the forces and its region.
struct Bed {
  effects::Active active;
  struct Point {
    int node;
    double area;              ///< mm² at rest
    Eigen::Vector3d normal;   ///< of the wall's outside, at rest
  };
  std::vector<Point> points;
  std::vector<double> memory = {};  ///< of its points, one after the other
};

/// On triangles of the wall. Memory of rest.
Bed make_bed(const effects::Active& active, const Wall& wall, const std::vector<int>& triangles);

/// Largest stiffness of the beds over mass, at rest, 1/s²: what the stable step has to carry besides the wall's own.
double stiffness_per_mass(const std::vector<Bed>& beds, const Wall& wall);

/// Adds their forces at the present place.
void press(const std::vector<Bed>& beds, const Wall& wall, const WallState& state, std::vector<Lanes>& load);

/// What they remember of it; once a step.
void remember(std::vector<Bed>& beds, const Wall& wall, const WallState& state);

}  // namespace palpate::explicit_shell
