// The time loop: contact forces at the present place, one central-difference step, the jaw's own step.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/explicit/closing.hpp>

#include <algorithm>
#include <sstream>

#include <palpate/errors.hpp>

namespace palpate::explicit_shell {
namespace {

constexpr int most_cycles_between_judgements = 200;  ///< of the stable step
constexpr double moved_between_judgements = 0.1;       ///< of the shortest edge, by the fastest node
constexpr double moved_in_a_step = 0.02;             ///< same; what is faster is cut into finer steps, for the energy's balance
constexpr double contact_damping = 0.1;              ///< of critical, of a node on its penalty: a few steps are too few for an elastic bounce
constexpr double most_drift = 0.1;             ///< of the largest internal energy: the run is not worth going on with
constexpr double runaway_speed = 1e5;          ///< mm/s: several times the speed of sound in a soft wall
constexpr double most_cycles = 2e7;             ///< hours, even of a small mesh
constexpr int cycles_between_paces = 20;
constexpr double paced_from = 0.03;            ///< of the closing: before, hardly anything is stored
constexpr double least_pace = 0.02;
constexpr double slowing = 0.5e-3, quickening = 5e-3;  ///< s
constexpr double waiting_damping = 800;        ///< 1/s, where the jaws stand still
constexpr double settling_damping = 400;       ///< 1/s, before the jaws begin
constexpr long longest_rest = 200000;           ///< cycles
constexpr double past_the_peak = 0.8;          ///< of the kinetic energy's peak: less is no ripple of what quivers beside the slow motion that is to go on
constexpr double pressure_duration = 0.1;      ///< s, where the case does not say

std::string place(const Wall& wall, int t) {
  std::ostringstream out;
  const Lanes x = (wall.rest[wall.triangles[t][0]] + wall.rest[wall.triangles[t][1]] + wall.rest[wall.triangles[t][2]]) / 3.0;
  out << "triangle " << t << ", at (" << x[0] << ", " << x[1] << ", " << x[2] << ") mm at rest";
  return out.str();
}

}  // namespace

Closing::Closing(Case& the_case, int threads)
    : c(the_case), tissue(the_case.tissue.plain() ? std::nullopt : std::optional<TissueForces>(std::in_place, the_case.tissue, the_case.wall)),
      motion(the_case.wall, the_case.holds, threads, tissue ? &*tissue : nullptr), jaws(the_case.clamp, the_case.wall, threads), self(the_case.wall, threads), node_area_(node_areas(the_case.wall)),
      jaw_force_(the_case.wall.rest.size()), self_force_(the_case.wall.rest.size()) {
  shortest_edge_ = std::numeric_limits<double>::infinity();
  for (const auto& [a, b] : c.wall.edges) shortest_edge_ = std::min(shortest_edge_, length3(c.wall.rest[b] - c.wall.rest[a]));
  motion.damping = c.settle > 0 ? settling_damping : c.damping;
  clock_ = -c.settle;
  beds_stiffness_ = stiffness_per_mass(c.beds, c.wall);
  end = c.duration > 0 ? c.duration : c.clamp.pressure ? pressure_duration : c.clamp.opens ? jaws.motion_time() : 1.1 * jaws.closing_time() + c.clamp.hold;
}

void Closing::contact() {
  auto& force = motion.outside.contact;
  if (!swept_) std::fill(force.begin(), force.end(), Lanes{});
  swept_ = true;
  for (FewForces* of : {&jaw_force_, &self_force_}) {
    for (int i : of->nodes()) force[i] = Lanes{};
    of->clear();
  }
  if (!jaws.has_looked()) jaws.look(c.wall, motion.state);
  if (self.is_out_of_date(motion.state, strayed_)) self.search(motion);
  strayed_ = -1;
  motion.shared([&](const Motion::Share& share) {
    jaws.touch_nodes(share, c.wall, motion.state, stiffness_, contact_damping);
    self.touch_nodes(share, motion.state, {stiffness_ / 2, contact_damping, c.self_friction});
    motion.meet();
    jaws.touch_triangles(share, c.wall, stiffness_);
  });
  jaws.gather(c.wall, jaw_force_);
  self.gather(self_force_);
  motion.add_tool_work(jaws.take_work());
  for (const FewForces* of : {&jaw_force_, &self_force_})
    for (int i : of->nodes()) force[i] += (*of)[i];
  if (c.beds.empty()) return;
  std::fill(motion.outside.load.begin(), motion.outside.load.end(), Lanes{});
  press(c.beds, c.wall, motion.state, motion.outside.load);
}

/// The step that is stable now, of which `safety` is used, and when to ask again. Penalties take what the first step leaves of 4/dt² and
/// keep that: one that changed while a node is pushed would make or lose energy. So no later step is longer than the first.
void Closing::judge() {
  double fastest = 0;
  for (int t = 0; t < c.wall.triangles.size(); ++t) {
    const double speed = length3(motion.state.v[c.wall.triangles[t][0]]);
    if (!(speed < runaway_speed)) {
      std::ostringstream what;
      what << "the wall flies apart after " << cycles << " cycles, at gap " << jaws.gap() << " mm: a node moves at " << speed << " mm/s";
      throw Failure(ExitCode::not_converged, what.str(), place(c.wall, t), "a smaller [steps] safety or speed_mm_s, a larger gap_mm, or a finer mesh there");
    }
    fastest = std::max(fastest, speed);
  }
  const auto [of_the_wall, triangle] = motion.stable();
  const double stable = 2 / std::sqrt(4 / (of_the_wall * of_the_wall) + beds_stiffness_);
  if (first_stable_ == 0) {
    first_stable_ = stable;
    const double first = c.safety * stable;
    stiffness_ = 0.8 * (1 - c.safety * c.safety) * 4 / (first * first) / 2;
  }
  if (!(stable > 1e-3 * first_stable_)) {
    std::ostringstream what;
    what << "the time step collapsed to " << stable << " s after " << cycles << " cycles, at gap " << jaws.gap() << " mm: a triangle is crushed or torn";
    throw Failure(ExitCode::not_converged, what.str(), place(c.wall, triangle), "a larger gap_mm, smaller speed_mm_s, or a finer mesh there");
  }
  if (cycles == 0 && end > most_cycles * c.safety * stable) {
    std::ostringstream what;
    what << "the closing of " << end << " s would take " << end / (c.safety * stable) << " steps: the smallest triangle, or the stiffest, allows " << c.safety * stable << " s";
    throw Failure(ExitCode::misuse, what.str(), place(c.wall, triangle), "a coarser mesh there, a larger [clamp] speed_mm_s, a shorter [steps] duration_s, or mass scaling by least_step_s");
  }
  step_ = std::min(c.safety * std::min(stable, first_stable_), moved_in_a_step * shortest_edge_ / std::max(fastest, 1e-300));
  const double steps = moved_between_judgements * shortest_edge_ / std::max(fastest * step_, 1e-300);
  jaws.look(c.wall, motion.state);
  judged_again_ = cycles + static_cast<long>(std::clamp(steps, 1.0, static_cast<double>(most_cycles_between_judgements)));
}

/// The jaws wait while the wall moves too much: their pace goes with what the kinetic part may be over what it is, and the
/// wall is damped the more the less they move. What is let go at once, a fold that snaps, comes to rest so before they go on.
void Closing::keep_pace() {
  const double internal = std::abs(motion.internal()), part = internal > 0 ? motion.kinetic() / internal : 0, closed = jaws.closed();
  if (closed > 0.1) worst_kinetic = std::max(worst_kinetic, part);
  if (!(c.kinetic_part > 0) || closed < paced_from) return;
  const double wanted = std::clamp(0.4 * c.kinetic_part / std::max(part, 1e-12), least_pace, 1.0);
  pace_ += (1 - std::exp(-cycles_between_paces * step_ / (wanted < pace_ ? slowing : quickening))) * (wanted - pace_);
  motion.damping = c.damping + (1 - pace_) * (1 - pace_) * waiting_damping;
}

void Closing::advance(double dt) {
  contact();
  jaws.remember();
  remember(c.beds, c.wall, motion.state);
  if (clock_ < 0) {
    if (tissue) tissue->tension_rise = 1 + clock_ / c.settle;
    if (clock_ + dt >= 0) motion.damping = c.damping;
  } else {
    if (tissue) tissue->tension_rise = 1;
    jaws.move(clock_, pace_ * dt, dt);
  }
  strayed_ = motion.step(dt, &self.searched_at());
  clock_ += pace_ * dt;
  if (++cycles % cycles_between_paces == 0) keep_pace();
}

/// Dynamic relaxation: with the jaws where they are everything is stopped whenever its kinetic energy has passed a peak, near where what is stored has a
/// trough (Cundall 1976; Barnes 1999, Int. J. Space Struct. 14:89), and damped as where jaws wait: contact that goes from triangle to triangle keeps what is not damped in motion.
void Closing::relax() {
  motion.damping = waiting_damping;
  double peak = 0, part = 0;
  for (const long until = cycles + longest_rest; cycles < until;) {
    if (cycles >= judged_again_) judge();
    for (int i = 0; i < cycles_between_paces; ++i) advance(step_);
    const double kinetic = motion.kinetic();
    part = kinetic / std::max(std::abs(motion.internal()), 1e-300);
    if (part <= c.rest_part && peak == 0) return;  // it does not leave its rest
    if (part <= c.rest_part || kinetic < past_the_peak * peak) {
      motion.halt();
      peak = 0;
    } else {
      peak = std::max(peak, kinetic);
    }
  }
  std::ostringstream what;
  what << "the wall does not come to rest: after " << longest_rest << " cycles at gap " << jaws.gap() << " mm its kinetic energy still is " << part << " of the internal, where rest_part allows " << c.rest_part;
  throw Failure(ExitCode::not_converged, what.str(), "", "a larger [steps] rest_part, or kinetic_part so that the jaws wait before");
}

/// What no later step mends: a mid-surface in a jaw or in another, energy from nowhere.
void Closing::expect_sound(const Row& row) const {
  const auto stop = [&](const std::string& what, int t, const std::string& next) {
    std::ostringstream text;
    text << what << ", after " << cycles << " cycles at gap " << row.gap << " mm";
    throw Failure(ExitCode::not_converged, text.str(), place(c.wall, t), next);
  };
  const auto around = [&](int node) { return c.wall.node_slots.entries[c.wall.node_slots.start[node]] / 3; };
  if (!std::isfinite(row.ledger.kinetic + row.ledger.internal)) stop("the wall is no longer finite", std::max(motion.stable().second, 0), "a smaller [steps] safety or speed_mm_s");
  if (jaws.through() >= 0) stop("penetration: the wall's middle lies inside a jaw", around(jaws.through()), "a larger gap_mm (twice the wall is the least), a smaller speed_mm_s or pressure_MPa");
  if (self.through() >= 0) stop("penetration: the wall passes through itself", around(self.through()), "a larger gap_mm (twice the wall is the least), a smaller speed_mm_s or pressure_MPa, or a finer mesh there");
  if (!(std::abs(row.ledger.imbalance()) > most_drift * peak_internal) || !(jaws.closed() > 0.1)) return;
  const auto& energy = motion.slots().energy;
  const auto most = std::max_element(energy.begin(), energy.begin() + static_cast<long>(c.wall.triangles.size())) - energy.begin();
  std::ostringstream what;
  what << "energy drifts: " << 100 * row.ledger.imbalance() / peak_internal << " % of the internal energy came from nowhere; the most of it is in this triangle";
  stop(what.str(), static_cast<int>(most), "a smaller [steps] safety or speed_mm_s, or a finer mesh there");
}

Row Closing::row_of(const Eigen::Vector3d& force) const {
  Row row{motion.time(), jaws.travel(), jaws.gap(), force, force.dot(c.clamp.axis), 0, self.area(), cycles, step_, motion.ledger()};
  for (int i : jaws.touched()) row.jaw_area += node_area_[i];
  return row;
}

void Closing::keep(Archive& a) {
  a(motion, jaws, self, end, cycles, worst_imbalance, peak_internal, worst_kinetic, step_, stiffness_, first_stable_, clock_, pace_, judged_again_, rows_, frames_);
  if (tissue) a(*tissue);
  for (Bed& bed : c.beds) a(bed.memory);
  swept_ = false;
  strayed_ = -1;
}

void Closing::run(const std::function<void(const Row&)>& row_done, const std::function<void(const Row&)>& frame_done, const std::function<void()>& save) {
  Row row;
  if (cycles == 0) {
    row.gap = jaws.gap();
    judge();
    contact();
    row_done(row);
    frame_done(row);
  }
  double since = 0;
  while (rows_ < c.rows) {
    if (cycles >= judged_again_) judge();
    const double dt = step_;
    advance(dt);
    row.force += dt * jaws.force_on_wall();
    since += dt;
    if (clock_ < end * (rows_ + 1) / c.rows) continue;
    ++rows_;
    if (rows_ == c.rows && c.rest_part > 0) {
      relax();
      row.force = jaws.force_on_wall(), since = 1;
    }
    const Eigen::Vector3d mean = row.force / since;
    contact();
    row = row_of(mean);
    // a layer that shrinks under its tension gives what the law stores: then the sum says nothing of how much energy there is
    peak_internal = std::max({peak_internal, std::abs(row.ledger.internal), row.ledger.internal - (tissue ? tissue->work() : 0)});
    expect_sound(row);
    worst_imbalance = std::max(worst_imbalance, std::abs(row.ledger.imbalance()));
    row_done(row);
    if (clock_ >= end * (frames_ + 1) / c.frames) {
      ++frames_;
      frame_done(row);
    }
    if (save) save();
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
