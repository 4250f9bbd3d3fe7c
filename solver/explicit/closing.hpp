// Closing the jaws on a wall, step by step, with what is reported on the way.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <string>

#include <solver/explicit/case.hpp>
#include <solver/explicit/self_contact.hpp>
#include <solver/explicit/wall_fields.hpp>

namespace palpate::explicit_shell {

/// A row of the history: forces are means since the last row.
struct Row {
  double time = 0, travel = 0, gap = 0;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< by the upper jaw on the wall, N
  double closing_force = 0;  ///< along its axis, N
  double jaw_area = 0;       ///< of the wall in contact with the upper jaw, mm²
  double self_area = 0;      ///< of the wall in contact with itself, mm²
  long cycles = 0;
  double step = 0;           ///< s
  Ledger ledger;
  void keep(Archive& archive) { archive(time, travel, gap, force, closing_force, jaw_area, self_area, cycles, step, ledger); }
};

struct Closing {
  explicit Closing(Case& the_case, int threads);

  Case& c;
  std::optional<TissueForces> tissue;  ///< where effects add to the law
  Motion motion;
  Jaws jaws;
  SelfContact self;
  double end = 0;         ///< s, of the jaws' clock, which runs slower while they wait
  long cycles = 0;
  double worst_imbalance = 0;  ///< of the largest internal energy so far
  double peak_internal = 0;
  double worst_kinetic = 0;    ///< wall's kinetic over internal energy after a tenth of the closing

  /// Everything the next step needs, at a row's end: run() then goes on from there.
  void keep(Archive& archive);

  /// Runs to the end. `row` is called at even times of the jaws' clock, `frame` at even ones of its own and at the end. Throws Failure(not_converged)
  /// naming the triangle, where and why: the step collapsed, the wall is no longer finite, energy drifts.
  void run(const std::function<void(const Row&)>& row, const std::function<void(const Row&)>& frame, const std::function<void()>& save = {});

  /// The present state as a row, with this force.
  Row row_of(const Eigen::Vector3d& force) const;
  /// Normal force of jaws and self-contact on each node over its area, MPa.
  std::vector<double> contact_pressure() const;
  /// The tissue, or null.
  const TissueForces* effects_on_stress() const { return tissue ? &*tissue : nullptr; }

 private:
  void advance(double dt);
  void keep_pace();
  void contact();
  void judge();
  void relax();
  void expect_sound(const Row& row) const;
  double step_ = 0, stiffness_ = 0, first_stable_ = 0, shortest_edge_ = 0;
  double clock_ = 0, pace_ = 1;  ///< of the jaws: s, and how much slower than asked they go
  double beds_stiffness_ = 0;   ///< over mass, 1/s²
  long judged_again_ = 0;
  int rows_ = 0, frames_ = 0;   ///< done; a run that is continued has some
  std::vector<double> node_area_;
  FewForces jaw_force_, self_force_;
  bool swept_ = false;    ///< nodes without contact have none in the motion's
  double strayed_ = -1;   ///< square of the farthest from where self-contact was searched
};

}  // namespace palpate::explicit_shell
