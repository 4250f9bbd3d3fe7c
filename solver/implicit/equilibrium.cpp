// Newton: K Δ = −r with the prescribed displacements' increments on the right-hand side.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/implicit/equilibrium.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <solver/implicit/keep.hpp>
#include <solver/implicit/slips.hpp>

namespace palpate::implicit {
namespace {

/// A contact point's gap may miss that of its pressure by this many times the tolerance of the forces, in parts of the deepest gap.
constexpr double gap_scale = 1e-3;
/// Beyond this growth of the residual an iteration is lost, and a smaller step is cheaper.
constexpr double lost = 1e3;
/// Newton's equations are solved to the residual they are to remove, which keeps his order (Dembo, Eisenstat, Steihaug 1982, SIAM J. Numer.
/// Anal. 19:400), and to no less and no more than these.
constexpr double coarsest = 1e-3, finest = 1e-6;

std::vector<char> fixed_unknowns(const Model& model) {
  std::vector<char> fixed(4 * model.points.size(), 0);
  for (const auto& p : model.prescribed) fixed[4 * p.node + p.component] = 1;
  return fixed;
}

std::vector<double> excess(const Equations& equations) {
  std::vector<double> list;
  for (const auto& tool : equations.contact.tools) list.push_back(tool.excess);
  return list;
}

}  // namespace

Equilibrium::Equilibrium(const Model& model, int threads, NewtonLimits limits)
    : model_(model),
      limits_(limits),
      threads_(threads),
      assembly_(model, threads),
      tangent_(static_cast<int>(model.points.size()), model.tets, is_conservative(model)),
      fixed_(fixed_unknowns(model)),
      factor_(tangent_, fixed_, limits.keep_factor, threads),
      free_bodies_(free_bodies(model)) {
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
  element_size_ = std::cbrt(volume / model.tets.size());
  stiffness_scale_ = shear_modulus * element_size_;
  force_floor_ = 1e-4 * shear_modulus * element_size_ * element_size_;
}

Equations Equilibrium::assemble(State& state) {
  at_equilibrium_ = false;
  factor_.outdate();
  const Stopwatch watch(assembled_.assembly_s);
  ++assembled_.assemblies;
  Equations equations = assembly_(state, tangent_);
  if (drag_.stiffness == 0 || equations.fault != elements::ElementFault::none) return equations;
  for (int i = 0; i < state.nodal.size(); ++i)
    if (i % 4 != 3) equations.residual(i) += drag_.stiffness * (state.nodal(i) - drag_.from(i));
  tangent_.add_to_displacements(drag_.stiffness);
  return equations;
}

Work Equilibrium::work() const {
  Work all = factor_.work();
  all.assemblies = assembled_.assemblies;
  all.assembly_s = assembled_.assembly_s;
  return all;
}

double Equilibrium::relative_residual(const Trial& trial) const {
  double force = 0, volume = 0;
  const auto& r = trial.equations.residual;
  for (int i = 0; i < r.size(); ++i)
    if (!fixed_[i]) (i % 4 == 3 ? volume : force) += r(i) * r(i);
  const double scale = trial.equations.internal_force + force_floor_;
  double excess = 0;
  for (double e : trial.excess) excess = std::max(excess, std::abs(e));
  return std::max({std::sqrt(force) / scale, std::sqrt(volume) / volume_scale_, trial.prescribed.norm(), excess / scale,
                   gap_scale * trial.equations.contact.mismatch});
}

/// What a linear solution is to reach, of the equations at a state.
LinearGoal Equilibrium::goal(const Equations& equations, double tolerance) const {
  Eigen::VectorXd weights = Eigen::VectorXd::Constant(equations.residual.size(), 1 / (equations.internal_force + force_floor_));
  for (int i = 3; i < weights.size(); i += 4) weights(i) = 1 / volume_scale_;
  return {std::move(weights), tolerance};
}

bool Equilibrium::renew_factor() {
  factor_near_ = true;
  if (factor_.renew(tangent_)) return true;
  explain_singular();
  return false;
}

bool Equilibrium::solve_linear(const LinearGoal& to, Eigen::VectorXd& x) {
  if (factor_.solve(tangent_, to.weights, to.tolerance, x)) return true;
  explain_singular();
  return false;
}

/// `contact`: of the state whose tangent is at hand. Nothing where that is singular.
std::optional<Increment> Equilibrium::back_substitute(const Trial& trial, const ContactSums& contact, const LinearGoal& to) {
  Increment step{-trial.equations.residual - tangent_.multiply(trial.prescribed), std::vector<double>(model_.tools.size(), 0.0)};
  for (int i = 0; i < step.nodal.size(); ++i)
    if (fixed_[i]) step.nodal(i) = trial.prescribed(i);
  if (!solve_linear(to, step.nodal)) return {};
  if (has_force_control(model_) && !add_travels(contact, trial.excess, to, step)) return {};
  return step;
}

/// The trial after a part of a step; false when an element would invert.
bool Equilibrium::evaluate(Trial& trial, const Trial& start, const Increment& step, double length) {
  trial.state = start.state;
  trial.state.nodal += length * step.nodal;
  for (std::size_t i = 0; i < step.travels.size(); ++i) trial.state.travels[i] += length * step.travels[i];
  trial.state.contact_pressures = assembly_.next_pressures(start.state, start.equations.contact, step, start.state.time, length);
  trial.state.pair_pressures = assembly_.next_pair_pressures(start.state, start.equations.contact, step, length);
  trial.prescribed = (1 - length) * start.prescribed;
  trial.equations = assemble(trial.state);
  if (trial.equations.fault != elements::ElementFault::none) {
    explain_fault(trial.equations);
    return false;
  }
  trial.excess = excess(trial.equations);
  trial.residual = relative_residual(trial);
  return true;
}

/// Euler's predictor: the organ gives way to tools and loads along the tangent at the old equilibrium. Without it a tool's new place
/// presses on points that it would have carried along.
bool Equilibrium::predict(Trial& trial, double time) {
  if (!at_equilibrium_) {
    last_found_ = assemble(trial.state);
    if (last_found_.fault != elements::ElementFault::none || !renew_factor()) return false;
  }
  trial.equations.residual = assembly_.change_by_time(last_found_, trial.state.time, time);
  trial.excess.clear();
  for (const auto& tool : model_.tools) trial.excess.push_back(tool.force_controlled ? tool.force * (tool.ramp.at(trial.state.time) - tool.ramp.at(time)) : 0);
  const bool still = trial.equations.residual.isZero(0) && trial.prescribed.isZero(0) && !has_force_control(model_);
  if (still && !model_.tools.empty()) return false;  // no tool touches yet
  const auto step = back_substitute(trial, last_found_.contact, goal(last_found_, factor_near_ ? 1 : coarsest));
  if (!step) return false;
  State moved = trial.state;
  moved.nodal += step->nodal;
  for (std::size_t i = 0; i < step->travels.size(); ++i) moved.travels[i] += step->travels[i];
  moved.contact_pressures = assembly_.next_pressures(trial.state, last_found_.contact, *step, time, 1);
  moved.pair_pressures = assembly_.next_pair_pressures(trial.state, last_found_.contact, *step, 1);
  moved.time = time;
  trial.equations = assemble(moved);
  rate_ = step->nodal.norm() / (time - trial.state.time);
  if (!step->nodal.allFinite() || trial.equations.fault != elements::ElementFault::none) return false;
  trial.state = std::move(moved);
  trial.prescribed.setZero();
  return true;
}

bool Equilibrium::newton(Trial& trial, const NewtonLimits& limits) {
  trial.excess = excess(trial.equations);
  trial.residual = relative_residual(trial);
  trial.history.push_back(trial.residual);
  factor_near_ = false;
  const double hopeless = lost * std::max(1.0, trial.residual);
  while (!(trial.residual <= limits.tolerance)) {
    if (trial.iterations == limits.iterations || !(trial.residual <= hopeless)) {
      explain_residual(trial);
      return false;
    }
    const int factors = factor_.work().factors;
    const auto step = back_substitute(trial, trial.equations.contact, goal(trial.equations, std::clamp(trial.residual, finest, coarsest)));
    factor_near_ = factor_.work().factors != factors;
    if (!step || !line_search(trial, *step)) return false;
    ++trial.iterations;
    trial.history.push_back(trial.residual);
  }
  return true;
}

std::optional<Found> Equilibrium::find(State& state, double time) {
  const double from = state.time;
  rate_ = 0;
  trouble_ = {};
  auto found = solve(state, time);
  if (!found) explain_stop(state, time);
  else if (rate_ > 0 && time > from) rates_.push_back(rate_);
  return found;
}

/// From `state`, with its prescribed displacements still to be applied.
Equilibrium::Trial Equilibrium::trial_from(const State& state, double time) const {
  Trial trial;
  trial.state = state;
  if (time != state.time) assembly_.remember(trial.state);
  trial.prescribed = Eigen::VectorXd::Zero(state.nodal.size());
  for (const auto& p : model_.prescribed)
    trial.prescribed(4 * p.node + p.component) =
        model_.amplitudes[p.amplitude].at(time) * p.value - state.nodal(4 * p.node + p.component);
  return trial;
}

/// The factor of the last iteration says so, which is of a tangent close to convergence, or the solution's; of unsymmetric ones nothing is known.
bool Equilibrium::stable(const Trial& trial) {
  if (trial.iterations == 0 || !tangent_.symmetric()) return true;
  if (!factor_near_ && !renew_factor()) return false;
  if (factor_.has_negative_pivots(tangent_, free_pressures_)) return true;
  trouble_ = {"the equilibrium is not stable (the load may be beyond a limit point): try smaller steps or less depth", model_.points.front(),
              Cause::beyond_limit_point};
  return false;
}

/// Makes a trial that found equilibrium the state.
std::optional<Found> Equilibrium::accept(Trial& trial, State& state) {
  if (jumped_through(state, trial) || drifts(trial.state)) return {};
  state = std::move(trial.state);
  at_equilibrium_ = true;
  last_found_ = trial.equations;
  remember_slips(model_, trial.equations.contact, state);
  return Found{trial.iterations, std::move(trial.history), std::move(trial.equations)};
}

void Equilibrium::keep(Archive& archive) {
  archive(at_equilibrium_, factor_near_, last_found_, rates_, tangent_, factor_);
}

std::optional<Found> Equilibrium::solve(State& state, double time) {
  Trial trial = trial_from(state, time);
  const bool predicted = time != state.time && predict(trial, time);
  trial.state.time = time;
  if (!predicted) trial.equations = assemble(trial.state);
  if (trial.equations.fault != elements::ElementFault::none) {
    explain_fault(trial.equations);
    return {};
  }
  if (!newton(trial, limits_) || !stable(trial)) return {};
  return accept(trial, state);
}

Eigen::MatrixXd Equilibrium::response(const Eigen::MatrixXd& residual_changes, const Eigen::MatrixXd& prescribed_changes) {
  constexpr double exact = 1e-11;
  constexpr int slow = 6;  // corrections, after which a factor of this very tangent is cheaper
  Eigen::MatrixXd x = prescribed_changes;
  const auto left = [&] {
    Eigen::MatrixXd r = -residual_changes;
    for (int k = 0; k < r.cols(); ++k) r.col(k) -= tangent_.multiply(x.col(k));
    for (int i = 0; i < r.rows(); ++i)
      if (fixed_[i]) r.row(i).setZero();
    return r;
  };
  Eigen::MatrixXd r = left();
  const Eigen::RowVectorXd scale = r.colwise().norm();
  if (!factor_near_ && !renew_factor()) throw std::logic_error("the tangent of an equilibrium is singular");
  for (int correction = 0; correction <= 2 * slow; ++correction) {
    if (((r.colwise().norm() - exact * scale).array() <= 0).all()) break;
    if (correction == slow && !renew_factor()) throw std::logic_error("the tangent of an equilibrium is singular");
    factor_.apply(r);
    x += r;
    r = left();
  }
  return x;
}

}  // namespace palpate::implicit
