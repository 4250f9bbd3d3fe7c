// Errors before and after: in N, in % of the runs' largest forces, as a multiple of the noise floor; with intervals over runs.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <palpate/json.hpp>
#include <loop/methods/session.hpp>

namespace palpate::loop {

struct ErrorOf {
  double rms_N = 0, percent = 0, times_noise = 0;
  double low_N = 0, high_N = 0;  ///< 95 %, by resampling runs, or the tenths of a single one
  int runs = 0;
};

/// Over runs of a role (or `only` one), each weighing the same; `noise_N` is the rms of the noise model.
ErrorOf error_of(const Session& session, const Model& model, Role role, const std::string& only = "");

/// Rows of residuals: by run and phase, by phase, by rate, by depth, by cycle; each with blocks, mean and rms in N, χ²/n and the lag-1
/// correlation of whitened residuals, Ljung and Box' Q over five lags (1978, Biometrika 65:297) and the runs test's z (Wald and Wolfowitz 1940).
Json residual_table(const Session& session, const Model& model);

/// Rms of the noise model over the fit runs, N.
double noise_floor(const Session& session);

}  // namespace palpate::loop
