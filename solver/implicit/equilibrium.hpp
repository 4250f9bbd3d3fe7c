// Equilibrium at a time by Newton's method with the consistent tangent and a line search; contact pressures are unknowns too.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

#include <solver/implicit/assembly.hpp>
#include <solver/implicit/free_bodies.hpp>
#include <solver/implicit/kept_factor.hpp>

namespace palpate::implicit {

/// What is most likely behind a step that was not found.
enum class Cause { unknown, element_inverted, law_not_stable, tool_too_fast, body_not_held, beyond_limit_point };

/// Why no equilibrium was found.
struct Trouble {
  std::string cause;         ///< in words, with what to try
  Eigen::Vector3d place_mm;  ///< in the organ's rest shape
  Cause likely = Cause::unknown;
};

struct NewtonLimits {
  int iterations = 25;
  double tolerance = 1e-9;  ///< of the residual: force over internal forces, volume over nodal volumes
  bool keep_factor = true;  ///< false: one in every iteration
};

struct Found {
  int iterations = 0;
  std::vector<double> residuals;  ///< relative, one per assembly
  Equations equations;            ///< at the solution
};

/// When linear equations count as solved.
struct LinearGoal {
  Eigen::VectorXd weights;  ///< of the rows, 1/N and 1/mm³
  double tolerance = 0;     ///< of their residual, in parts of the right-hand side
};

class Equilibrium {
 public:
  Equilibrium(const Model& model, int threads, NewtonLimits limits = {});

  /// Changes `state` to the equilibrium at `time` (s), or leaves it untouched, returns nothing and sets trouble(). At the state's own time: the
  /// step that led there is solved again from its memory.
  std::optional<Found> find(State& state, double time);
  /// As find(), for steps that it cannot make: follows the organ over an instability to the next equilibrium that is stable.
  std::optional<Found> find_by_drag(State& state, double time);
  /// How the unknowns of the state that was found last answer changes of the residual and of the prescribed displacements, one per
  /// column: K x = −r, x = prescribed where there are such. The factor at hand is refined to K at the solution, or renewed.
  Eigen::MatrixXd response(const Eigen::MatrixXd& residual_changes, const Eigen::MatrixXd& prescribed_changes);
  /// All that the next step needs to know of this one besides the state.
  void keep(Archive& archive);
  /// K at the state that was found last.
  const BlockMatrix& tangent() const { return tangent_; }
  const Trouble& trouble() const { return trouble_; }
  const Assembly& assembly() const { return assembly_; }
  Work work() const;
  /// A factor's, in iterations: see SparseDirect.
  int worth() const { return factor_.worth(); }

 private:
  struct Trial {
    State state;
    Eigen::VectorXd prescribed;  ///< increment still to be applied
    std::vector<double> excess;  ///< of force-controlled tools, N
    Equations equations;
    double residual = 0;
    std::vector<double> history;
    int iterations = 0;
  };
  /// Pulls every node back to where it was: see find_by_drag.
  struct Drag {
    double stiffness = 0;  ///< N/mm
    Eigen::VectorXd from;
  };
  Trial trial_from(const State& state, double time) const;
  Equations assemble(State& state);
  bool stable(const Trial& trial);
  bool drag_along(Trial& trial);
  std::optional<Found> accept(Trial& trial, State& state);
  std::optional<Found> solve(State& state, double time);
  bool drifts(const State& state);
  bool predict(Trial& trial, double time);
  bool newton(Trial& trial, const NewtonLimits& limits);
  bool line_search(Trial& trial, const Increment& step);
  bool evaluate(Trial& trial, const Trial& start, const Increment& step, double length);
  double slope(const Trial& trial, const Increment& step) const;
  bool jumped_through(const State& before, const Trial& after);
  bool renew_factor();
  LinearGoal goal(const Equations& equations, double tolerance) const;
  bool solve_linear(const LinearGoal& to, Eigen::VectorXd& x);
  std::optional<Increment> back_substitute(const Trial& trial, const ContactSums& contact, const LinearGoal& to);
  bool add_travels(const ContactSums& contact, const std::vector<double>& excess, const LinearGoal& to, Increment& step);
  double relative_residual(const Trial& trial) const;
  void explain_residual(const Trial& trial);
  void explain_stop(const State& from, double time);
  void explain_fault(const Equations& equations);
  void explain_singular();

  const Model& model_;
  NewtonLimits limits_;
  int threads_;
  Assembly assembly_;
  BlockMatrix tangent_;
  std::vector<char> fixed_;
  KeptFactor factor_;
  Work assembled_;
  bool factor_near_ = false;  ///< it is of the last iteration of the last state found, or of that state
  int free_pressures_ = 0;  ///< a stable equilibrium has as many negative pivots
  double volume_scale_ = 0, force_floor_ = 0, element_size_ = 0, stiffness_scale_ = 0;
  bool at_equilibrium_ = false;  ///< the tangent is that of the last state found
  Equations last_found_;         ///< of that state
  std::vector<FreeBody> free_bodies_;
  double rate_ = 0;              ///< of the step at hand, see below
  std::vector<double> rates_;    ///< of the predictor, mm/s, one per step found: they grow without bound towards a limit point
  Drag drag_;
  Trouble trouble_;
};

}  // namespace palpate::implicit
