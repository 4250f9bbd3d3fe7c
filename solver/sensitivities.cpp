// Shadows that follow a run.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/sensitivities.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

#include <palpate/errors.hpp>
#include <solver/moved_case.hpp>
#include <solver/implicit/keep.hpp>
#include <solver/implicit/slips.hpp>
#include <solver/remesh.hpp>
#include <solver/results.hpp>

namespace palpate {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Whether the driven tool's depth is not given but found.
bool depth_answers(const Case& c) { return !c.model.tools.empty() && c.model.tools.front().force_controlled; }

/// Values of the prescribed displacements at a time, 0 elsewhere.
VectorXd prescribed(const implicit::Model& model, double time) {
  VectorXd values = VectorXd::Zero(4 * model.points.size());
  for (const auto& p : model.prescribed) values(4 * p.node + p.component) = model.amplitudes[p.amplitude].at(time) * p.value;
  return values;
}

implicit::BlockMatrix matrix_of(const implicit::Model& model) {
  return {static_cast<int>(model.points.size()), model.tets, implicit::is_conservative(model)};
}

/// Whether a point of contact would slide aside and sticks in the run, or the other way round: the run is where derivatives are of one side.
bool slides_elsewhere(const implicit::ContactSums& aside, const implicit::ContactSums& run) {
  for (std::size_t i = 0; i < aside.points.size(); ++i)
    if (aside.points[i].beyond != run.points[i].slides) return true;
  for (std::size_t i = 0, j = 0; i < aside.pairs.size() && j < run.pairs.size();) {  // ascending; those that touch in both
    const auto &a = aside.pairs[i], &b = run.pairs[j];
    if (a.at == b.at && a.law.answer.beyond != b.law.answer.slides) return true;
    i += a.at <= b.at;
    j += b.at <= a.at;
  }
  return false;
}

}  // namespace

Shadow::Shadow(std::string number, double by, Case moved, int threads)
    : path(std::move(number)), change(by), the_case(std::move(moved)), assembly(the_case.model, threads), state(implicit::rest_state(the_case.model)) {}

Sensitivities::Sensitivities(const Settings& settings, const std::filesystem::path& mesh_override, const std::vector<std::string>& numbers,
                             implicit::Equilibrium& equilibrium, int threads)
    : settings_(settings),
      threads_(threads),
      equilibrium_(&equilibrium),
      still_(std::make_unique<Shadow>("", 0, read_case(settings, mesh_override), threads)),
      scratch_(matrix_of(still_->the_case.model)) {
  if (numbers.empty()) throw Failure(ExitCode::misuse, "no numbers to differentiate by", "--sensitivities", "a path such as material.mu");
  table_ = "t[s]";
  for (const auto& path : numbers) {
    MovedCase moved = moved_case(settings, mesh_override, path, still_->the_case);
    shadows_.push_back(std::make_unique<Shadow>(path, moved.change, std::move(moved.the_case), threads));
    shadows_.back()->at_end = moved.at_end;
    if (moved.is_secant) shadows_.back()->own = std::make_unique<implicit::Equilibrium>(shadows_.back()->the_case.model, threads);
    std::vector<std::string> forces = {"F", "Fx", "Fy", "Fz"};
    for (std::size_t i = 2; i <= still_->the_case.model.tools.size(); ++i)
      for (const char* component : {"Fx", "Fy", "Fz"}) forces.push_back(component + std::to_string(i));
    if (depth_answers(still_->the_case)) forces.push_back("depth");
    for (const auto& force : forces) table_ += ",d" + force + "/d(" + path + ")";
  }
  table_ += "\n";
}

void Sensitivities::take_tools_away() {
  palpate::take_tools_away(still_->the_case);
  for (auto& shadow : shadows_) palpate::take_tools_away(shadow->the_case);
}

void Sensitivities::bring_tools() {
  palpate::bring_tools(still_->the_case, still_->state);
  for (auto& shadow : shadows_) palpate::bring_tools(shadow->the_case, shadow->state);
}

void Sensitivities::use_mesh(const std::filesystem::path& mesh, implicit::Equilibrium& equilibrium, const implicit::Origins* origins) {
  equilibrium_ = &equilibrium;
  const auto use = [&](std::unique_ptr<Shadow>& shadow) {
    Settings settings = Settings::read(settings_.file());
    if (!shadow->path.empty()) settings.shift(shadow->path, shadow->change);
    auto fresh = std::make_unique<Shadow>(shadow->path, shadow->change, case_on(settings, mesh, shadow->the_case), threads_);
    fresh->one_sided = shadow->one_sided;
    if (origins) fresh->state = implicit::carried(shadow->the_case.model, shadow->state, fresh->the_case.model, *origins);
    if (shadow->own) fresh->own = std::make_unique<implicit::Equilibrium>(fresh->the_case.model, threads_);
    shadow = std::move(fresh);
  };
  use(still_);
  for (auto& shadow : shadows_) use(shadow);
  scratch_ = matrix_of(still_->the_case.model);
}

void Sensitivities::keep(Archive& archive) {
  const auto keep_one = [&](Shadow& shadow) {
    archive(shadow.state, shadow.shifts, shadow.force_rates, shadow.one_sided, shadow.depth_rate);
    if (shadow.own) archive(*shadow.own);
    for (auto& tool : shadow.the_case.model.tools) archive(tool.first_contact);
  };
  keep_one(*still_);
  for (auto& shadow : shadows_) keep_one(*shadow);
  archive(table_, weak_steps_);
  if (implicit::remembers(still_->the_case.model)) archive(known_);
}

/// The shadow at the run's new displacements, with its own memory and numbers.
void Sensitivities::approach(Shadow& shadow, const implicit::State& found) {
  shadow.state.memory_time = found.memory_time;  // also where the run began
  shadow.state.nodal = found.nodal;
  shadow.state.bubbles = found.bubbles;
  shadow.state.contact_pressures = found.contact_pressures;
  shadow.state.pair_pressures = found.pair_pressures;
  shadow.state.travels = found.travels;
  shadow.state.time = found.time;
  if (&shadow == still_.get()) {
    implicit::State at = shadow.state;
    shadow.assembly(at, scratch_, &known_);
  }
  shadow.equations = shadow.assembly.beside(shadow.state, known_, shadow.shifts, scratch_);
}

/// By the number at fixed displacements, and by the displacements along the tangent: to first order in exact arithmetic the forces of the
/// shadow where it stands aside, but its contact would round them.
void Sensitivities::find_force_rates(const std::vector<implicit::Increment>& steps) {
  const auto& tools = still_->the_case.model.tools;
  const auto& still = still_->equations;
  for (auto& shadow : shadows_) shadow->force_rates.assign(tools.size(), Vector3d::Zero());
  for (std::size_t i = 0; i < tools.size(); ++i) {
    MatrixXd against_tool(still.residual.size(), steps.size());  // only the place of organ and tool against each other counts
    for (std::size_t k = 0; k < steps.size(); ++k) {
      against_tool.col(k) = steps[k].nodal;
      for (int at = 0; at < against_tool.rows(); at += 4) against_tool.col(k).segment<3>(at) -= steps[k].travels[i] * tools[i].axis;
    }
    const Eigen::Matrix3Xd by_place = still_->assembly.tool_force_changes(static_cast<int>(i), still_->state, against_tool);
    for (std::size_t k = 0; k < steps.size(); ++k) {
      Vector3d change = shadows_[k]->equations.contact.tools[i].force - still.contact.tools[i].force;
      if (!shadows_[k]->own) change += by_place.col(k);
      shadows_[k]->force_rates[i] = change / shadows_[k]->change;
    }
  }
  if (!tools.empty() || still_->the_case.moved.empty()) return;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    Shadow& shadow = *shadows_[k];
    const VectorXd residual = shadow.equations.residual - still.residual + equilibrium_->tangent().multiply(steps[k].nodal);
    shadow.force_rates.assign(1, Vector3d::Zero());
    for (int node : still_->the_case.moved.front().nodes) shadow.force_rates.front() += residual.segment<3>(4 * node) / shadow.change;
  }
}

/// The same step of a run of its own.
void Sensitivities::run_on(Shadow& shadow, const implicit::State& found) {
  if (found.time == shadow.state.time) return;
  shadow.state.time = found.memory_time;
  auto step = shadow.own->find(shadow.state, found.time);
  if (!step)
    throw Failure(ExitCode::not_converged, "the run whose secant stands in for a derivative by " + shadow.path + " stopped: " + shadow.own->trouble().cause, "--sensitivities", "leave this number out");
  shadow.equations = std::move(step->equations);
}

std::vector<std::string> Sensitivities::remarks() const {
  std::vector<std::string> list;
  for (const auto& shadow : shadows_) {
    if (shadow->own) list.push_back("d/d(" + shadow->path + ") is the secant to " + std::to_string(shadow->change) + ", by a run of its own: friction that is off has no derivative");
    else if (shadow->at_end) list.push_back("d/d(" + shadow->path + ") is of one side: the number is at the end of its range");
  }
  return list;
}

std::vector<std::string> Sensitivities::one_sided() const {
  std::vector<std::string> list;
  for (const auto& shadow : shadows_)
    if (shadow->one_sided > 0)
      list.push_back("d/d(" + shadow->path + ") is of one side in " + std::to_string(shadow->one_sided) + " step(s): points of contact are about to slide or to stick");
  if (weak_steps_ > 0)
    list.push_back("all derivatives are of one side in " + std::to_string(weak_steps_) + " step(s): points touch a tool without pressing");
  return list;
}

/// From the run's displacements to its own: what it remembers of the step is of there.
void Sensitivities::step_aside(Shadow& shadow, const implicit::Increment& step) {
  const auto& model = shadow.the_case.model;
  if (shadow.state.memory.empty() && shadow.state.slips.empty() && shadow.state.pair_slips.empty()) {
    shadow.state.nodal += step.nodal;  // tools may come to where it is
    return;
  }
  auto pressures = shadow.assembly.next_pressures(shadow.state, shadow.equations.contact, step, shadow.state.time, 1);
  auto pair_pressures = shadow.assembly.next_pair_pressures(shadow.state, shadow.equations.contact, step, 1);
  shadow.state.nodal += step.nodal;
  for (std::size_t i = 0; i < step.travels.size(); ++i) shadow.state.travels[i] += step.travels[i];
  shadow.state.contact_pressures = std::move(pressures);
  shadow.state.pair_pressures = std::move(pair_pressures);
  shadow.assembly.let_bubbles_follow(shadow.state, known_, step.nodal);
  if (!implicit::has_friction(model) && !implicit::organs_rub(model)) return;
  const auto aside = shadow.assembly.without_tissue(shadow.state, known_, scratch_);
  shadow.one_sided += slides_elsewhere(aside.contact, still_->equations.contact);
  implicit::remember_slips(model, aside.contact, shadow.state);
}

void Sensitivities::follow(const implicit::State& found) {
  const int count = static_cast<int>(shadows_.size());
  const auto remember = [&](Shadow& shadow) {
    if (found.time != shadow.state.time && !shadow.own) shadow.assembly.remember(shadow.state, &known_, &shadow.shifts);
  };
  remember(*still_);  // all of them before it is known where the run has come to
  for (auto& shadow : shadows_) remember(*shadow);
  approach(*still_, found);
  weak_steps_ += still_->equations.contact.weakly_active > 0;
  const VectorXd still_prescribed = prescribed(still_->the_case.model, found.time);
  MatrixXd residual_changes(found.nodal.size(), count), prescribed_changes(found.nodal.size(), count);
  for (int k = 0; k < count; ++k) {
    Shadow& shadow = *shadows_[k];
    residual_changes.col(k).setZero();
    prescribed_changes.col(k).setZero();
    if (shadow.own) {
      run_on(shadow, found);
      continue;
    }
    approach(shadow, found);
    residual_changes.col(k) = shadow.equations.residual - still_->equations.residual;
    prescribed_changes.col(k) = prescribed(shadow.the_case.model, found.time) - still_prescribed;
  }
  const auto steps = responses(residual_changes, prescribed_changes);
  find_force_rates(steps);
  for (int k = 0; k < count; ++k) {
    if (steps[k].travels.empty()) continue;
    const double travel = shadows_[k]->own ? shadows_[k]->state.travels.front() - found.travels.front() : steps[k].travels.front();
    shadows_[k]->depth_rate = travel / shadows_[k]->change;
  }
  for (int k = 0; k < count; ++k)
    if (!shadows_[k]->own) step_aside(*shadows_[k], steps[k]);
  step_aside(*still_, {VectorXd::Zero(found.nodal.size()), std::vector<double>(still_->the_case.model.tools.size(), 0.0)});
}

/// Of the nodes, and of the tools whose force is given: [K b; c d][x; s] = −[r; e] by elimination of the nodes, as in a Newton step.
std::vector<implicit::Increment> Sensitivities::responses(const MatrixXd& residual_changes, const MatrixXd& prescribed_changes) {
  const auto& model = still_->the_case.model;
  const auto& sums = still_->equations.contact.tools;
  std::vector<int> free;
  for (std::size_t i = 0; i < model.tools.size(); ++i)
    if (model.tools[i].force_controlled && sums[i].area > 0) free.push_back(static_cast<int>(i));
  const int count = static_cast<int>(residual_changes.cols()), more = static_cast<int>(free.size());
  MatrixXd residuals(residual_changes.rows(), count + more), prescribed = MatrixXd::Zero(residual_changes.rows(), count + more);
  residuals.leftCols(count) = residual_changes;
  prescribed.leftCols(count) = prescribed_changes;
  for (int j = 0; j < more; ++j) residuals.col(count + j) = sums[free[j]].by_travel;
  const MatrixXd x = equilibrium_->response(residuals, prescribed);
  MatrixXd stiffness(more, more);
  for (int i = 0; i < more; ++i) {
    for (int j = 0; j < more; ++j) stiffness(i, j) = sums[free[i]].along_by_nodes.dot(x.col(count + j));
    for (int at = 0; at < x.rows(); at += 4) stiffness(i, i) -= sums[free[i]].by_travel.segment<3>(at).dot(model.tools[free[i]].axis);
  }
  std::vector<implicit::Increment> steps;
  for (int k = 0; k < count; ++k) {
    steps.push_back({x.col(k), std::vector<double>(model.tools.size(), 0.0)});
    VectorXd left(more);
    for (int i = 0; i < more; ++i)
      left(i) = sums[free[i]].excess - shadows_[k]->equations.contact.tools[free[i]].excess - sums[free[i]].along_by_nodes.dot(x.col(k));
    const VectorXd travels = more > 0 ? VectorXd(stiffness.partialPivLu().solve(left)) : left;
    for (int j = 0; j < more; ++j) {
      steps[k].travels[free[j]] = travels(j);
      steps[k].nodal += travels(j) * x.col(count + j);
    }
  }
  return steps;
}

void Sensitivities::add(const implicit::Step& step) {
  std::ostringstream row;
  row.precision(12);
  row << step.state.time;
  const Vector3d direction = driven_direction(still_->the_case);
  const Driven still = driven(still_->the_case, {step.index, step.state, step.equations, 0, 0});
  for (const auto& shadow : shadows_) {
    auto rates = step.index > 0 ? shadow->force_rates : std::vector<Vector3d>{};  // where the history begins, it reports no force
    rates.resize(std::max<std::size_t>(1, still_->the_case.model.tools.size()), Vector3d::Zero());
    const Vector3d turn = (driven_direction(shadow->the_case) - direction) / shadow->change;
    row << "," << rates[0].dot(direction) + still.vector.dot(turn);
    for (const auto& rate : rates) row << "," << rate.x() << "," << rate.y() << "," << rate.z();
    if (depth_answers(still_->the_case)) row << "," << (step.index > 0 ? shadow->depth_rate : 0);
  }
  table_ += row.str() + "\n";
}

}  // namespace palpate
