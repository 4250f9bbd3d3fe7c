// When to keep and when to renew: by counts alone, so that every run decides alike.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/implicit/kept_factor.hpp>

#include <solver/implicit/krylov.hpp>

namespace palpate::implicit {
namespace {

/// A factor that is worth fewer iterations than this is not kept.
constexpr int worth_keeping = 8;

SparseDirect solver_for(const BlockMatrix& K, int threads) {
  std::vector<int> rows, columns;
  K.coordinates(rows, columns);
  return SparseDirect(4 * K.nodes(), std::move(rows), std::move(columns), K.symmetric(), threads);
}

}  // namespace

KeptFactor::KeptFactor(const BlockMatrix& K, std::vector<char> fixed, bool keep, int threads)
    : fixed_(std::move(fixed)), keep_(keep), threads_(threads), solver_(solver_for(K, threads)), analysed_extensions_(K.extensions()) {}

bool KeptFactor::renew(const BlockMatrix& K) {
  const Stopwatch watch(work_.factor_s);
  std::vector<double> values;
  K.values(fixed_, values);
  if (analysed_extensions_ != K.extensions()) {
    solver_ = solver_for(K, threads_);
    analysed_extensions_ = K.extensions();
  }
  ++work_.factors;
  spent_ = 0;
  return current_ = held_ = solver_.factor(values);
}

/// Spending as much on a factor as another one costs, and no more, costs at most twice what the best choice would, whatever comes.
bool KeptFactor::solve(const BlockMatrix& K, const Eigen::VectorXd& weights, double tolerance, Eigen::VectorXd& x) {
  const int worth = solver_.worth();
  if (!current_ && held_ && keep_ && tolerance < 1 && worth >= worth_keeping && spent_ < worth) {
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
    const Krylov krylov = gmres(product, [&](Eigen::VectorXd& z) { solver_.solve(z); }, weights, tolerance, worth - spent_, x);
    spent_ += krylov.iterations;
    work_.iterations += krylov.iterations;
    x += given;
    if (krylov.found) return true;
  }
  if (!current_ && !(held_ && tolerance >= 1) && !renew(K)) return false;
  const Stopwatch watch(work_.solution_s);
  solver_.solve(x);
  return true;
}

void KeptFactor::keep(Archive& archive) {
  archive(analysed_extensions_, held_, current_, spent_);
  if (held_) archive(solver_);
  else if (archive.reading()) analysed_extensions_ = -1;
}

}  // namespace palpate::implicit
