// What solves say of one tool at one place.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <string>
#include <vector>

#include <palpate/vec3.hpp>

namespace palpate::loop {

/// What a departure (departures.hpp) makes of the force, as solved at one or two sizes: the logarithm of the force with it over that without, over depth.
struct SolvedChange {
  std::string of;
  double depth_of_it_mm = 0;  ///< of an inclusion under this place
  struct Curve {
    double amplitude = 0;     ///< as Departure::amplitude tells it; of an inclusion ln(1 + excess)
    std::vector<double> depth_mm, log_ratio;
    double at(double depth) const;  ///< linear between the solved depths, beyond them as at them
  };
  std::vector<Curve> curves;  ///< by growing amplitude; none: not solved, and nothing is changed by it
  std::string failure;        ///< why not
  /// e (A + B e) through the solved sizes; of the other sign A e, beyond the last one along the tangent, or level where that turns back.
  double log_ratio(double amplitude, double depth) const;
};

/// An effect that remembers, or holds on to the tool: amplitude in the row of springs over that in the solver, for the same force.
struct SolvedSize {
  std::string of;
  double size = 1;
};

struct SiteCurve {
  std::string tool;
  Vec3 point_mm{0, 0, 0};
  double deepest_mm = 1;
  std::array<double, 3> factor{1, 0, 0};  ///< the smooth factor between solved and closed curve, c₀ + c₁ x + c₂ x²
  double scatter = 0;                     ///< rms of the solved factor about the smooth one, weighted by force: the mesh's own roughness
  double mesh_shift = 0;                  ///< logarithm of the force on a mesh that is twice as fine under the tool over that on the mesh itself: mean over depth,
  double mesh_apart = 0;                  ///< and rms about it; 0: not asked
  std::vector<double> mesh_depth_mm, mesh_change;  ///< this logarithm over depth: the direction in which the curve may be off
  double memory_mm = 0;                   ///< of Row; 0: springs stay as they are
  std::array<double, 2> memory_missed{0, 0};  ///< of a motion with relaxation, rms over the largest force: by springs as they are, and with this length
  double surface_mm = 0;                  ///< along the axis, from the run's point to where the tool first touches
  int nodes = 0, solves = 0;
  std::vector<SolvedChange> changes;
  std::vector<SolvedSize> sizes;
};

}  // namespace palpate::loop
