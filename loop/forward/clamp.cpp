// The curve of a site from its changes, and its relaxation.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/clamp.hpp>

#include <algorithm>
#include <cmath>

#include <palpate/errors.hpp>

namespace palpate::loop {
namespace {

constexpr double sliding_share = 0.05;  ///< of the closure, over which s goes from 1 to 0 after a reversal
constexpr double resting_share = 1e-4;  ///< of the closure, from sample to sample, below which the jaws rest
constexpr double largest_change = 6;    ///< of ln F: beyond it nothing was solved

/// s at each sample: of what rubs, which stays as it is at rest, and of the wall's own drag in the solver, which goes.
std::vector<Way> ways(const std::vector<double>& u) {
  const double largest = std::max(*std::max_element(u.begin(), u.end()), 1e-9), reach = sliding_share * largest;
  std::vector<Way> s(u.size());
  for (std::size_t i = 1; i < u.size(); ++i) {
    const double moved = u[i] - u[i - 1];
    s[i].rubbing = std::clamp(s[i - 1].rubbing + moved / reach, -1.0, 1.0);
    s[i].drag = std::abs(moved) < resting_share * largest ? 0 : std::clamp(s[i - 1].drag + moved / reach, -1.0, 1.0);
  }
  return s;
}

/// Modulus over that of the solves.
double modulus_ratio(const ClampCurves& curves, const Tissue& tissue) {
  return tissue.law->parameters[0].unit == "MPa" ? tissue.parameters[0] / curves.parameters[0] : 1;
}

/// Part of a slice that the zone covers.
double covered(const Slice& slice, const Zone& zone) {
  const double low = std::max(slice.from, zone.place_mm - zone.half_mm), high = std::min(slice.to, zone.place_mm + zone.half_mm);
  return std::max(0.0, high - low) / (slice.to - slice.from);
}

/// Hats of the moments at u, of which the two around it are not zero: index of the upper one and its share. Before the first moment the stress goes to nothing.
std::pair<int, double> between(const std::vector<double>& moments, double u, double start) {
  const int n = static_cast<int>(moments.size());
  const int i = std::min(static_cast<int>(std::upper_bound(moments.begin(), moments.end(), u) - moments.begin()), n - 1);
  const double below = i > 0 ? moments[i - 1] : start;
  return {i, std::clamp((u - below) / (moments[i] - below), 0.0, 1.0)};
}

/// Σ_k x_k F(u, k).
double works_at(const ClampSite& site, double u, double start, const Eigen::VectorXd& x) {
  const auto [i, share] = between(site.moments_mm, u, start);
  const double above = site.works.row(i).dot(x);
  return i == 0 ? above : (1 - share) * site.works.row(i - 1).dot(x) + share * above;
}

/// What is left of each sample's elastic force.
std::vector<double> relaxed(const ClampSite& site, const Tissue& tissue, const ClampHistory& history) {
  const auto n = static_cast<Eigen::Index>(site.moments_mm.size());
  const double start = site.force.closing.low_mm;
  std::vector<Eigen::VectorXd> branch(tissue.prony.size(), Eigen::VectorXd::Zero(n));
  Eigen::VectorXd last = Eigen::VectorXd::Zero(n);
  std::vector<double> left(history.u_mm.size(), 1);
  double instant = 1;
  for (const PronyTerm& term : tissue.prony) instant -= term.g;
  for (std::size_t i = 0; i < left.size(); ++i) {
    Eigen::VectorXd hats = Eigen::VectorXd::Zero(n);
    const auto [k, share] = between(site.moments_mm, history.u_mm[i], start);
    hats(k) = share;
    if (k > 0) hats(k - 1) = 1 - share;
    Eigen::VectorXd sum = instant * hats;
    for (std::size_t b = 0; b < branch.size(); ++b) {
      const double ratio = (i > 0 ? history.t_s[i] - history.t_s[i - 1] : 0) / tissue.prony[b].tau_s, gained = ratio > 1e-9 ? -std::expm1(-ratio) / ratio : 1;
      branch[b] = std::exp(-ratio) * branch[b] + gained * (hats - last);
      sum += tissue.prony[b].g * branch[b];
    }
    last = hats;
    const double whole = works_at(site, history.u_mm[i], start, hats);
    if (whole > 1e-9) left[i] = std::max(0.0, works_at(site, history.u_mm[i], start, sum) / whole);
  }
  return left;
}

/// The curve's own error at u.
double form_at(const ClampCurves& curves, const ClampSite& site, const Eigen::VectorXd& form, double u, double s) {
  if (form.size() == 0) return 0;
  const double x = std::clamp(u / curves.deepest_mm, 0.0, 1.0);
  const std::size_t i = std::clamp<std::size_t>(std::upper_bound(form_places.begin(), form_places.end(), x) - form_places.begin(), 1, form_places.size() - 1);
  const double share = (x - form_places[i - 1]) / (form_places[i] - form_places[i - 1]);
  const auto way = [&](std::size_t first) { return (1 - share) * form[first + i - 1] + share * form[first + i]; };
  const std::size_t first = forms_of_site * static_cast<std::size_t>(site.index);
  return 0.5 * (1 + s) * way(first) + 0.5 * (1 - s) * way(first + form_places.size());
}

/// c e / (e + m) through A at a and B at b, which is less than in proportion; where B is less than A no such curve is: straight lines through both.
double saturating(double e, double a, double b, double A, double B) {
  const double m = (B - A) / (A / a - B / b);
  if (m > 0 && e / a > 0) return A * (a + m) / a * e / (e + m);
  return e / a <= 1 ? A * e / a : A + (B - A) * (e - a) / (b - a);
}

}  // namespace

double EvenCurve::at(double u) const {
  const double x = (u - low_mm) / step_mm;
  if (!(x > 0)) return values.front();
  const auto i = static_cast<std::size_t>(x);
  if (i + 1 >= values.size()) return values.back();
  return values[i] + (x - static_cast<double>(i)) * (values[i + 1] - values[i]);
}

double Change::at(double e, double u, double s) const {
  if (changes.empty() || e == 0) return 0;
  const double a = amplitudes[0];
  if (changes.size() == 1) return e / a * changes[0].at(u, s);
  const double b = amplitudes[1], A = changes[0].at(u, s), B = changes[1].at(u, s);
  if (a * b > 0 && std::abs(B) < std::abs(A * b / a)) return saturating(e, a, b, A, B);
  return A * e * (e - b) / (a * (a - b)) + B * e * (e - a) / (b * (b - a));
}

double ClampSite::scatter_at(double share, bool opening) const {
  const auto next = std::upper_bound(form_places.begin() + 1, form_places.end() - 1, share) - form_places.begin();
  return scatter[opening][next - 1];
}

const ClampSite& ClampCurves::site(const Vec3& point) const {
  for (const ClampSite& s : sites)
    if (norm(s.point_mm - point) < 1e-6) return s;
  throw Failure(ExitCode::defect, "no curve of a clamp was solved there");
}

double clamp_elastic(const ClampCurves& curves, const ClampSite& site, const Tissue& tissue, const Eigen::VectorXd& form, double u, Way way) {
  const double modulus = modulus_ratio(curves, tissue);
  const double s = way.rubbing;
  double change = site.friction.at(tissue.friction, u, s) + site.angle.at(tissue.jaw_angle_deg, u, s) + form_at(curves, site, form, u, way.drag);
  for (const auto& [index, law] : site.laws) {
    const double own = std::log(tissue.parameters[index] / curves.parameters[index]);
    change += law.at(tissue.law->parameters[index].unit == "MPa" ? own - std::log(modulus) : own, u, s);
  }
  for (const Zone& zone : tissue.zones)
    for (const Slice& slice : site.slices)
      if (const double part = covered(slice, zone); part > 0) change += part * slice.thicker.at(std::log1p(zone.excess), u, s);
  const double e = curves.small_N;
  return modulus * ((site.force.at(u, way.drag) + e) * std::exp(std::clamp(change, -largest_change, largest_change)) - e);
}

std::vector<double> clamp_force(const ClampCurves& curves, const ClampSite& site, const Tissue& tissue, const std::vector<double>& forms, const ClampHistory& history) {
  const auto s = ways(history.u_mm);
  const Eigen::VectorXd form = forms.empty() ? Eigen::VectorXd() : Eigen::VectorXd(curves.forms * Eigen::Map<const Eigen::VectorXd>(forms.data(), static_cast<Eigen::Index>(forms.size())));
  std::vector<double> force;
  for (std::size_t i = 0; i < s.size(); ++i) force.push_back(clamp_elastic(curves, site, tissue, form, history.u_mm[i], s[i]));
  if (tissue.prony.empty()) return force;
  const auto left = relaxed(site, tissue, history);
  for (std::size_t i = 0; i < s.size(); ++i) force[i] *= left[i];
  return force;
}

}  // namespace palpate::loop
