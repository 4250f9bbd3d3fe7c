// A tube closed between jaws: the force over closure as palpate-solve has it, and what effects change of it, all from whole runs.
// u = declared diameter − gap between the jaws. F(u) = m (F₀ + ε) exp(Σ changes of ln(F + ε)) − mε, m the modulus over that of the solves, ε half a percent of the largest
// force; each change goes through none and two amplitudes that were solved: a parabola, or where it saturates (friction that holds on already) c e / (e + m). Curves closing and opening differ: between them goes s = ±1, which follows the
// motion over 5 % of the closure. F₀ has no friction and differs by the solver's drag alone: its s is 0 at rest; of what rubs it stays. Relaxation: F(t) = F₀ Σ_k r_k(t) F(u, k) / Σ_k h_k(u) F(u, k), F(j, k) the force of the stresses of closure k in
// the shape of closure j (solver/explicit/stress_works.hpp), h the hats of the moments k, r = ∫ G(t − s) dh(u(s)).
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <array>

#include <loop/forward/tissue.hpp>

namespace palpate::loop {

/// A function of closure at even places; straight between them, constant beyond.
struct EvenCurve {
  double low_mm = 0, step_mm = 1;
  std::vector<double> values;
  double at(double u_mm) const;
};

/// Forces, or changes of ln(F + ε), on the way in and out.
struct BothWays {
  EvenCurve closing, opening;
  double at(double u_mm, double s) const { return 0.5 * (1 + s) * closing.at(u_mm) + 0.5 * (1 - s) * opening.at(u_mm); }
};

/// What an effect changes, solved at two amplitudes (one: a straight line), of one sign where it may saturate.
struct Change {
  std::vector<double> amplitudes;
  std::vector<BothWays> changes;
  double at(double amplitude, double u_mm, double s) const;
};

/// A slice of the tube, from `from` to `to` mm along it, whose wall was made thicker and thinner: changes over ln(1 + excess).
struct Slice {
  double from = 0, to = 0;
  Change thicker;
};

/// One place of the jaws.
struct ClampSite {
  Vec3 point_mm{0, 0, 0};
  BothWays force;                            ///< N, at the start parameters: mean of ln(F + ε) over its meshes
  int index = 0;                             ///< among the sites
  std::array<std::vector<double>, 2> scatter;  ///< what meshes differ by between the places of the curve's own error, closing and opening, rms over the largest force
  /// Of these, at a share of the deepest closure.
  double scatter_at(double share, bool opening) const;
  Change friction, angle;                    ///< over μ, and degrees between the jaws
  std::vector<Slice> slices;
  std::vector<std::pair<int, Change>> laws;  ///< over ln of a law's further parameters, by index
  std::vector<double> moments_mm;
  Eigen::MatrixXd works;                     ///< F(j, k), N
};

/// Places of the curve's own error, shares of the deepest closure, denser where the wall meets itself; between them it is straight.
inline constexpr std::array<double, 16> form_places = {0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.68, 0.75, 0.81, 0.86, 0.9, 0.93, 0.96, 0.98, 1};
inline constexpr std::size_t forms_of_site = 2 * form_places.size();  ///< closing, then opening

/// Everything solved of a set's clamp.
struct ClampCurves {
  double deepest_mm = 0, small_N = 0;        ///< ε
  Eigen::MatrixXd forms;                     ///< of ln(F + ε) at the places of each site, per deviation of each of the curves' own errors: what meshes differ by
  double form_sd() const { return forms.rows() > 0 ? forms.rowwise().norm().mean() : 0; }
  double correlation = 0;                    ///< of the scatter, from one block of samples to the next
  std::vector<double> parameters;            ///< of the law, in the solves
  std::vector<ClampSite> sites;
  int solves = 0;                            ///< closings that these curves come from, kept ones too
  const ClampSite& site(const Vec3& point_mm) const;
};

/// Forces at closures `u_mm` at times `t_s`; `forms`: how large each of the curves' own errors is, in deviations, or nothing. No compliance.
struct ClampHistory {
  const std::vector<double>& t_s;
  const std::vector<double>& u_mm;
};
std::vector<double> clamp_force(const ClampCurves& curves, const ClampSite& site, const Tissue& tissue, const std::vector<double>& forms, const ClampHistory& history);

/// From 1, closing, to −1, opening.
struct Way {
  double rubbing = 1, drag = 1;
};

/// The elastic force alone; `form` of ln(F + ε) at the places of each site, or nothing.
double clamp_elastic(const ClampCurves& curves, const ClampSite& site, const Tissue& tissue, const Eigen::VectorXd& form, double u_mm, Way way);

}  // namespace palpate::loop
