// The fit: whitened residuals of chosen runs, Gauss–Newton with Levenberg's damping in bounded, partly logarithmic parameters.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <limits>

#include <loop/methods/noise.hpp>
#include <loop/methods/parameters.hpp>

namespace palpate::loop {

/// A run's lateral force over its axial force, by least squares.
struct Lateral {
  std::size_t run = 0;
  double x = 0, y = 0, sd = 1;
};

/// Data of a fit. A block run adds one observation of the rig's compliance.
struct Problem {
  const Forward* forward = nullptr;
  std::vector<std::size_t> runs;    ///< indices into the set
  std::vector<Whitener> whiteners;  ///< one per run of `runs`
  double block_compliance = 0, block_compliance_sd = 0;  ///< sd 0: no block run
  std::vector<Lateral> laterals;
};

struct Fit {
  Model model;
  double chi2 = 0;               ///< whitened squares, priors included
  Eigen::MatrixXd covariance;    ///< of the fit's coordinates
  bool converged = false;
};

/// Columns over all data: blocks of the runs in N, then further rows in units of their standard deviation (priors, the block).
struct Stacked {
  Eigen::MatrixXd data, rows;
};

/// y − f.
Stacked residual(const Problem& problem, Model& model);
/// ∂f/∂x, columns as fit_parameters gives them.
Stacked tangents(const Problem& problem, Model& model);
/// (f(with the effect at `amplitude`) − f)/amplitude.
Stacked secant(const Problem& problem, Model& model, const Effect& effect, double amplitude, const std::vector<double>& shape);
/// L⁻¹ of the data above the rows.
Eigen::MatrixXd whitened(const Problem& problem, const std::vector<Whitener>& whiteners, const Stacked& columns);
/// What spares a fit work.
struct FitHelp {
  const Eigen::MatrixXd* tangents = nullptr;  ///< whitened, at the start; or nothing
  double hopeless_above = std::numeric_limits<double>::infinity();  ///< given up where four times the fall that its tangents promise leaves chi2 above this
};

/// Levenberg 1944; Marquardt 1963, with steps cut at the bounds.
Fit fitted(const Problem& problem, Model start, const FitHelp& help = {});
}  // namespace palpate::loop
