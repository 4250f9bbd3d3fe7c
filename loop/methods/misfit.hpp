// How badly a model fits, counting what is not known: the size of the noise, which comes from a few replicates, and the forms of the effects in the model.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <loop/methods/session.hpp>

namespace palpate::loop {

/// Of a band of noise whose variance was estimated with `degrees` of freedom: −2 log of the marginal density of `count` whitened coefficients with the sum of squares `squares`, less
/// what does not depend on them: (ν + n) log(1 + χ²/ν), a multivariate t (Cornish 1954). With many degrees of freedom it is χ².
double marginal_squares(double squares, int count, double degrees);

/// Columns, in N, of what the shortcuts of a model's first `effects` active effects may be off by; each column has a deviation of one. An effect's own: the change that it makes before anything
/// is fitted to it, times its accuracy, times Legendre's polynomials of depth of order 0 to 2, of each tool alone, and of effects that remember, on the way in and on the way out alone.
/// Two effects' interplay in the tissue: the product of their relative changes, as often, because no shortcut was compared for two at once (one after the other and both at once differ by that
/// much). What the instrument does to a reading is applied to it as it is, and has none.
Eigen::MatrixXd form_errors(const Session& session, const Model& model, std::size_t effects);

/// Whitened squares of form errors of three deviations, of all active effects: what explains more is no form error.
double largest_form_error(const Session& session, const Model& model);

/// −2 log-likelihood of a fit up to a constant: its chi2, less what form errors of its first `effects` active effects (all, if there are fewer) take away when they are fitted jointly with
/// everything else (linearly; their own squares are counted), and with every band of noise by marginal_squares. Without replicates the noise is what it is taken for.
double misfit(const Session& session, const Fit& fit, std::size_t effects = 99);

}  // namespace palpate::loop
