// Errors and the residual table.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/report/errors.hpp>

#include <algorithm>
#include <cmath>
#include <random>


namespace palpate::loop {

using Eigen::VectorXd;

double noise_floor(const Session& s) {
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < s.problem.runs.size(); ++i)
    if (s.set->runs[s.problem.runs[i]].role == Role::fit) {
      sum += s.problem.whiteners[i].variance();
      ++count;
    }
  return std::sqrt(sum / std::max(count, 1));
}

namespace {

/// Mean squares of a run's tenths, one after the other: neighbours go together, as they are correlated (Künsch 1989, Ann. Stat. 17:1217).
std::vector<double> parts_of(const VectorXd& left) {
  const Eigen::Index count = std::min<Eigen::Index>(10, left.size());
  std::vector<double> parts;
  for (Eigen::Index k = 0; k < count; ++k) {
    const Eigen::Index first = k * left.size() / count, last = (k + 1) * left.size() / count;
    parts.push_back(left.segment(first, last - first).squaredNorm() / static_cast<double>(last - first));
  }
  return parts;
}

}  // namespace

ErrorOf error_of(const Session& s, const Model& model, Role role, const std::string& only) {
  std::vector<double> square, percent_square, parts;
  for (std::size_t r = 0; r < s.set->runs.size(); ++r) {
    const Run& run = s.set->runs[r];
    if (run.role != role || (!only.empty() && run.id != only)) continue;
    const VectorXd left = s.forward->measured(r) - s.forward->predicted(r, model);
    const double largest = std::max(s.forward->measured(r).cwiseAbs().maxCoeff(), 1e-12);
    square.push_back(left.squaredNorm() / left.size());
    parts = parts_of(left);
    percent_square.push_back(square.back() * 1e4 / (largest * largest));
  }
  ErrorOf error;
  error.runs = static_cast<int>(square.size());
  if (square.empty()) return error;
  const auto mean = [](const std::vector<double>& v) {
    double sum = 0;
    for (double x : v) sum += x / v.size();
    return sum;
  };
  error.rms_N = std::sqrt(mean(square));
  error.percent = std::sqrt(mean(percent_square));
  error.times_noise = error.rms_N / std::max(noise_floor(s), 1e-300);
  if (error.runs > 1) parts = square;
  std::mt19937_64 random(1);
  std::vector<double> drawn;
  for (int d = 0; d < 1000; ++d) {
    double sum = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) sum += parts[random() % parts.size()] / static_cast<double>(parts.size());
    drawn.push_back(std::sqrt(sum));
  }
  std::sort(drawn.begin(), drawn.end());
  error.low_N = drawn[25];
  error.high_N = drawn[974];
  return error;
}

namespace {

struct Sample {
  std::string run, phase;
  int cycle = 0;
  double left = 0, whitened = 0, depth = 0, rate = 0;
};

/// Wald and Wolfowitz: number of runs of one sign against its expectation.
double runs_test(const std::vector<const Sample*>& x) {
  double plus = 0, minus = 0, runs = x.empty() ? 0 : 1;
  for (std::size_t i = 0; i < x.size(); ++i) {
    (x[i]->whitened > 0 ? plus : minus) += 1;
    if (i > 0 && (x[i]->whitened > 0) != (x[i - 1]->whitened > 0)) runs += 1;
  }
  const double n = plus + minus;
  if (!(plus > 0) || !(minus > 0) || n < 4) return 0;
  const double mean = 2 * plus * minus / n + 1;
  return (runs - mean) / std::sqrt(std::max((mean - 1) * (mean - 2) / (n - 1), 1e-12));
}

Json row(const std::string& by, const std::string& name, const std::vector<const Sample*>& x) {
  double sum = 0, square = 0, chi2 = 0, Q = 0, lag1 = 0;
  const int n = static_cast<int>(x.size());
  for (const Sample* s : x) {
    sum += s->left;
    square += s->left * s->left;
    chi2 += s->whitened * s->whitened;
  }
  for (int lag = 1; lag <= std::min(5, n - 2); ++lag) {
    double together = 0;
    for (int i = lag; i < n; ++i) together += x[i]->whitened * x[i - lag]->whitened;
    const double rho = together / std::max(chi2, 1e-300);
    if (lag == 1) lag1 = rho;
    Q += n * (n + 2.0) * rho * rho / (n - lag);
  }
  return {{"by", by}, {"name", name}, {"blocks", n}, {"mean_N", sum / n}, {"rms_N", std::sqrt(square / n)}, {"chi2_per_block", chi2 / n},
          {"lag1", lag1}, {"ljung_box_5", Q}, {"runs_test_z", runs_test(x)}};
}

std::vector<Sample> samples_of(const Session& s, const Model& model) {
  std::vector<Sample> all;
  for (std::size_t i = 0; i < s.problem.runs.size(); ++i) {
    const std::size_t r = s.problem.runs[i];
    const Run& run = s.set->runs[r];
    const VectorXd left = s.forward->measured(r) - s.forward->predicted(r, model), u = s.forward->averaged(r, run.u), t = s.forward->times(r);
    Eigen::MatrixXd white = left;
    s.problem.whiteners[i].whiten(white);
    const std::vector<double> cycle(run.cycle.begin(), run.cycle.end());
    const VectorXd cycles = cycle.empty() ? VectorXd::Zero(left.size()) : s.forward->averaged(r, cycle);
    for (int b = 0; b < left.size(); ++b) {
      const double moved = b > 0 ? std::abs(u(b) - u(b - 1)) : 0, rate = moved > 1e-9 * u.cwiseAbs().maxCoeff() && t(b) > t(b - 1) ? moved / (t(b) - t(b - 1)) : 0;
      const double depth = run.test == Test::indentation ? u(b) : std::abs(u(b) - motion_at_rest(run.test));
      all.push_back({run.id, s.forward->phase_of(r, b), static_cast<int>(std::lround(cycles(b))), left(b), white(b, 0), depth, rate});
    }
  }
  return all;
}

}  // namespace

Json residual_table(const Session& s, const Model& model) {
  const auto all = samples_of(s, model);
  double deepest = 0;
  for (const Sample& x : all) deepest = std::max(deepest, x.depth);
  const auto third = [&](double depth) {
    return std::string(depth < deepest / 3 ? "shallow third" : depth < 2 * deepest / 3 ? "middle third" : "deepest third");
  };
  const auto decade = [](double rate) { return rate > 0 ? "1e" + std::to_string(static_cast<int>(std::floor(std::log10(rate)))) + " per s" : "none"; };
  Json table = Json::array();
  const auto add = [&](const std::string& by, const auto& name_of) {
    std::map<std::string, std::vector<const Sample*>> groups;
    std::vector<std::string> order;
    for (const Sample& x : all) {
      const std::string name = name_of(x);
      if (!groups.contains(name)) order.push_back(name);
      groups[name].push_back(&x);
    }
    for (const std::string& name : order) table.push_back(row(by, name, groups[name]));
  };
  add("run and phase", [](const Sample& x) { return x.run + ", " + x.phase; });
  add("phase", [](const Sample& x) { return x.phase; });
  add("rate", [&](const Sample& x) { return decade(x.rate); });
  add("depth", [&](const Sample& x) { return third(x.depth); });
  add("cycle", [](const Sample& x) { return std::to_string(x.cycle); });
  return table;
}

}  // namespace palpate::loop
