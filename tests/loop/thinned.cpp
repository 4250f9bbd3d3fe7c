// Averages over neighbouring samples: fast ramps of a long run keep their samples, and means lie on the curve.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <loop/set/thinned.hpp>

using namespace palpate::loop;

namespace {

/// 6 mm in 0.6 s, 80 s of hold, and back, read at 50 Hz: of 4 060 samples 30 lie on a ramp. F = u^1.5.
Run fast_ramp_long_hold() {
  Run run;
  for (int i = 0; i < 4060; ++i) {
    const double t = 0.02 * i, u = std::min({10 * t, 6.0, std::max(10 * (81.2 - t), 0.0)});
    run.t.push_back(t);
    run.u.push_back(u);
    run.F.push_back(std::pow(u, 1.5));
    run.phase.push_back(t < 0.6 ? "load" : t < 80.6 ? "hold" : "unload");
  }
  run.line.assign(run.t.size(), 1);
  run.cycle.assign(run.t.size(), 0);
  return run;
}

}  // namespace

TEST(Thinned, FastRampsOfALongRunKeepTheirSamples) {
  Set set;
  set.runs = {fast_ramp_long_hold()};
  thin(set);
  const palpate::loop::Run& run = set.runs.front();
  EXPECT_EQ(std::count(run.phase.begin(), run.phase.end(), "load"), 30);
  EXPECT_LE(run.t.size(), 2 * 480u);
  for (std::size_t i = 0; i < run.t.size(); ++i) EXPECT_TRUE(std::abs(run.F[i] - std::pow(run.u[i], 1.5)) <= 1e-3) << run.t[i];
}
