// What a clamp's solved curves are off by: C = 4/3 (½ Σ_j d_j d_jᵀ / (n − 1) + ½ S K S), d_j what mesh j's ln(F + ε) is apart from the mean of n meshes, at all places, S deviations
// pooled over places, K the kernel exp(−|x − x'| / ℓ) of places of one way, less between ways and sites. (Ledoit & Wolf 2004, J. Multivariate Anal. 88:365: few samples, shrunk to a model.)
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>

namespace palpate::loop {

/// `apart`: rows as forms of ClampCurves (per site the places closing, then opening), a column per mesh. Returns columns whose products with independent unit deviations
/// have that covariance, largest first; those that matter less than a thousandth of the first are left out.
Eigen::MatrixXd own_errors(const Eigen::MatrixXd& apart);

}  // namespace palpate::loop
