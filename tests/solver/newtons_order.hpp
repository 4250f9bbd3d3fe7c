// Whether Newton's residuals fall quadratically: r_{k+1} ≤ C r_k² with one C, in the last two falls before round-off.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <vector>

namespace palpate {

inline void expect_newtons_order(const std::vector<double>& r) {
  std::vector<double> orders;
  for (std::size_t k = 1; k + 1 < r.size(); ++k)
    if (r[k] < 1e-2 && r[k + 1] > 1e-14) orders.push_back(std::log(r[k + 1] / r[k]) / std::log(r[k] / r[k - 1]));
  for (double x : r) std::printf("  residual %.3e\n", x);
  ASSERT_FALSE(orders.empty());
  EXPECT_GE(orders.back(), 1.7);
}

}  // namespace palpate
