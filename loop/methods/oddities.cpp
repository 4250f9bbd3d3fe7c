// Drops: means of three neighbouring residuals (one on ramps under 20 samples) before and after, against their median absolute deviation over the ramp. Swings: at one frequency,
// sines of free phase in every hold and rest (Lomb 1976, Astrophys. Space Sci. 39:447), after a cubic in time is taken out.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/methods/oddities.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

#include <loop/methods/thresholds.hpp>
#include <loop/set/thinned.hpp>

namespace palpate::loop {
namespace {

using Eigen::MatrixXd, Eigen::VectorXd;

std::vector<double> left_of(const Session& s, std::size_t r, const Model& model) {
  std::vector<double> left = s.set->runs[r].F;
  const auto force = s.forward->force(r, model);
  for (std::size_t i = 0; i < left.size(); ++i) left[i] -= force[i];
  return left;
}

double median(std::vector<double> x) {
  std::nth_element(x.begin(), x.begin() + x.size() / 2, x.end());
  return x[x.size() / 2];
}

std::string rounded(double x) {
  std::ostringstream out;
  out.precision(2);
  out << x;
  return out.str();
}

/// The largest sudden drop of a run's ramps; strength 0: none.
Oddity drop_of(const Session& s, std::size_t r, const std::vector<double>& left) {
  const Run& run = s.set->runs[r];
  const double deepest = *std::max_element(run.u.begin(), run.u.end());
  double largest_F = 0;
  for (double F : run.F) largest_F = std::max(largest_F, std::abs(F));
  Oddity worst{"sudden_drop", run.id};
  const auto ends = stretches(run);
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    const int width = ends[k + 1] - ends[k] < 20 ? 1 : 3, from = ends[k] + width + 1, to = ends[k + 1] - width - 1;  // the last sample may lie beyond the turn
    if (run.phase[ends[k]] != "load" || to - from < 6) continue;
    std::vector<double> change, away;
    for (int i = from; i < to; ++i) {
      change.push_back(0);
      for (int w = 0; w < width; ++w) change.back() += (left[i + w] - left[i - 1 - w]) / width;
    }
    const double middle = median(change);
    for (double c : change) away.push_back(std::abs(c - middle));
    const double usual = 1.4826 * median(away) + s.noise.sensor_sd / std::sqrt(run.averaged[from]) + 1e-3 * largest_F;
    for (int i = from; i < to; ++i) {
      const double drop = middle - change[i - from], strength = drop / usual;
      if (run.u[i] > 0.1 * deepest && drop > thresholds::drop_share * largest_F && strength > std::max(worst.strength, thresholds::drop_strength))
        worst = {"sudden_drop", run.id, drop, run.t[i], run.u[i], 0, strength, ""};
    }
  }
  return worst;
}

struct Still {
  std::size_t run = 0;
  VectorXd t, left;
  double step = 0, length = 0;
};

/// Holds and rests of at least 24 samples, less a cubic in time.
std::vector<Still> stills_of(const Session& s, std::size_t r, const std::vector<double>& left) {
  const Run& run = s.set->runs[r];
  std::vector<Still> list;
  const auto ends = stretches(run);
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    const std::string& phase = run.phase[ends[k]];
    const int n = ends[k + 1] - ends[k] - 2;
    if ((phase != "hold" && phase != "rest") || n < 24) continue;
    Still still{r, VectorXd(n), VectorXd(n)};
    for (int i = 0; i < n; ++i) {
      still.t(i) = run.t[ends[k] + 1 + i];
      still.left(i) = left[ends[k] + 1 + i];
    }
    still.length = still.t(n - 1) - still.t(0);
    still.step = still.length / (n - 1);
    MatrixXd cubic(n, 4);
    const VectorXd x = (still.t.array() - still.t(0)) / still.length * 2 - 1;
    cubic << VectorXd::Ones(n), x, x.cwiseAbs2(), x.array().cube().matrix();
    still.left -= cubic * cubic.colPivHouseholderQr().solve(still.left);
    list.push_back(std::move(still));
  }
  return list;
}

/// Squares that a sine and a cosine explain.
double explained(const Still& s, double frequency) {
  const VectorXd angle = 2 * M_PI * frequency * s.t;
  MatrixXd wave(s.t.size(), 2);
  wave << angle.array().cos().matrix(), angle.array().sin().matrix();
  const Eigen::Vector2d b = wave.transpose() * s.left;
  return b.dot((wave.transpose() * wave).ldlt().solve(b));
}

Oddity swing_of(const Session& s, const std::vector<Still>& stills) {
  Oddity best{"swing"};
  double longest = 0, finest = 1e300;
  for (const Still& x : stills) {
    longest = std::max(longest, x.length);
    finest = std::min(finest, x.step);
  }
  if (stills.size() < 2) return best;
  double largest_F = 0;
  for (std::size_t r : s.problem.runs)
    for (double F : s.set->runs[r].F) largest_F = std::max(largest_F, std::abs(F));
  const double low = 2.5 / longest, high = 0.4 / finest;
  const int count = std::clamp(static_cast<int>(4 * longest * (high - low)), 0, 600);
  for (int i = 0; i <= count; ++i) {
    const double f = low + (high - low) * i / std::max(count, 1);
    double all = 0, of_wave = 0, most = 0, samples = 0;
    std::size_t where = 0;
    for (const Still& x : stills) {
      if (f * x.length < 2 || f * x.step > 0.45) continue;
      const double own = explained(x, f);
      all += x.left.squaredNorm();
      of_wave += own;
      samples += x.t.size();
      if (own > most) {
        most = own;
        where = x.run;
      }
    }
    const double size = std::sqrt(2 * of_wave / std::max(samples, 1.0));
    if (samples < 60 || !(size > thresholds::swing_size * largest_F) || !(of_wave > std::max(best.strength, thresholds::swing_share) * all)) continue;
    best = {"swing", s.set->runs[where].id, size, 0, 0, f, of_wave / all, ""};
  }
  return best;
}

}  // namespace

std::vector<Oddity> oddities(const Session& s, const Model& model) {
  Oddity drop;
  std::vector<Still> stills;
  for (std::size_t r : s.problem.runs) {
    const Run& run = s.set->runs[r];
    if (run.role != Role::fit || !run.timed || run.t.size() < 24 || run.test != Test::indentation) continue;
    const auto left = left_of(s, r, model);
    const bool snaps = s.set->specimen.shape == "tube";  // a wall that folds lets go by itself, and its curve is not known to a drop
    if (const Oddity own = snaps ? Oddity{} : drop_of(s, r, left); own.strength > drop.strength) drop = own;
    for (Still& still : stills_of(s, r, left)) stills.push_back(std::move(still));
  }
  std::vector<Oddity> list;
  if (drop.strength > 0) {
    drop.told = "the force drops at once by " + rounded(drop.size) + " N at " + rounded(drop.u_mm) + " mm in run " + drop.run + ", as when something gives way";
    list.push_back(drop);
  }
  if (Oddity swing = swing_of(s, stills); swing.strength > 0) {
    swing.told = "the force swings by " + rounded(swing.size) + " N at " + rounded(swing.frequency_Hz) + " Hz while the tool stands still, as with hum or breathing";
    list.push_back(swing);
  }
  return list;
}

}  // namespace palpate::loop
