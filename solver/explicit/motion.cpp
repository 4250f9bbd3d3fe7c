// One step: nodes, directors, triangles, each shared among a team of threads that waits at a barrier.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/explicit/motion.hpp>

#include <algorithm>
#include <barrier>
#include <exception>
#include <thread>

namespace palpate::explicit_shell {

/// Threads that all call the same piece of work with their number, between two barriers.
struct Motion::Team {
  explicit Team(int size) : begin(size), end(size) {
    for (int t = 1; t < size; ++t)
      threads.emplace_back([this, t] {
        for (;;) {
          begin.arrive_and_wait();
          if (done) return;
          work(t);
          end.arrive_and_wait();
        }
      });
  }
  ~Team() {
    done = true;
    begin.arrive_and_wait();
    for (auto& thread : threads) thread.join();
  }
  void run(const std::function<void(int)>& f) {
    work = f;
    begin.arrive_and_wait();
    f(0);
    end.arrive_and_wait();
  }
  std::barrier<> begin, end;
  std::function<void(int)> work;
  bool done = false;
  std::vector<std::thread> threads;
};

Holds no_holds(const Wall& wall) {
  return {std::vector<Hold>(wall.rest.size(), Hold::free), std::vector<Lanes>(wall.rest.size(), Lanes{}), std::vector<char>(wall.edges.size(), 0)};
}

namespace {

Lanes held(const Lanes& v, Hold hold, const Lanes& direction) {
  switch (hold) {
    case Hold::free: return v;
    case Hold::along: return dot3(v, direction) * direction;
    case Hold::across: return v - dot3(v, direction) * direction;
    case Hold::fixed: return Lanes{};
  }
  return v;
}

}  // namespace

Motion::Motion(const Wall& wall, Holds holds, int threads, TissueForces* tissue)
    : state(rest_state(wall)), wall_(wall), holds_(std::move(holds)), tissue_(tissue), slots_(make_slots(wall)) {
  outside = {std::vector<Lanes>(wall.rest.size(), Lanes{}), std::vector<Lanes>(wall.rest.size(), Lanes{}), std::vector<double>(wall.edges.size(), 0)};
  work_.assign(3 * wall.rest.size(), 0);
  edge_work_.assign(2 * wall.edges.size(), 0);
  for (const auto& [a, b] : wall.edges) {
    const Lanes t = state.x[b] - state.x[a];
    tangent_.push_back(t / length3(t));
  }
  if (threads > 1) team_ = std::make_unique<Team>(threads);
  find_forces(0, static_cast<int>(wall_.packs.size()), 0);
}

Motion::~Motion() = default;

void Motion::phase(int count, int grain, const std::function<void(int, int)>& work) const {
  if (!team_ || count < 4 * grain) return work(0, count);
  const int threads = static_cast<int>(team_->threads.size()) + 1;
  team_->run([&](int t) {
    work(static_cast<int>(static_cast<long long>(count) * t / threads), static_cast<int>(static_cast<long long>(count) * (t + 1) / threads));
  });
}

void Motion::together(const std::function<void()>& one, const std::function<void()>& other) const {
  std::array<std::exception_ptr, 2> thrown;
  const auto guarded = [&](int which) {
    try {
      which == 0 ? one() : other();
    } catch (...) {
      thrown[which] = std::current_exception();
    }
  };
  if (team_) team_->run([&](int t) { if (t < 2) guarded(t); });
  else guarded(0), guarded(1);
  for (const auto& exception : thrown)
    if (exception) std::rethrow_exception(exception);
}

void Motion::find_forces(int from, int to, double dt) {
  wall_forces(wall_, state, from, to, slots_);
  if (tissue_) tissue_->add(state, time_, dt, from, to, slots_);
}

Lanes Motion::inner_force(int i) const {
  Lanes inner{};
  for (int s = wall_.node_slots.start[i]; s < wall_.node_slots.start[i + 1]; ++s) inner += slots_.force[wall_.node_slots.entries[s]];
  return inner;
}

double Motion::inner_moment(int e) const {
  double inner = 0;
  for (int s = wall_.edge_slots.start[e]; s < wall_.edge_slots.start[e + 1]; ++s) inner += slots_.moment[wall_.edge_slots.entries[s]];
  return inner;
}

void Motion::move_nodes(int from, int to, double dt, double dt_mid) {
  const double slow = 1 - damping * dt_mid / 2, over = 1 / (1 + damping * dt_mid / 2);
  for (int i = from; i < to; ++i) {
    const Lanes force = outside.load[i] + outside.contact[i] - inner_force(i), before = state.v[i];
    const Lanes v = held((slow * before + (dt_mid / wall_.mass[i]) * force) * over, holds_.hold[i], holds_.direction[i]);
    const Lanes mean = 0.5 * (before + v);
    work_[3 * i] += dt_mid * dot3(outside.load[i], mean);
    work_[3 * i + 1] += dt_mid * dot3(outside.contact[i], mean);
    work_[3 * i + 2] += dt_mid * damping * wall_.mass[i] * dot3(mean, mean);
    state.v[i] = v;
    state.x[i] += dt * v;
  }
}

void Motion::turn_edges(int from, int to, double dt, double dt_mid) {
  const double slow = 1 - damping * dt_mid / 2, over = 1 / (1 + damping * dt_mid / 2);
  for (int e = from; e < to; ++e) {
    const double before = state.spin[e];
    double spin = (slow * before + (dt_mid / wall_.inertia[e]) * (outside.moment[e] - inner_moment(e))) * over;
    if (holds_.edge_fixed[e]) spin = 0;
    edge_work_[2 * e] += dt_mid * outside.moment[e] * (before + spin) / 2;
    edge_work_[2 * e + 1] += dt_mid * damping * wall_.inertia[e] * (before + spin) * (before + spin) / 4;
    state.spin[e] = spin;
  }
  turn_directors(wall_, state, tangent_, dt, from, to);
}

void Motion::step(double dt) {
  const double dt_mid = dt_before_ > 0 ? (dt_before_ + dt) / 2 : dt / 2;  // from rest, velocities begin half a step later
  phase(static_cast<int>(wall_.rest.size()), 256, [&](int from, int to) { move_nodes(from, to, dt, dt_mid); });
  phase(static_cast<int>(wall_.edges.size()), 256, [&](int from, int to) { turn_edges(from, to, dt, dt_mid); });
  time_ += dt;
  phase(static_cast<int>(wall_.packs.size()), 32, [&](int from, int to) { find_forces(from, to, dt); });
  dt_before_ = dt;
}

/// Works are found between steps half a step on; what that adds is kept, for from rest there is no half step to carry.
void Motion::halt() {
  const Ledger moving = ledger();
  std::fill(state.v.begin(), state.v.end(), Lanes{});
  std::fill(state.spin.begin(), state.spin.end(), 0.0);
  dt_before_ = 0;
  const Ledger still = ledger();
  halted_.external += moving.external - still.external;
  halted_.contact += moving.contact - still.contact;
  halted_.damping += moving.damping - still.damping + moving.kinetic;
}

Ledger Motion::ledger() const {
  Ledger l = halted_;
  const double half = dt_before_ / 2;
  for (std::size_t i = 0; i < wall_.rest.size(); ++i) {
    const Lanes force = outside.load[i] + outside.contact[i] - inner_force(i);
    const Lanes v = held((1 - damping * half / 2) / (1 + damping * half / 2) * state.v[i] + half / (1 + damping * half / 2) / wall_.mass[i] * force,
                         holds_.hold[i], holds_.direction[i]);
    const Lanes mean = 0.5 * (state.v[i] + v);
    l.external += work_[3 * i] + half * dot3(outside.load[i], mean);
    l.contact -= work_[3 * i + 1] + half * dot3(outside.contact[i], mean);
    l.damping += work_[3 * i + 2] + half * damping * wall_.mass[i] * dot3(mean, mean);
    l.kinetic += 0.5 * wall_.mass[i] * dot3(v, v);
  }
  for (std::size_t e = 0; e < wall_.edges.size(); ++e) {
    double spin = (1 - damping * half / 2) / (1 + damping * half / 2) * state.spin[e] +
                  half / (1 + damping * half / 2) / wall_.inertia[e] * (outside.moment[e] - inner_moment(e));
    if (holds_.edge_fixed[e]) spin = 0;
    const double mean = (state.spin[e] + spin) / 2;
    l.external += edge_work_[2 * e] + half * outside.moment[e] * mean;
    l.damping += edge_work_[2 * e + 1] + half * damping * wall_.inertia[e] * mean * mean;
    l.kinetic += 0.5 * wall_.inertia[e] * spin * spin;
  }
  l.internal = internal();
  l.contact += tool_work_;
  l.external += tool_work_;
  return l;
}

double Motion::kinetic() const {
  double sum = 0;
  for (std::size_t i = 0; i < state.v.size(); ++i) sum += 0.5 * wall_.mass[i] * dot3(state.v[i], state.v[i]);
  for (std::size_t e = 0; e < state.spin.size(); ++e) sum += 0.5 * wall_.inertia[e] * state.spin[e] * state.spin[e];
  return sum;
}

double Motion::internal() const {
  double sum = 0;
  for (std::size_t t = 0; t < wall_.triangles.size(); ++t) sum += slots_.energy[t];
  return sum;
}

std::pair<double, int> Motion::stable() const {
  std::pair<double, int> smallest{std::numeric_limits<double>::infinity(), -1};
  std::vector<double> steps(wall_.triangles.size());
  phase(static_cast<int>(steps.size()), 64, [&](int from, int to) {
    for (int t = from; t < to; ++t) steps[t] = stable_step(wall_, state, t);
  });
  for (int t = 0; t < steps.size(); ++t)
    if (!(steps[t] >= smallest.first)) smallest = {steps[t], t};
  return smallest;
}

void Motion::keep(Archive& a) {
  a(state.x, state.v, state.director, state.spin, outside.load, outside.contact, outside.moment, damping);
  a(slots_.force, slots_.moment, slots_.energy, tangent_, work_, edge_work_, time_, dt_before_, tool_work_, halted_);
}

std::vector<Lanes> Motion::residual() const {
  auto r = gathered(wall_, slots_).force;
  for (std::size_t i = 0; i < r.size(); ++i) r[i] = held(r[i] + outside.load[i] + outside.contact[i], holds_.hold[i], holds_.direction[i]);
  return r;
}

}  // namespace palpate::explicit_shell
