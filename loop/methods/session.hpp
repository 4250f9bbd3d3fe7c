// A set made ready: forward model, noise from replicates and air, the null model fitted.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <memory>

#include <loop/methods/candidates.hpp>

namespace palpate::loop {

/// A law tried for law = "unknown": what it missed of runs left out.
struct LawTried {
  std::string law;
  double left_out_error = 0;
  Model model;  ///< fitted to all runs
};

struct Session {
  const Set* set = nullptr;
  std::unique_ptr<Forward> forward;
  Problem problem;
  std::vector<NoiseShape> shapes;
  std::vector<int> group;        ///< replicate group of each run of the problem; −1: none
  Noise noise;
  std::string sensor_source;     ///< where the sensor's noise comes from
  std::vector<LawTried> laws;    ///< tried, when the law was unknown
  Fit null;
  double depth_scale_mm = 1;
  int threads = 1;
};

/// A model at its start: law and the parameters the set gives, else its typical ones.
Model start_model(const Set& set, const std::string& law);

/// Throws Failure(refused) when there is no run to fit.
/// `correct` may teach the forward model what solves said; it may be empty.
Session prepared(const Set& set, const std::function<void(Forward&)>& correct = {});

/// The noise's directions and variances at this model, which is fitted again with them, and the null too: at a model that misses a large effect the directions of gain and contact are not what they are,
/// and a run's own gain looks like more than gain.
Fit renew_noise(Session& session, const Model& model);

/// The model fitted once more with every block of a run weighing the same: what it can do for the error in N.
Model with_equal_weights(const Session& session, const Model& model);

}  // namespace palpate::loop
