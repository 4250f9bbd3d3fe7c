// Arnoldi by modified Gram-Schmidt; the small least-squares problem by Givens rotations.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/implicit/krylov.hpp>

#include <cmath>
#include <vector>

namespace palpate::implicit {

using Eigen::VectorXd;

Krylov gmres(const std::function<VectorXd(const VectorXd&)>& product, const std::function<void(VectorXd&)>& precondition, const VectorXd& weights,
             double tolerance, int most, VectorXd& x) {
  const VectorXd given = x;
  std::vector<VectorXd> basis{weights.cwiseProduct(x)}, directions, columns;  // V, Z and the upper triangle
  std::vector<Eigen::Vector2d> turns;                                         // cosine and sine
  const double whole = basis[0].norm();
  if (whole == 0) return {0, true};
  basis[0] /= whole;
  std::vector<double> left{whole};
  while (std::abs(left.back()) > tolerance * whole) {
    const int k = static_cast<int>(columns.size());
    if (k == most || !std::isfinite(left.back())) return {k, false};
    directions.push_back(basis[k].cwiseQuotient(weights));
    precondition(directions[k]);
    VectorXd w = weights.cwiseProduct(product(directions[k]));
    VectorXd h(k + 1);
    for (int i = 0; i <= k; ++i) {
      h(i) = basis[i].dot(w);
      w -= h(i) * basis[i];
    }
    const double beyond = w.norm();
    for (int i = 0; i < k; ++i) h.segment<2>(i) = Eigen::Vector2d(turns[i].dot(h.segment<2>(i)), turns[i](0) * h(i + 1) - turns[i](1) * h(i));
    const double radius = std::hypot(h(k), beyond);
    if (!(radius > 0)) return {k + 1, false};
    turns.emplace_back(h(k) / radius, beyond / radius);
    h(k) = radius;
    columns.push_back(std::move(h));
    left.push_back(-turns[k](1) * left[k]);
    left[k] *= turns[k](0);
    basis.push_back(beyond > 0 ? VectorXd(w / beyond) : w);
  }
  const int count = static_cast<int>(columns.size());
  x.setZero();
  for (int k = count - 1; k >= 0; --k) {
    const double y = left[k] / columns[k](k);
    for (int i = 0; i < k; ++i) left[i] -= y * columns[k](i);
    x += y * directions[k];
  }
  // Products of a bad preconditioner cancel: what was left by recurrence may not be what is left.
  if (weights.cwiseProduct(given - product(x)).norm() <= 2 * tolerance * whole) return {count, true};
  x = given;
  return {count, false};
}

}  // namespace palpate::implicit
