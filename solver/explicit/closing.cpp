// The time loop: contact forces at the present place, one central-difference step, the jaw's own step.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/explicit/closing.hpp>

#include <algorithm>
#include <sstream>

#include <palpate/errors.hpp>

namespace palpate::explicit_shell {
namespace {

constexpr int cycles_between_judgements = 200;  ///< of the stable step
constexpr double runaway_speed = 1e5;          ///< mm/s: several times the speed of sound in a soft wall
constexpr double pressure_duration = 0.1;      ///< s, where the case does not say

std::string place(const Wall& wall, int t) {
  std::ostringstream out;
  const Lanes x = (wall.rest[wall.triangles[t][0]] + wall.rest[wall.triangles[t][1]] + wall.rest[wall.triangles[t][2]]) / 3.0;
  out << "triangle " << t << ", at (" << x[0] << ", " << x[1] << ", " << x[2] << ") mm at rest";
  return out.str();
}

std::vector<double> node_areas(const Wall& wall) {
  std::vector<double> area(wall.rest.size(), 0);
  for (int t = 0; t < wall.triangles.size(); ++t)
    for (int i : wall.triangles[t]) area[i] += wall.packs[t / 4].rest.area[t % 4] / 3;
  return area;
}

}  // namespace

Closing::Closing(Case& the_case, int threads)
    : c(the_case), motion(the_case.wall, the_case.holds, threads), jaws(the_case.clamp, the_case.wall), self(the_case.wall), node_area_(node_areas(the_case.wall)) {
  motion.damping = c.damping;
  end = c.duration > 0 ? c.duration : c.clamp.pressure ? pressure_duration : 1.1 * jaws.closing_time();
}

void Closing::contact() {
  auto& force = motion.outside.contact;
  std::fill(force.begin(), force.end(), Lanes{});
  jaws.touch(c.wall, motion.state, stiffness_, force);
  self.touch(motion.state, stiffness_ / 2, c.self_friction, force);
}

/// The step that is stable now, of which `safety` is used; penalties take what that leaves of 4/dt².
void Closing::judge() {
  for (int t = 0; t < c.wall.triangles.size(); ++t)
    if (const double speed = length3(motion.state.v[c.wall.triangles[t][0]]); !(speed < runaway_speed)) {
      std::ostringstream what;
      what << "the wall flies apart after " << cycles << " cycles, at gap " << jaws.gap() << " mm: a node moves at " << speed << " mm/s";
      throw Failure(ExitCode::not_converged, what.str(), place(c.wall, t), "a smaller [steps] safety or speed_mm_s, a larger gap_mm, or a finer mesh there");
    }
  const auto [stable, triangle] = motion.stable();
  const double first = smallest_step_;
  if (first == 0) smallest_step_ = stable;
  if (!(stable > 1e-3 * smallest_step_)) {
    std::ostringstream what;
    what << "the time step collapsed to " << stable << " s after " << cycles << " cycles, at gap " << jaws.gap() << " mm: a triangle is crushed or torn";
    throw Failure(ExitCode::not_converged, what.str(), place(c.wall, triangle), "a larger gap_mm, smaller speed_mm_s, or a finer mesh there");
  }
  step_ = c.safety * stable;
  stiffness_ = 0.8 * (1 - c.safety * c.safety) * 4 / (step_ * step_) / 2;
}

double Closing::advance(double dt) {
  contact();
  const double work = jaws.move(motion.time(), dt);
  motion.step(dt);
  motion.add_tool_work(work);
  ++cycles;
  return dt;
}

void Closing::run(const std::function<void(const Row&)>& row_done, const std::function<void(const Row&)>& frame_done) {
  Row row;
  row.gap = jaws.gap();
  judge();
  contact();
  row_done(row);
  frame_done(row);
  int rows = 0, frames = 0;
  double since = 0;
  while (rows < c.rows) {
    if (cycles % cycles_between_judgements == 0) judge();
    const double dt = advance(step_);
    row.force += dt * jaws.force_on_wall();
    since += dt;
    if (motion.time() < end * (rows + 1) / c.rows) continue;
    ++rows;
    const Eigen::Vector3d mean = row.force / since;
    contact();
    row = {motion.time(), jaws.travel(), jaws.gap(), mean, mean.dot(c.clamp.axis), 0, self.area(), cycles, step_, motion.ledger()};
    for (int i : jaws.touched()) row.jaw_area += node_area_[i];
    if (!std::isfinite(row.ledger.kinetic + row.ledger.internal)) {
      const auto bad = motion.stable().second;
      throw Failure(ExitCode::not_converged, "the wall is no longer finite after " + std::to_string(cycles) + " cycles", place(c.wall, std::max(bad, 0)), "a smaller [steps] safety or speed_mm_s");
    }
    peak_internal = std::max(peak_internal, row.ledger.internal);
    worst_imbalance = std::max(worst_imbalance, std::abs(row.ledger.imbalance()));
    if (row.travel > 0.1 * (jaws.start_gap() - c.clamp.gap)) worst_kinetic = std::max(worst_kinetic, row.ledger.kinetic / row.ledger.internal);
    row_done(row);
    if (motion.time() >= end * (frames + 1) / c.frames) {
      ++frames;
      frame_done(row);
    }
    row.force.setZero();
    since = 0;
  }
}

std::vector<double> Closing::contact_pressure() const {
  std::vector<double> pressure;
  for (std::size_t i = 0; i < node_area_.size(); ++i) pressure.push_back(length3(motion.outside.contact[i]) / node_area_[i]);
  return pressure;
}

}  // namespace palpate::explicit_shell
