// Coulomb's bound by a return to the cone: of a trial v the part along the surface, v − n (n·v), scaled back to μ t where it is larger.
// (Simo and Laursen 1992, Computers & Structures 42:97, eq. 2.23–2.26; tangent with all of its terms.)
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <solver/contact/touch.hpp>

namespace palpate::contact {

/// What slid is remembered with this part less of its shear: when nothing moves on, it sticks, and rounding does not decide.
constexpr double inside_the_cone = 1e-5;

/// A shear (MPa) within the bound, and its derivatives.
struct Coulomb {
  Eigen::Vector3d shear = Eigen::Vector3d::Zero();
  Eigen::Matrix3d by_trial = Eigen::Matrix3d::Zero(), by_normal = Eigen::Matrix3d::Zero();  ///< by_normal: MPa
  Eigen::Vector3d by_pressure = Eigen::Vector3d::Zero();
  bool slides = false;  ///< at the bound
  bool beyond = false;  ///< the trial is beyond it: what `slides` is by the bound
};

/// `trial`: v, MPa; `n`: unit; `mu`: infinite where what touches sticks; `pressure`: MPa, positive.
inline Coulomb coulomb(const Eigen::Vector3d& trial, const Eigen::Vector3d& n, double mu, double pressure, Branch branch = Branch::by_bound) {
  using Eigen::Matrix3d;
  const double along_normal = n.dot(trial);
  Coulomb c{trial - n * along_normal, Matrix3d::Identity() - n * n.transpose(), -along_normal * Matrix3d::Identity() - n * trial.transpose()};
  const double size = c.shear.norm(), bound = mu * pressure;
  c.beyond = !(size <= bound);
  if (size == 0 || !(branch == Branch::by_bound ? c.beyond : branch == Branch::slides)) return c;
  const Eigen::Vector3d m = c.shear / size;
  c.shear = bound * m;
  for (Matrix3d* by : {&c.by_trial, &c.by_normal}) *by = bound / size * (*by - m * (m.transpose() * *by));
  c.by_pressure = mu * m;
  c.slides = true;
  return c;
}

/// What a point's shear answered, and to what.
struct KnownCoulomb {
  Eigen::Vector3d trial = Eigen::Vector3d::Zero(), normal = Eigen::Vector3d::Zero();
  double mu = 0, pressure = 0;
  Coulomb answer;
};

/// To first order from what is known, on the same branch; `beyond` is of the trial itself.
inline Coulomb coulomb_beside(const KnownCoulomb& known, const Eigen::Vector3d& trial, const Eigen::Vector3d& n, double mu, double pressure) {
  Coulomb c = known.answer;
  c.beyond = coulomb(trial, n, mu, pressure).beyond;
  c.shear += c.by_trial * (trial - known.trial) + c.by_normal * (n - known.normal) + c.by_pressure * (pressure - known.pressure);
  if (c.slides) c.shear += (mu - known.mu) / known.mu * known.answer.shear;
  return c;
}

}  // namespace palpate::contact
