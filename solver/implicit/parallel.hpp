// Work shared among threads.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <thread>
#include <vector>

namespace palpate::implicit {

/// f(t) for t in [0, threads), each on a thread of its own; the caller's is t = 0.
template <class Function>
void on_threads(int threads, const Function& f) {
  std::vector<std::thread> workers;
  for (int t = 1; t < threads; ++t) workers.emplace_back([&f, t] { f(t); });
  f(0);
  for (auto& worker : workers) worker.join();
}

/// f(from, to) for a contiguous share of [0, count) on each thread.
template <class Function>
void in_shares(int count, int threads, const Function& f) {
  const auto start = [&](int t) { return static_cast<int>(static_cast<long long>(count) * t / threads); };
  on_threads(threads, [&](int t) { f(start(t), start(t + 1)); });
}

}  // namespace palpate::implicit
