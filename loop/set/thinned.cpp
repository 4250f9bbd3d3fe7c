// Means of t, u, F over groups of samples.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/set/thinned.hpp>

#include <algorithm>
#include <cmath>

namespace palpate::loop {
namespace {

constexpr int most_samples = 480;

/// The smallest step between values that differ, where few values occur again and again.
double converter_step(std::vector<double> values) {
  const std::size_t count = values.size();
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  if (values.size() < 3 || values.size() * 3 > count) return 0;
  double step = values.back() - values.front();
  for (std::size_t i = 1; i < values.size(); ++i) step = std::min(step, values[i] - values[i - 1]);
  return step;
}

void average(std::vector<double>& x, const std::vector<int>& begin) {
  if (x.empty()) return;
  std::vector<double> means;
  for (std::size_t g = 0; g + 1 < begin.size(); ++g) {
    double sum = 0;
    for (int i = begin[g]; i < begin[g + 1]; ++i) sum += x[i];
    means.push_back(sum / (begin[g + 1] - begin[g]));
  }
  x = std::move(means);
}

template <class T>
void first_of(std::vector<T>& x, const std::vector<int>& begin) {
  if (x.empty()) return;
  std::vector<T> kept;
  for (std::size_t g = 0; g + 1 < begin.size(); ++g) kept.push_back(x[begin[g]]);
  x = std::move(kept);
}

/// Way that u goes, there and back: sum over stretches of what it spans.
double way(const Run& run, const std::vector<int>& ends) {
  double sum = 0;
  for (std::size_t s = 0; s + 1 < ends.size(); ++s) {
    const auto [low, high] = std::minmax_element(run.u.begin() + ends[s], run.u.begin() + ends[s + 1]);
    sum += *high - *low;
  }
  return sum;
}

/// A group has its share of the samples at most, and ends where u has gone its share of the way: the mean of a curved force is not the force at the mean of u.
std::vector<int> groups(const Run& run) {
  const int count = static_cast<int>(run.t.size()), size = (count + most_samples - 1) / most_samples;
  const auto ends = stretches(run);
  const double share = way(run, ends) / most_samples;
  std::vector<int> begin;
  for (std::size_t s = 0; s + 1 < ends.size(); ++s)
    for (int i = ends[s]; i < ends[s + 1]; ++i)
      if (i == ends[s] || i - begin.back() >= size || std::abs(run.u[i] - run.u[begin.back()]) > share) begin.push_back(i);
  begin.push_back(count);
  return begin;
}

}  // namespace

double fast_sd(const std::vector<double>& x) {
  std::vector<double> fourth;
  for (std::size_t i = 4; i < x.size(); ++i) fourth.push_back(std::abs(x[i] - 4 * x[i - 1] + 6 * x[i - 2] - 4 * x[i - 3] + x[i - 4]));
  if (fourth.empty()) return 0;
  std::nth_element(fourth.begin(), fourth.begin() + fourth.size() / 2, fourth.end());
  return std::max(fourth[fourth.size() / 2] / (std::sqrt(70.0) * 0.6745), converter_step(x) / std::sqrt(12.0));
}

std::vector<int> stretches(const Run& run) {
  std::vector<int> begin = {0};
  const int count = static_cast<int>(run.t.size());
  for (int i = 1; i < count; ++i)
    if (run.phase[i] != run.phase[i - 1] && i - begin.back() >= 3 && count - i >= 3) begin.push_back(i);
  begin.push_back(count);
  return begin;
}

void thin(Set& set) {
  for (Run& run : set.runs) {
    run.fast_sd_N = fast_sd(run.F);
    run.averaged.assign(run.t.size(), 1);
    if (run.t.size() <= static_cast<std::size_t>(most_samples)) continue;
    const auto begin = groups(run);
    for (std::vector<double>* x : {&run.t, &run.u, &run.F, &run.Fx, &run.Fy}) average(*x, begin);
    first_of(run.phase, begin);
    first_of(run.cycle, begin);
    first_of(run.line, begin);
    run.averaged.clear();
    for (std::size_t g = 0; g + 1 < begin.size(); ++g) run.averaged.push_back(begin[g + 1] - begin[g]);
  }
}

}  // namespace palpate::loop
