// Few meshes' differences, shrunk to a smooth kernel, as directions.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/clamp_errors.hpp>

#include <cmath>

#include <loop/forward/clamp.hpp>

namespace palpate::loop {
namespace {

constexpr double reach = 0.15;                    ///< ℓ, of the deepest closure: a fold that meets itself earlier is apart so far
constexpr double other_way = 0.8, other_site = 0.5;
constexpr double least = 1e-3;                    ///< of the largest variance, that is kept

double kernel(Eigen::Index a, Eigen::Index b) {
  const Eigen::Index ways = static_cast<Eigen::Index>(form_places.size()), site = static_cast<Eigen::Index>(forms_of_site);
  const double apart = std::abs(form_places[a % ways] - form_places[b % ways]);
  return std::exp(-apart / reach) * (a / ways % 2 == b / ways % 2 ? 1 : other_way) * (a / site == b / site ? 1 : other_site);
}

}  // namespace

Eigen::MatrixXd own_errors(const Eigen::MatrixXd& apart) {
  const Eigen::Index places = apart.rows(), meshes = apart.cols();
  Eigen::MatrixXd covariance = apart * apart.transpose() / static_cast<double>(meshes - 1);
  const Eigen::VectorXd own = covariance.diagonal(), sd = (0.5 * (own.array() + own.mean())).sqrt();
  for (Eigen::Index a = 0; a < places; ++a)
    for (Eigen::Index b = 0; b < places; ++b) covariance(a, b) = 0.5 * (1 + 1.0 / static_cast<double>(meshes)) * (covariance(a, b) + sd(a) * sd(b) * kernel(a, b));
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(covariance);
  Eigen::MatrixXd directions(places, places);
  Eigen::Index kept = 0;
  for (Eigen::Index k = places - 1; k >= 0 && eigen.eigenvalues()(k) > least * eigen.eigenvalues()(places - 1); --k)
    directions.col(kept++) = std::sqrt(eigen.eigenvalues()(k)) * eigen.eigenvectors().col(k);
  return directions.leftCols(kept);
}

}  // namespace palpate::loop
