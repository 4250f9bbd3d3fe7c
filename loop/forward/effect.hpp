// An effect that may be missing: what it changes, of which size it is tried, and what cannot be told from it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <span>
#include <string>
#include <vector>

#include <palpate/catalogue.hpp>
#include <loop/forward/tissue.hpp>

namespace palpate::loop {

using Path = std::vector<double>;

/// One amplitude e that switches it off at 0, and shape parameters that run over a grid. `entry.parameters` are the amplitude, then the
/// shapes; the amplitude's range is the physical one (signed when it reaches below 0) and its typical value the step of secants.
/// At most one of the functions per side is set; an effect with `absent` has none.
struct Effect {
  CatalogueEntry entry;
  std::vector<std::vector<double>> grid = {{}};
  std::vector<std::vector<double>> (*grid_of)(const Set& set) = nullptr;  ///< a grid that depends on the set, in place of `grid`
  double (*probe_of)(const Set& set) = nullptr;  ///< amplitude of the first secant, in place of the typical one
  bool refines = true;    ///< the shapes are fitted with the amplitude once the effect is taken
  std::string separates;  ///< the run that separates it from its likes; empty: none known
  int cost = 1;           ///< of that run: 0 free, 1 one more run, 2 a change of the rig or the specimen
  /// Observation side: the depth the tool really reaches, from the one read off; the force read off, from the one there is.
  void (*depth)(const Run& run, double e, std::span<const double> shape, Path& depth_mm) = nullptr;
  void (*force)(const Run& run, double e, std::span<const double> shape, Path& force_N) = nullptr;
  /// Lateral force over axial force, along x and y, that it adds to a run.
  std::array<double, 2> (*lateral)(const Run& run, double e, std::span<const double> shape) = nullptr;
  /// Compliance in series with the tool, mm/N.
  double (*compliance)(double e) = nullptr;
  /// Tissue, contact, geometry, support. Shapes are relative to the set: see Tissue.
  void (*tissue)(double e, std::span<const double> shape, Tissue& tissue) = nullptr;
  /// Relative standard deviation of what this shortcut says for a given amplitude, by comparison with solved curves and other discretisations, or for want of one
  /// our guess: intervals carry it, and a difference that it can make excludes no other explanation.
  double accuracy = 0.01;
  double difference = 0;       ///< relative step of differences, where small ones see stairs; 0: a thousandth of the typical amplitude
  bool needs_contact = false;  ///< homogeneous tests cannot show it
  bool needs_time = false;     ///< a set without times cannot show it
  bool needs_unload = false;   ///< nor one in which no run unloads
  bool needs_hold = false;     ///< nor one without hold, unloading and a second rate
  bool told_inverse = false;   ///< people are told one over the amplitude
  bool on_clamp = false;       ///< an effect on the tissue that a clamp's curves have
  bool clamp_only = false;     ///< and one that nothing else has
  bool repeats = false;        ///< it may be taken again with another shape (a second relaxation time)
  std::string (*known)(const Set& set) = nullptr;  ///< why the set leaves nothing to find; empty: it does
  std::string absent;  ///< why it is not offered; empty: it is
};

}  // namespace palpate::loop
