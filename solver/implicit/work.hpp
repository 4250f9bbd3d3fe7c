// What a run's equilibria have cost: counts, and seconds, which nothing depends on.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <chrono>

namespace palpate::implicit {

struct Work {
  int assemblies = 0, factors = 0, iterations = 0;  ///< iterations of GMRES
  double assembly_s = 0, factor_s = 0, solution_s = 0;
};

/// Adds the time until its end to a sum.
class Stopwatch {
 public:
  explicit Stopwatch(double& sum) : sum_(sum), start_(std::chrono::steady_clock::now()) {}
  ~Stopwatch() { sum_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
  Stopwatch(const Stopwatch&) = delete;

 private:
  double& sum_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace palpate::implicit
