// Newton: K Δ = −r with the prescribed displacements' increments on the right-hand side.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/implicit/equilibrium.hpp>

#include <cmath>

namespace palpate::implicit {
namespace {

constexpr double near_equilibrium = 1e-3;

SparseDirect solver_for(const BlockMatrix& tangent, int threads) {
  std::vector<int> rows, columns;
  tangent.coordinates(rows, columns);
  return SparseDirect(4 * tangent.nodes(), std::move(rows), std::move(columns), threads);
}

const char* words(elements::ElementFault fault) {
  switch (fault) {
    case elements::ElementFault::inverted:
      return "an element would turn inside out: try smaller steps, a finer or better mesh there, or less depth";
    case elements::ElementFault::bubble_not_positive:
      return "an element lost its stiffness (the law is not convex at this strain): try less depth or a law that stiffens";
    case elements::ElementFault::bubble_not_converged:
      return "an element's interior found no equilibrium: try smaller steps or a better mesh there";
    case elements::ElementFault::none: break;
  }
  return "";
}

}  // namespace

struct Equilibrium::Trial {
  State state;
  Eigen::VectorXd prescribed;  ///< increment still to be applied
  Equations equations;
  double residual = 0;
  std::vector<double> history;
  int iterations = 0;
};

Equilibrium::Equilibrium(const Model& model, int threads, NewtonLimits limits)
    : model_(model),
      limits_(limits),
      assembly_(model, threads),
      tangent_(static_cast<int>(model.points.size()), model.tets),
      solver_(solver_for(tangent_, threads)),
      fixed_(4 * model.points.size(), 0) {
  for (const auto& p : model.prescribed) fixed_[4 * p.node + p.component] = 1;
  for (std::size_t i = 3; i < fixed_.size(); i += 4) free_pressures_ += !fixed_[i];
  std::vector<double> nodal_volume(model.points.size(), 0.0);
  double volume = 0, shear_modulus = 0;
  for (const auto& tet : model.tets) {
    Eigen::Matrix<double, 3, 4> X;
    for (int a = 0; a < 4; ++a) X.col(a) = model.points[tet[a]];
    const double V = elements::tetrahedron(X).volume;
    volume += V;
    for (int node : tet) nodal_volume[node] += V / 4;
  }
  for (double v : nodal_volume) volume_scale_ += v * v;
  volume_scale_ = std::sqrt(volume_scale_);
  for (const auto& material : model.materials) shear_modulus = std::max(shear_modulus, material.shear_modulus());
  force_floor_ = 1e-6 * shear_modulus * std::pow(volume / model.tets.size(), 2.0 / 3);
}

double Equilibrium::relative_residual(const Trial& trial) const {
  double force = 0, volume = 0;
  const auto& r = trial.equations.residual;
  for (int i = 0; i < r.size(); ++i)
    if (!fixed_[i]) (i % 4 == 3 ? volume : force) += r(i) * r(i);
  const double scale = trial.equations.internal_force + force_floor_;
  return std::max({std::sqrt(force) / scale, std::sqrt(volume) / volume_scale_, trial.prescribed.norm()});
}

bool Equilibrium::factor() {
  at_equilibrium_ = false;
  std::vector<double> values;
  tangent_.values(fixed_, values);
  if (solver_.factor(values)) return true;
  trouble_ = {"the equations are singular: is the organ held? try a larger base", model_.points.front()};
  return false;
}

Eigen::VectorXd Equilibrium::back_substitute(const Trial& trial) {
  Eigen::VectorXd step = -trial.equations.residual - tangent_.multiply(trial.prescribed);
  for (int i = 0; i < step.size(); ++i)
    if (fixed_[i]) step(i) = trial.prescribed(i);
  solver_.solve(step);
  return step;
}

void Equilibrium::explain_fault(const Equations& equations) {
  trouble_ = {words(equations.fault), centroid(model_, equations.faulty_tet)};
}

void Equilibrium::explain_residual(const Trial& trial) {
  int worst = 0;
  double largest = -1;
  for (int node = 0; node < static_cast<int>(model_.points.size()); ++node)
    for (int c = 0; c < 3; ++c)
      if (!fixed_[4 * node + c] && std::abs(trial.equations.residual(4 * node + c)) > largest) {
        largest = std::abs(trial.equations.residual(4 * node + c));
        worst = node;
      }
  trouble_ = {"Newton's method does not settle (largest unbalanced force here): try smaller steps, a finer mesh under the tool, or less depth",
              model_.points[worst]};
}

/// Full steps unless an element would invert or the residual would jump; then halves.
bool Equilibrium::line_search(Trial& trial, const Eigen::VectorXd& step) {
  const State start = trial.state;
  const Eigen::VectorXd to_apply = trial.prescribed;
  const double before = trial.residual;
  for (double length = 1; length > 1e-3; length /= 2) {
    trial.state = start;
    trial.state.nodal += length * step;
    trial.equations = assembly_(trial.state, tangent_);
    if (trial.equations.fault != elements::ElementFault::none) continue;
    trial.prescribed = (1 - length) * to_apply;
    trial.residual = relative_residual(trial);
    if (trial.residual <= 10 * before || length < 0.2) return std::isfinite(trial.residual);
  }
  explain_fault(trial.equations);
  return false;
}

/// Euler's predictor: the organ gives way to the tool along the tangent at the old equilibrium. Without it the tool's new place
/// presses on points that it would have carried along. The factor left by the last step found is that tangent's, to Newton's last
/// correction.
bool Equilibrium::follow_tool(Trial& trial, double load) {
  if (!at_equilibrium_) {
    const Equations equations = assembly_(trial.state, tangent_);
    if (equations.fault != elements::ElementFault::none || !factor()) return false;
    by_travel_ = equations.by_travel;
  }
  if (by_travel_.isZero(0)) return false;
  trial.equations.residual = (load - trial.state.load) * model_.tool->depth * by_travel_;
  const Eigen::VectorXd step = back_substitute(trial);
  State moved = trial.state;
  moved.nodal += step;
  moved.load = load;
  trial.equations = assembly_(moved, tangent_);
  if (!step.allFinite() || trial.equations.fault != elements::ElementFault::none) return false;
  trial.state = std::move(moved);
  trial.prescribed.setZero();
  return true;
}

bool Equilibrium::newton(Trial& trial, double tolerance) {
  for (int i = 0; i < limits_.iterations; ++i) {
    if (trial.residual <= tolerance) return true;
    if (!factor() || !line_search(trial, back_substitute(trial))) return false;
    ++trial.iterations;
    trial.history.push_back(trial.residual);
  }
  if (trial.residual <= tolerance) return true;
  explain_residual(trial);
  return false;
}

std::optional<Found> Equilibrium::find(State& state, double load) {
  Trial trial;
  trial.state = state;
  trial.prescribed = Eigen::VectorXd::Zero(state.nodal.size());
  for (const auto& p : model_.prescribed)
    trial.prescribed(4 * p.node + p.component) = load * p.value - state.nodal(4 * p.node + p.component);
  const bool followed = model_.tool && follow_tool(trial, load);
  trial.state.load = load;
  for (int augmentation = 0; augmentation <= limits_.augmentations; ++augmentation) {
    if (augmentation > 0 || !followed) trial.equations = assembly_(trial.state, tangent_);
    if (trial.equations.fault != elements::ElementFault::none) {
      explain_fault(trial.equations);
      return {};
    }
    trial.residual = relative_residual(trial);
    trial.history.push_back(trial.residual);
    // Near equilibrium is near enough to see whether the pressures need augmenting.
    if (!newton(trial, near_equilibrium)) return {};
    if (trial.equations.contact.worst_gap <= limits_.penetration && !newton(trial, limits_.tolerance)) return {};
    if (trial.equations.contact.worst_gap <= limits_.penetration) {
      if (trial.iterations > 0 && solver_.negative_pivots() != free_pressures_) {
        trouble_ = {"the equilibrium is not stable (the load may be beyond a limit point): try smaller steps or less depth", model_.points.front()};
        return {};
      }
      state = std::move(trial.state);
      at_equilibrium_ = trial.iterations > 0;
      by_travel_ = trial.equations.by_travel;
      return Found{trial.iterations, std::move(trial.history), std::move(trial.equations)};
    }
    trial.state.multipliers = trial.equations.contact.pressure;
  }
  trouble_ = {"the tool's contact does not settle within its penetration limit: try a finer mesh under the tool", model_.points.front()};
  return {};
}

}  // namespace palpate::implicit
