// Threads for pieces of work of some ten microseconds.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <atomic>
#include <functional>
#include <thread>
#include <utility>
#include <vector>

namespace palpate::explicit_shell {

inline void breathe() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
}

/// A barrier whose threads look again and again for a tenth of a millisecond before they sleep: the pieces between two are hardly longer than it takes to wake one.
class Meeting {
 public:
  explicit Meeting(int size) : size_(size) {}
  void wait() {
    const unsigned before = turn_.load(std::memory_order_acquire);
    if (arrived_.fetch_add(1, std::memory_order_acq_rel) + 1 == size_) {
      arrived_.store(0, std::memory_order_relaxed);
      turn_.fetch_add(1, std::memory_order_release);
      turn_.notify_all();
      return;
    }
    for (int look = 0; look < 10000; ++look, breathe())
      if (turn_.load(std::memory_order_acquire) != before) return;
    turn_.wait(before, std::memory_order_acquire);
  }

 private:
  const int size_;
  std::atomic<int> arrived_ = 0;
  std::atomic<unsigned> turn_ = 0;
};

/// Threads that all call the same piece of work with their number, between two meetings.
struct Team {
  explicit Team(int count) : meeting(count), size(count) {
    for (int t = 1; t < size; ++t)
      threads.emplace_back([this, t] {
        for (;;) {
          meeting.wait();
          if (done) return;
          (*work)(t);
          meeting.wait();
        }
      });
  }
  ~Team() {
    done = true;
    meeting.wait();
    for (auto& thread : threads) thread.join();
  }
  void run(const std::function<void(int)>& f) {
    work = &f;
    meeting.wait();
    f(0);
    meeting.wait();
  }
  /// Of `count` pieces those of thread t.
  std::pair<int, int> share(int count, int t) const {
    return {static_cast<int>(static_cast<long long>(count) * t / size), static_cast<int>(static_cast<long long>(count) * (t + 1) / size)};
  }
  Meeting meeting;  ///< also inside a piece of work, where all of them come to it
  const int size;
  const std::function<void(int)>* work = nullptr;
  bool done = false;
  std::vector<std::thread> threads;
};

}  // namespace palpate::explicit_shell
