// When to keep and when to renew: by counts alone, so that every run decides alike.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/implicit/kept_factor.hpp>

namespace palpate::implicit {
namespace {

/// A factor that is worth fewer iterations than this is not kept.
constexpr int worth_keeping = 8;
/// Iterations with a factor of the very matrix, after which single precision is not enough for it.
constexpr int most_to_refine = 20;

SparseDirect solver_of(const BlockMatrix& K, int threads, Precision precision) {
  std::vector<int> rows, columns;
  K.coordinates(rows, columns);
  return SparseDirect(4 * K.nodes(), std::move(rows), std::move(columns), K.symmetric(), threads, precision);
}

/// In single precision where it is going to be refined.
SparseDirect solver_for(const BlockMatrix& K, int threads, bool keep) {
  if (!keep) return solver_of(K, threads, Precision::full);
  SparseDirect solver = solver_of(K, threads, Precision::single);
  return solver.worth() >= worth_keeping ? std::move(solver) : solver_of(K, threads, Precision::full);
}

}  // namespace

KeptFactor::KeptFactor(const BlockMatrix& K, std::vector<char> fixed, bool keep, int threads)
    : fixed_(std::move(fixed)), keep_(keep), threads_(threads), solver_(solver_for(K, threads, keep)), analysed_extensions_(K.extensions()) {}

bool KeptFactor::renew(const BlockMatrix& K) {
  const Stopwatch watch(work_.factor_s);
  std::vector<double> values;
  K.values(fixed_, values);
  if (analysed_extensions_ != K.extensions()) {
    solver_ = solver_for(K, threads_, keep_);
    analysed_extensions_ = K.extensions();
  }
  ++work_.factors;
  spent_ = 0;
  return current_ = held_ = solver_.factor(values);
}

/// GMRES on the unknowns that are free; `x` holds the others' values.
Krylov KeptFactor::refine(const BlockMatrix& K, const Eigen::VectorXd& weights, double tolerance, int most, Eigen::VectorXd& x) {
  const Stopwatch watch(work_.solution_s);
  Eigen::VectorXd given = Eigen::VectorXd::Zero(x.size());
  for (int i = 0; i < x.size(); ++i)
    if (fixed_[i]) std::swap(given(i), x(i));
  const auto product = [&](const Eigen::VectorXd& z) {
    Eigen::VectorXd y = K.multiply(z);
    for (int i = 0; i < y.size(); ++i)
      if (fixed_[i]) y(i) = 0;
    return y;
  };
  const Krylov krylov = gmres(product, [&](Eigen::VectorXd& z) { solver_.solve(z); }, weights, tolerance, most, x);
  spent_ += krylov.iterations;
  work_.iterations += krylov.iterations;
  x += given;
  return krylov;
}

/// Spending as much on a factor as another one costs, and no more, costs at most twice what the best choice would, whatever comes.
bool KeptFactor::solve(const BlockMatrix& K, const Eigen::VectorXd& weights, double tolerance, Eigen::VectorXd& x) {
  const int worth = solver_.worth();
  const bool at_hand = held_ && tolerance >= 1;
  if (!at_hand && !current_ && held_ && keep_ && worth >= worth_keeping && spent_ < worth && refine(K, weights, tolerance, worth - spent_, x).found) return true;
  if (!at_hand && !current_ && !renew(K)) return false;
  if (!at_hand && solver_.precision() == Precision::single) {
    if (refine(K, weights, tolerance, most_to_refine, x).found) return true;
    solver_ = solver_of(K, threads_, Precision::full);
    if (!renew(K)) return false;
  }
  const Stopwatch watch(work_.solution_s);
  solver_.solve(x);
  return true;
}

bool KeptFactor::has_negative_pivots(const BlockMatrix& K, int count) {
  if (solver_.negative_pivots() == count || solver_.precision() == Precision::full) return solver_.negative_pivots() == count;
  const Stopwatch watch(work_.factor_s);
  std::vector<double> values;
  K.values(fixed_, values);
  SparseDirect exact = solver_of(K, threads_, Precision::full);
  ++work_.factors;
  return exact.factor(values) && exact.negative_pivots() == count;
}

void KeptFactor::keep(Archive& archive) {
  archive(analysed_extensions_, held_, current_, spent_);
  if (held_) archive(solver_);
  else if (archive.reading()) analysed_extensions_ = -1;
}

}  // namespace palpate::implicit
