// Writes walls and cases, runs them, and puts their histories on even closures.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/clamp_solves.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

#include <palpate/card.hpp>
#include <palpate/errors.hpp>
#include <loop/forward/clamp_closing.hpp>
#include <loop/forward/clamp_errors.hpp>
#include <loop/forward/process.hpp>
#include <loop/methods/parallel.hpp>
#include <loop/methods/session.hpp>
#include <loop/set/csv.hpp>

namespace palpate::loop {
namespace {

namespace fs = std::filesystem;

constexpr double finer[] = {0.8, 1.0, 0.9};        ///< edges over the set's: the curve is the mean of these meshes
constexpr std::size_t meshes = std::size(finer);
constexpr double grid_mm = 0.1, smoothed_mm = 0.2; ///< of the closures; half width of the mean over vibrations
constexpr double changes_smoothed_mm = 0.8;        ///< half width of the mean over the vibrations of two closings, one against the other
constexpr double reach_mm = 24, slice_mm = 8;      ///< along the tube, from the jaws' middle
constexpr double solved_MPa = 0.25;                ///< initial shear modulus of the solves: forces at rest are proportional to it, and stiffer walls come to rest sooner
constexpr double small_share = 0.005;

Model solved_model(const Set& set) {
  Model model = start_model(set, set.specimen.law);
  const double ratio = solved_MPa / model.law->shear_modulus(model.parameters);
  for (std::size_t i = 0; i < model.parameters.size(); ++i)
    if (model.law->parameters[i].unit == "MPa") model.parameters[i] *= ratio;
  return model;
}

/// The line through the samples within `smoothed_mm`, at its middle, or between the neighbours where there are too few. Not their mean: jaws slow down where they stop, and samples crowd there.
EvenCurve even(std::vector<std::pair<double, double>> points, double low, double high, double last) {
  std::sort(points.begin(), points.end());
  EvenCurve curve{low, grid_mm, {}};
  std::size_t from = 0;
  for (double u = low; u < high - grid_mm / 2; u += grid_mm) {
    while (from + 1 < points.size() && points[from].first < u - smoothed_mm) ++from;
    double sum = 0, moved = 0, square = 0, product = 0;
    int count = 0;
    for (std::size_t i = from; i < points.size() && points[i].first <= u + smoothed_mm; ++i) {
      const double x = points[i].first - u, F = points[i].second;
      sum += F, moved += x, square += x * x, product += x * F;
      ++count;
    }
    const double spread = count * square - moved * moved, slope = spread > 1e-6 * count * count * smoothed_mm * smoothed_mm ? (count * product - moved * sum) / spread : 0;
    const auto above = std::upper_bound(points.begin(), points.end(), std::pair(u, 1e300));
    if (count < 2 && above != points.begin() && above != points.end()) {
      const auto& [a, Fa] = *(above - 1);
      const auto& [c, Fc] = *above;
      curve.values.push_back(Fa + (Fc - Fa) * (u - a) / std::max(c - a, 1e-12));
    } else {
      curve.values.push_back(count > 0 ? (sum - slope * moved) / count : above == points.end() ? last : 0);
    }
  }
  curve.values.push_back(last);
  curve.step_mm = (high - low) / static_cast<double>(curve.values.size() - 1);
  return curve;
}

/// In, out, and the mean at rest for the end of both. A row's force is the mean since the row before, so it belongs to the closure half-way between them.
BothWays curves_of(const Bench& b, const fs::path& result) {
  const CsvTable table = read_csv(result / "history.csv");
  const auto gap = table.numbers("gap", "mm"), F = table.numbers("F", "N");
  const double closed = b.stop_gap_mm() + 1e-6;
  std::vector<std::pair<double, double>> in, out;
  double rest = 0;
  int resting = 0;
  for (std::size_t i = 1; i < gap.size(); ++i) {
    if (gap[i - 1] <= closed && gap[i] <= closed) {
      rest += F[i];
      ++resting;
    } else {
      (resting > 0 ? out : in).push_back({b.set.specimen.size_mm[0] - (gap[i - 1] + gap[i]) / 2, F[i]});
    }
  }
  if (resting == 0) throw Failure(ExitCode::not_converged, "the solver does not close the jaws", result.string());
  return {even(in, -ahead_mm, b.deepest_mm, rest / resting), even(out, -ahead_mm, b.deepest_mm, rest / resting)};
}

/// Means over `changes_smoothed_mm` on either side, as far on the one as on the other: two closings of one mesh each vibrate for themselves.
EvenCurve smoothed(const EvenCurve& rough) {
  EvenCurve smooth = rough;
  const auto n = static_cast<std::ptrdiff_t>(rough.values.size()), most = static_cast<std::ptrdiff_t>(changes_smoothed_mm / grid_mm);
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    const std::ptrdiff_t wide = std::min({most, i, n - 1 - i});
    smooth.values[i] = std::accumulate(rough.values.begin() + i - wide, rough.values.begin() + i + wide + 1, 0.0) / static_cast<double>(2 * wide + 1);
  }
  return smooth;
}

EvenCurve log_change(const EvenCurve& to, const EvenCurve& from, double small) {
  EvenCurve change = from;
  for (std::size_t i = 0; i < change.values.size(); ++i) change.values[i] = std::log((std::max(to.values[i], 0.0) + small) / (std::max(from.values[i], 0.0) + small));
  return smoothed(change);
}

/// exp of the mean of ln(F + ε) over the meshes, less ε.
EvenCurve mean_of(const std::vector<BothWays>& all, EvenCurve BothWays::*way, double small) {
  EvenCurve mean = all[0].*way;
  for (std::size_t u = 0; u < mean.values.size(); ++u) {
    double sum = 0;
    for (std::size_t i = 0; i < meshes; ++i) sum += std::log(std::max((all[i].*way).values[u], 0.0) + small);
    mean.values[u] = std::exp(sum / meshes) - small;
  }
  return mean;
}

bool in_the_middle(const Bench& b, const Run& run) { return std::abs(run.point_mm[2] - b.set.specimen.size_mm[2] / 2) < 1e-6; }

/// Everything that is solved of a site, in this order: the curve's meshes; with coarser folds the finest and the second of them again, and on them friction, angle, the law's parameters, slices.
/// Friction and angle change what the wall does to itself most: they have the finest mesh.
std::vector<Closing> jobs_of(const Bench& b, const Run& run) {
  std::vector<Closing> jobs;
  for (double part : finer) jobs.push_back({.edge_mm = part * b.set.specimen.edge_mm, .fine_folds = true});
  for (double part : {finer[0], finer[1]}) jobs.push_back({.edge_mm = part * b.set.specimen.edge_mm, .works = part == finer[0]});
  for (double mu : {0.2, 0.5}) jobs.push_back({.edge_mm = finer[0] * b.set.specimen.edge_mm, .friction = mu});
  const double tools_width = b.set.tools.at(run.tool).width_mm, meet = 2 * std::asin(std::min(0.8 * b.stop_gap_mm() / tools_width, 1.0)) * 180 / M_PI;  // where jaws nearly touch at one end
  for (double angle : {std::min(2.0, meet / 2), std::min(4.0, meet)}) jobs.push_back({.edge_mm = finer[0] * b.set.specimen.edge_mm, .angle_deg = angle});
  for (int i = 1; i < static_cast<int>(b.start.parameters.size()); ++i)
    if (b.start.parameters[i] > 0) jobs.push_back({.edge_mm = b.set.specimen.edge_mm, .parameter = i});
  const double length = b.set.specimen.size_mm[2], most = 0.5 * b.stop_gap_mm() / b.set.specimen.wall_mm - 1.05;  // what still fits between the jaws
  const double thick = std::clamp(most, 0.1, 0.4);
  for (double from = 0; from < length - 1e-6; from += slice_mm) {
    const double to = std::min(from + slice_mm, length);
    if (in_the_middle(b, run) && from + to > length + 1e-6) continue;  // the other half is its mirror image
    if (to < run.point_mm[2] - reach_mm || from > run.point_mm[2] + reach_mm) continue;
    for (double excess : {-0.2, thick}) jobs.push_back({.edge_mm = b.set.specimen.edge_mm, .from = from, .to = to, .excess = excess});
  }
  return jobs;
}

/// Sums of products of what lies a block of samples apart, and of squares.
struct Rough {
  double squares = 0, neighbours = 0;
};
constexpr std::size_t block_steps = 4;  ///< of the grid

/// What the meshes' forces differ by, less the straight lines between the places of the curve's own error, over the largest force: rms over meshes and closures between two places, half of its square
/// that of the whole way, for three meshes tell little.
std::vector<double> scatter_of(const Bench& b, const std::vector<BothWays>& all, const BothWays& mean, EvenCurve BothWays::*way, double small, Rough& rough) {
  const double largest = *std::max_element(mean.closing.values.begin(), mean.closing.values.end());
  std::vector<double> squares, counts;
  for (std::size_t p = 1; p < form_places.size(); ++p) {
    const double low = form_places[p - 1] * b.deepest_mm, high = form_places[p] * b.deepest_mm;
    squares.push_back(0);
    counts.push_back(0);
    for (std::size_t i = 0; i < meshes; ++i) {
      const auto apart = [&](double u) { return std::log(((all[i].*way).at(u) + small) / ((mean.*way).at(u) + small)); };
      const double first = apart(low), last = apart(high);
      std::vector<double> left;
      for (double u = low; u < high; u += grid_mm) left.push_back((mean.*way).at(u) / largest * (apart(u) - first - (last - first) * (u - low) / (high - low)));
      for (std::size_t k = 0; k < left.size(); ++k) {
        squares.back() += left[k] * left[k];
        if (k >= block_steps) rough.neighbours += left[k] * left[k - block_steps];
      }
      counts.back() += static_cast<double>(left.size());
    }
  }
  const double sum = std::accumulate(squares.begin(), squares.end(), 0.0), count = std::accumulate(counts.begin(), counts.end(), 0.0);
  rough.squares += sum;
  std::vector<double> scatter;
  for (std::size_t p = 0; p < squares.size(); ++p) scatter.push_back(std::sqrt(0.5 * squares[p] / std::max(counts[p], 1.0) + 0.5 * sum / count));
  return scatter;
}

ClampSite site_of(const Bench& b, const Run& run, const std::vector<Closing>& jobs, const std::vector<fs::path>& results, double small, Eigen::Ref<Eigen::MatrixXd> apart, Rough& rough) {
  ClampSite site;
  site.point_mm = run.point_mm;
  std::vector<BothWays> all;
  for (const auto& result : results) all.push_back(curves_of(b, result));
  site.force = {mean_of(all, &BothWays::closing, small), mean_of(all, &BothWays::opening, small)};
  const auto change = [&](std::size_t i) {
    const BothWays& without = all[jobs[i].edge_mm == jobs[meshes].edge_mm ? meshes : meshes + 1];
    return BothWays{log_change(all[i].closing, without.closing, small), log_change(all[i].opening, without.opening, small)};
  };
  site.scatter = {scatter_of(b, all, site.force, &BothWays::closing, small, rough), scatter_of(b, all, site.force, &BothWays::opening, small, rough)};
  Eigen::Index row = 0;
  for (const auto way : {&BothWays::closing, &BothWays::opening})
    for (double place : form_places) {
      const double u = place * b.deepest_mm, mean = (site.force.*way).at(u) + small;
      for (std::size_t i = 0; i < meshes; ++i) apart(row, static_cast<Eigen::Index>(i)) = std::log((std::max((all[i].*way).at(u), 0.0) + small) / mean);
      ++row;
    }
  for (std::size_t i = meshes + 2; i < jobs.size(); ++i) {
    const Closing& job = jobs[i];
    Change* of = job.friction > 0 ? &site.friction : &site.angle;
    double amplitude = job.friction > 0 ? job.friction : job.angle_deg;
    if (job.parameter >= 0) {
      of = &site.laws.emplace_back(job.parameter, Change{}).second;
      amplitude = std::log(1.5);
    }
    if (job.excess != 0) {
      if (site.slices.empty() || site.slices.back().from != job.from) site.slices.push_back({job.from, job.to, {}});
      of = &site.slices.back().thicker;
      amplitude = std::log1p(job.excess);
    }
    of->amplitudes.push_back(amplitude);
    of->changes.push_back(change(i));
  }
  if (in_the_middle(b, run))
    for (std::size_t k = site.slices.size(); k-- > 0;) {
      const Slice half = site.slices[k];
      const double length = b.set.specimen.size_mm[2];
      if (half.from + half.to < length - 1e-6) site.slices.push_back({length - half.to, length - half.from, half.thicker});
    }
  const CsvTable works = read_csv(results[meshes] / "stress_works.csv");
  const auto depth = works.numbers("depth", "mm");
  const auto n = static_cast<Eigen::Index>(depth.size());
  site.works.resize(n, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto column = works.numbers("F" + std::to_string(k), "N");
    for (Eigen::Index j = 0; j < n; ++j) site.works(j, k) = column[j];
  }
  for (double d : depth) site.moments_mm.push_back(d - ahead_mm);
  return site;
}

}  // namespace

bool is_clamp(const Set& set) { return set.specimen.shape == "tube"; }

ClampCurves clamp_curves(const Set& set, const fs::path& kept, int threads, const std::function<void(const std::string&)>& remark) {
  ClampCurves curves;
  double deepest = 0;
  std::vector<const Run*> places;
  for (const Run& run : set.runs) {
    deepest = std::max(deepest, *std::max_element(run.u.begin(), run.u.end()));
    if (std::none_of(places.begin(), places.end(), [&](const Run* p) { return norm(p->point_mm - run.point_mm) < 1e-6; })) places.push_back(&run);
  }
  Bench b{set, solved_model(set), kept, beside("palpate-mesh"), beside("palpate-idealize"), beside("palpate-solve"), "", deepest};
  if (b.solver.empty() || b.mesh_program.empty() || b.tube_program.empty())
    throw Failure(ExitCode::refused, "curves of a clamp come from palpate-solve, palpate-mesh and palpate-idealize, which are not beside this program", set.file.string());
  b.version = sha256(b.solver).substr(0, 12);
  curves.parameters = b.start.parameters;
  std::vector<std::pair<const Run*, Closing>> todo;
  for (const Run* run : places)
    for (const Closing& job : jobs_of(b, *run)) todo.push_back({run, job});
  std::vector<fs::path> results(todo.size());
  remark("curves of the clamp: " + std::to_string(todo.size()) + " closings of the wall");
  for_each_index(static_cast<int>(todo.size()), threads, [&](int i) { results[i] = closed(b, *todo[i].first, todo[i].second); });
  curves.solves = static_cast<int>(todo.size());
  const auto first = curves_of(b, results[0]).closing;
  curves.small_N = small_share * *std::max_element(first.values.begin(), first.values.end());
  curves.deepest_mm = deepest;
  const auto of_site = static_cast<Eigen::Index>(forms_of_site);
  Eigen::MatrixXd apart(of_site * static_cast<Eigen::Index>(places.size()), meshes);
  Rough rough;
  auto at = results.begin();
  for (const Run* run : places) {
    const auto jobs = jobs_of(b, *run);
    curves.sites.push_back(site_of(b, *run, jobs, {at, at + static_cast<long>(jobs.size())}, curves.small_N, apart.middleRows(of_site * static_cast<Eigen::Index>(curves.sites.size()), of_site), rough));
    curves.sites.back().index = static_cast<int>(curves.sites.size()) - 1;
    at += static_cast<long>(jobs.size());
  }
  curves.forms = own_errors(apart);
  curves.correlation = std::clamp(rough.neighbours / std::max(rough.squares, 1e-300), 0.0, 0.9);
  return curves;
}

}  // namespace palpate::loop
