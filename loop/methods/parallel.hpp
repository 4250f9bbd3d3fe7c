// The same work for every index of a range on a few threads; what is written for one index must not depend on another.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace palpate::loop {

/// Calls work(i) once for each i < count. After an exception no other is begun, and the first is thrown again here.
template <class Work>
void for_each_index(int count, int threads, const Work& work) {
  std::atomic<int> next = 0;
  std::atomic<bool> failed = false;
  std::exception_ptr failure;
  std::mutex mutex;
  const auto take = [&] {
    for (int i = next++; i < count && !failed; i = next++) try {
        work(i);
      } catch (...) {
        const std::lock_guard<std::mutex> lock(mutex);
        if (!failure) failure = std::current_exception();
        failed = true;
      }
  };
  std::vector<std::thread> helpers;
  for (int t = 1; t < std::min(threads, count); ++t) helpers.emplace_back(take);
  take();
  for (std::thread& t : helpers) t.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace palpate::loop
