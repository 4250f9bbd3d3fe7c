// The numbers of a model that a fit moves, with names, units, bounds and priors.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <loop/forward/model.hpp>

namespace palpate::loop {

struct FitParameter {
  std::string name;  ///< "mu", "zero_mm", "prony.g", "prony.tau"
  std::string unit;
  double* value = nullptr;  ///< into the model it was made of
  double low = 0, high = 0;
  bool logarithmic = false;
  double step = 0;          ///< of differences, in the fit's own coordinate
  double prior = 0, prior_sd = 0;  ///< 0: no prior
  double accuracy = 0;             ///< relative standard deviation that the model's own form adds to the fit's
  bool told_inverse = false;       ///< people are told 1/value
  double coordinate() const;
  /// Standard deviation in the fit's coordinate, from noise and from the model's form.
  double sd(double variance) const;
  /// Whether a fit that wants to go further by `gradient` is stopped by a bound.
  bool is_stopped(double gradient) const;
  void set_coordinate(double x);
};

/// Law, then what the rig leaves open, then every active effect: amplitude and, where it refines, shapes.
std::vector<FitParameter> fit_parameters(Model& model, const Set& set);

}  // namespace palpate::loop
