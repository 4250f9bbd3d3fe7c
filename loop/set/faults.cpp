// What makes a set unfit: time, numbers, signs, gaps, runs mixed up, replicates that are none, tools that cannot touch.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/set/set.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>

namespace palpate::loop {
namespace {

std::string at(const Run& run, std::size_t i) { return run.file.string() + ":" + std::to_string(run.line[i]) + ": "; }

std::string number(double x) {
  std::ostringstream out;
  out.precision(4);
  out << x;
  return out.str();
}

/// NaN and time; false when the run is of no use for further checks.
bool numbers_and_time(const Run& run, std::vector<std::string>& list) {
  if (run.t.size() < 2) {
    list.push_back(at(run, 0) + "one sample is no run; record the whole approach, load and hold");
    return false;
  }
  for (std::size_t i = 0; i < run.t.size(); ++i)
    for (const std::vector<double>* column : {&run.t, &run.u, &run.F, &run.Fx, &run.Fy})  // lateral forces need not be there
      if (!column->empty() && !std::isfinite((*column)[i])) {
        list.push_back(at(run, i) + "not a number (NaN or infinite); leave the row out");
        return false;
      }
  for (std::size_t i = 1; i < run.t.size(); ++i)
    if (!(run.t[i] > run.t[i - 1])) {
      list.push_back(at(run, i) + "time does not increase: " + number(run.t[i]) + " s after " + number(run.t[i - 1]) + " s; sort the rows or split the file");
      return false;
    }
  return true;
}

/// A step in time that is 20 times the usual one and stands alone (samples that thin out gradually are no gap).
void gaps(const Run& run, std::vector<std::string>& list) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < run.t.size(); ++i) steps.push_back(run.t[i] - run.t[i - 1]);
  if (!run.timed || steps.size() < 8) return;
  std::vector<double> sorted = steps;
  std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
  const double usual = sorted[sorted.size() / 2];
  for (std::size_t i = 1; i + 1 < steps.size(); ++i)
    if (steps[i] > 20 * usual && steps[i] > 5 * steps[i - 1] && steps[i] > 5 * steps[i + 1])
      list.push_back(at(run, i + 1) + "a gap of " + number(steps[i]) + " s in time, where samples are " + number(usual) +
                     " s apart; split the file there into two runs, or record again");
}

/// The force should rise with depth: flipped when it is mostly negative and falls while the tool goes in.
void sign(const Run& run, std::vector<std::string>& list) {
  if (run.is_air() || run.is_block()) return;
  const double rest = motion_at_rest(run.test);
  double together = 0, lowest = 0, highest = 0;
  std::size_t worst = 0;
  for (std::size_t i = 0; i < run.u.size(); ++i) {
    together += (run.u[i] - rest) * run.F[i];
    highest = std::max(highest, run.F[i]);
    if (run.F[i] < lowest) {
      lowest = run.F[i];
      worst = i;
    }
  }
  if (together < 0 && (run.test != Test::indentation || -lowest > 2 * highest))
    list.push_back(at(run, worst) + "the force has its sign flipped: " + number(run.F[worst]) + " where the specimen resists; " +
                   (run.test == Test::indentation ? "compression is positive" : "tension is positive"));
}

bool differs(double a, double b) { return a > 0 && b > 0 && std::abs(std::log(a / b)) > 0.4; }

/// Files with the same numbers: one copied over the other.
void copied(const Set& set, std::vector<std::string>& list) {
  for (std::size_t i = 0; i < set.runs.size(); ++i)
    for (std::size_t j = i + 1; j < set.runs.size(); ++j)
      if (const Run &a = set.runs[i], &b = set.runs[j]; a.u == b.u && a.F == b.F) list.push_back(b.file.string() + ":1: holds the same numbers as " + a.file.string() + "; one was copied over the other");
}

double largest_motion(const Run& run) {
  double largest = 0;
  for (double u : run.u) largest = std::max(largest, std::abs(u - motion_at_rest(run.test)));
  return largest;
}

/// The largest force up to a motion.
double force_up_to(const Run& run, double motion) {
  double force = 0;
  for (std::size_t i = 0; i < run.u.size(); ++i)
    if (std::abs(run.u[i] - motion_at_rest(run.test)) <= motion) force = std::max(force, std::abs(run.F[i]));
  return force;
}

/// What two runs must share to be one experiment twice; empty: nothing lacks.
std::string other_experiment(const Run& a, const Run& b) {
  if (a.test != b.test) return "one is " + test_name(a.test) + ", the other " + test_name(b.test);
  if (a.tool != b.tool) return "one has the tool " + a.tool + ", the other " + b.tool;
  if (norm(a.point_mm - b.point_mm) > 1e-3) return "they are at two places";
  if (const double of_a = loading_rate(a), of_b = loading_rate(b); a.timed && b.timed && differs(of_a, of_b))
    return "one loads at " + number(of_a) + " per second, the other at " + number(of_b);
  return "";
}

/// Forces so far apart that no scatter explains it; empty: they are not.
std::string other_forces(const Run& a, const Run& b) {
  constexpr double most_apart = 3;  ///< of the largest up to the same motion
  const double motion = std::min(largest_motion(a), largest_motion(b)), of_a = force_up_to(a, motion), of_b = force_up_to(b, motion);
  if (std::max(of_a, of_b) > most_apart * std::min(of_a, of_b)) return "their largest forces at the same motion are " + number(of_a) + " and " + number(of_b) + "; are the units right?";
  return "";
}

/// Of each run the first of its name before it that it does not repeat, with `why`: their scatter is the noise by which all is judged.
template <class Why>
void each_that_repeats_none(const Set& set, const Why& why, const std::function<void(const Run&, const std::string&)>& tell) {
  for (std::size_t j = 0; j < set.runs.size(); ++j)
    for (std::size_t i = 0; i < j; ++i) {
      const Run &a = set.runs[i], &b = set.runs[j];
      if (b.replicate.empty() || a.replicate != b.replicate || a.role == Role::calibration || b.role == Role::calibration) continue;
      const std::string text = why(a, b);
      if (text.empty()) continue;
      tell(b, "runs " + a.id + " and " + b.id + " are no replicates, as \"" + b.replicate + "\" says: " + text);
      break;
    }
}

/// Rates that do not fit their files but fit each other's: swapped.
void mixed_up(const Set& set, std::vector<std::string>& list) {
  for (std::size_t i = 0; i < set.runs.size(); ++i) {
    const Run& a = set.runs[i];
    if (a.test != Test::indentation) continue;
    const double of_a = loading_rate(a);
    std::string other;
    for (std::size_t j = 0; j < set.runs.size(); ++j) {
      const Run& b = set.runs[j];
      if (j != i && differs(a.rate_mm_s, of_a) && differs(b.rate_mm_s, loading_rate(b)) && !differs(a.rate_mm_s, loading_rate(b))) other = b.id;
    }
    if (differs(a.rate_mm_s, of_a))
      list.push_back(a.file.string() + ":1: run " + a.id + " should load at " + number(a.rate_mm_s) + " mm/s but does at " + number(of_a) +
                     (other.empty() ? " mm/s; correct rate_mm_s" : " mm/s, as " + other + " should: the two runs are swapped"));
  }
}

/// A homogeneous test: stretches are lengths over the length at rest, and something resists.
void stretched(const Run& run, std::vector<std::string>& list) {
  if (run.test == Test::indentation) return;
  constexpr double most = 30;  ///< stretch, or amount of shear: three times what rubber bears
  for (std::size_t i = 0; i < run.u.size(); ++i)
    if (run.test != Test::simple_shear ? !(run.u[i] > 0 && run.u[i] < most) : !(std::abs(run.u[i]) < most)) {
      list.push_back(at(run, i) + (run.test == Test::simple_shear ? "an amount of shear of " : "a stretch of ") + number(run.u[i]) + "; a stretch is the length over that at rest, 1 there, and not in percent");
      return;
    }
  if (std::all_of(run.F.begin(), run.F.end(), [](double P) { return P == 0; })) list.push_back(at(run, 0) + "no stress but zero in the whole run; is it the right column?");
}

/// A simple shape stands on z = 0 around the axis z; a tool must meet it along its own axis.
void touch(const Set& set, const Run& run, std::vector<std::string>& list) {
  if (run.test != Test::indentation || run.is_air() || run.is_block()) return;
  const double largest = *std::max_element(run.F.begin(), run.F.end());
  if (!(largest > 0)) list.push_back(at(run, 0) + "the tool never touches: no force above zero; is it an air run (phase = air)?");
  if (set.specimen.shape == "tube") {
    const double z = run.point_mm[2];
    if (!(z > 0 && z < set.specimen.size_mm[2])) list.push_back(set.file.string() + ": run " + run.id + ": the jaws miss the tube, which lies between 0 and " + number(set.specimen.size_mm[2]) + " mm; point_mm is the middle between them");
    if (!(*std::max_element(run.u.begin(), run.u.end()) < set.specimen.size_mm[0] - 2 * set.specimen.wall_mm))
      list.push_back(set.file.string() + ": run " + run.id + ": the jaws close to less than twice the declared wall; u is the declared outer diameter less the gap between the jaws");
    return;
  }
  if (set.specimen.shape.empty()) return;
  if (const double deepest = *std::max_element(run.u.begin(), run.u.end()), height = set.specimen.size_mm[2]; run.zero == "geometry" && deepest >= height)
    list.push_back(set.file.string() + ": run " + run.id + ": the tool goes " + number(deepest) + " mm into a specimen that is " + number(height) + " mm high; is the height right, or u counted from elsewhere (zero)?");
  const double x = run.point_mm[0], y = run.point_mm[1], radius = set.tools.at(run.tool).radius_mm;
  const bool box = set.specimen.shape == "block";
  const double beyond = box ? std::max(std::abs(x) - set.specimen.size_mm[0] / 2, std::abs(y) - set.specimen.size_mm[1] / 2)
                            : std::hypot(x, y) - set.specimen.size_mm[0] / 2;
  if (beyond > radius)
    list.push_back(set.file.string() + ": run " + run.id + ": the tool cannot touch the specimen there: point_mm lies " + number(beyond) +
                   " mm outside its outline; point_mm is in the shape's own axes, the middle of its base at the origin");
  else if (run.axis[2] > 0)
    list.push_back(set.file.string() + ": run " + run.id + ": the tool moves away from the specimen; axis = [0, 0, -1] presses down");
}

}  // namespace

std::vector<std::string> faults(const Set& set) {
  std::vector<std::string> list;
  bool sound = true;
  for (const Run& run : set.runs) {
    const bool fit = numbers_and_time(run, list);
    sound = sound && fit;
    if (!fit) continue;
    gaps(run, list);
    sign(run, list);
    stretched(run, list);
    touch(set, run, list);
  }
  if (!sound) return list;
  mixed_up(set, list);
  copied(set, list);
  each_that_repeats_none(set, other_forces, [&](const Run& run, const std::string& text) { list.push_back(run.file.string() + ":1: " + text); });
  return list;
}

std::vector<std::string> remarks(const Set& set) {
  std::vector<std::string> list;
  std::map<std::string, int> groups;
  int air = 0, sealed = 0, fit = 0;
  for (const Run& run : set.runs) {
    if (!run.replicate.empty() && run.role == Role::fit) ++groups[run.replicate];
    air += run.is_air();
    sealed += run.role == Role::holdout;
    fit += run.role == Role::fit;
  }
  if (std::none_of(groups.begin(), groups.end(), [](const auto& g) { return g.second > 1; }))
    list.push_back("no replicates: the loop can rank effects but claims none; repeat a run and give both the same replicate");
  each_that_repeats_none(set, other_experiment, [&](const Run&, const std::string& text) { list.push_back(text + "; what they differ by counts as noise; give another experiment another replicate"); });
  if (air == 0 && set.sensor_sd_N.state != Known::State::given) list.push_back("no air run: the sensor's noise is taken from the runs' own fast fluctuations");
  if (sealed == 0) list.push_back("no sealed run (role = \"holdout\"): error after is told on fit runs only");
  for (const Run& run : set.runs)
    if (!run.unused.empty()) list.push_back("run " + run.id + " is not used: " + run.unused);
  for (const std::string& key : set.unknown_keys) list.push_back(key + ": the loop does not know this key and reads over it");
  if (fit == 0) list.push_back("no run to fit (role = \"fit\")");
  return list;
}

}  // namespace palpate::loop
