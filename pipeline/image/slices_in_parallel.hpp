// A loop over slices shared by threads: slice k is done by exactly one of them, so results do not depend on their number.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <atomic>
#include <functional>
#include <thread>
#include <vector>

namespace palpate {

/// Calls body(k) for k = 0 … count − 1. `body` must write to slice k only and must not throw.
inline void slices_in_parallel(int count, int threads, const std::function<void(int)>& body) {
  std::atomic<int> next{0};
  const auto work = [&] {
    for (int k = next++; k < count; k = next++) body(k);
  };
  std::vector<std::jthread> helpers;
  for (int t = 1; t < threads && t < count; ++t) helpers.emplace_back(work);
  work();
}

}  // namespace palpate
