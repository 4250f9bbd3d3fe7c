// Scores z = (P s)·r/‖P s‖ of all columns, P = I − T(TᵀT)⁻¹Tᵀ, and their null distributions from bootstrapped sets of this protocol.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <loop/methods/candidates.hpp>

namespace palpate::loop {

struct Scores {
  std::vector<double> z, norm;      ///< of each column; norm = ‖P s‖
  std::vector<double> lambda;       ///< of each candidate: largest z² over its grid, z of the allowed sign
  std::vector<int> best;            ///< its column; −1: none of the allowed sign, or pruned
  double structure = 0;             ///< of P r: sum over stretches of six blocks of (sum/√n)²
  Eigen::MatrixXd directions;       ///< P s/‖P s‖
};

/// T, S and r are whitened; `lengths` are the blocks of each run, in order.
Scores score(const Eigen::MatrixXd& T, const Eigen::MatrixXd& S, const Eigen::VectorXd& r, const std::vector<Candidate>& candidates,
             const std::vector<Column>& columns, const std::vector<int>& lengths);

/// Sum over stretches of six blocks of (sum of whitened residuals/√n)²: large where neighbours agree.
double structure(const Eigen::VectorXd& r, const std::vector<int>& lengths);

/// What the null looks like: of each candidate the statistic's distribution, of all together the smallest p.
struct NullDistribution {
  std::vector<std::vector<double>> lambda;  ///< sorted, per candidate
  double threshold_p = 0;                   ///< claims need p below it
  double structure_limit = 0;               ///< exceeded by `level` of the nulls
  /// Share of nulls with a statistic at least this large; beyond the sample by the tail's power law (Hill 1975).
  double p(int candidate, double value) const;
};

/// Everything a bootstrapped null needs: the linear model, the noise, and which runs are replicates of each other.
struct NullProblem {
  const Problem* problem = nullptr;
  const Stacked *T = nullptr, *S = nullptr;
  const std::vector<Candidate>* candidates = nullptr;
  const std::vector<Column>* columns = nullptr;
  const std::vector<NoiseShape>* shapes = nullptr;
  const std::vector<int>* group = nullptr;
  Noise noise;
};

/// Draws data from the noise, estimates the noise again from the drawn replicates, whitens and scores. `seed` fixes the draws.
NullDistribution null_distribution(const NullProblem& null, int draws, std::uint64_t seed, int threads);

}  // namespace palpate::loop
