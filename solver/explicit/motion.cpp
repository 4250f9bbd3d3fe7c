// One step: nodes, directors, triangles, each shared among a team of threads that wait for each other.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/explicit/motion.hpp>

#include <algorithm>
#include <array>
#include <numeric>

#include <solver/explicit/team.hpp>

namespace palpate::explicit_shell {

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

void Motion::shared(const std::function<void(const Share&)>& work) const {
  const int nodes = static_cast<int>(wall_.rest.size()), triangles = static_cast<int>(wall_.triangles.size());
  if (!team_) return work({0, 0, nodes, 0, triangles});
  team_->run([&](int t) {
    const auto [node, last_node] = team_->share(nodes, t);
    const auto [triangle, last_triangle] = team_->share(triangles, t);
    work({t, node, last_node, triangle, last_triangle});
  });
}

void Motion::meet() const {
  if (team_) team_->meeting.wait();
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

double farthest(const std::vector<Lanes>& x, const std::vector<Lanes>& from, int first, int last) {
  double most = 0;
  for (int i = first; i < last; ++i) {
    const Lanes d = x[i] - from[i];
    most = std::max(most, dot3(d, d));
  }
  return most;
}

double Motion::step(double dt, const std::vector<Lanes>* from) {
  const double dt_mid = dt_before_ > 0 ? (dt_before_ + dt) / 2 : dt / 2;  // from rest, velocities begin half a step later
  const int nodes = static_cast<int>(wall_.rest.size()), edges = static_cast<int>(wall_.edges.size()), packs = static_cast<int>(wall_.packs.size());
  time_ += dt;
  double strayed = -1;
  if (!team_) {
    move_nodes(0, nodes, dt, dt_mid);
    if (from) strayed = farthest(state.x, *from, 0, nodes);
    turn_edges(0, edges, dt, dt_mid);
    find_forces(0, packs, dt);
  } else {
    std::vector<double> strays(team_->size, -1);
    team_->run([&](int t) {
      const auto [node, last_node] = team_->share(nodes, t);
      move_nodes(node, last_node, dt, dt_mid);
      if (from) strays[t] = farthest(state.x, *from, node, last_node);
      team_->meeting.wait();
      const auto [edge, last_edge] = team_->share(edges, t);
      turn_edges(edge, last_edge, dt, dt_mid);
      team_->meeting.wait();
      const auto [pack, last_pack] = team_->share(packs, t);
      find_forces(pack, last_pack, dt);
    });
    strayed = *std::max_element(strays.begin(), strays.end());
  }
  dt_before_ = dt;
  return strayed;
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

/// In parts whose number is always the same, each by the thread that has most of it in its cache: the same sum on any number of threads.
double Motion::sum_of(const std::function<double(double part, double next)>& sum) const {
  constexpr int parts = 32;
  std::array<double, parts> sums;
  const int threads = team_ ? team_->size : 1;
  const auto of_thread = [&](int t) {
    for (int p = parts * t / threads; p < parts * (t + 1) / threads; ++p) sums[p] = sum(static_cast<double>(p) / parts, static_cast<double>(p + 1) / parts);
  };
  if (team_) team_->run(of_thread);
  else of_thread(0);
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

double Motion::kinetic() const {
  return sum_of([&](double part, double next) {
    double sum = 0;
    const double nodes = static_cast<double>(state.v.size()), edges = static_cast<double>(state.spin.size());
    for (auto i = static_cast<std::size_t>(part * nodes); i < static_cast<std::size_t>(next * nodes); ++i) sum += 0.5 * wall_.mass[i] * dot3(state.v[i], state.v[i]);
    for (auto e = static_cast<std::size_t>(part * edges); e < static_cast<std::size_t>(next * edges); ++e) sum += 0.5 * wall_.inertia[e] * state.spin[e] * state.spin[e];
    return sum;
  });
}

double Motion::internal() const {
  return sum_of([&](double part, double next) {
    const double triangles = static_cast<double>(wall_.triangles.size());
    return std::accumulate(slots_.energy.begin() + static_cast<long>(part * triangles), slots_.energy.begin() + static_cast<long>(next * triangles), 0.0);
  });
}

std::pair<double, int> Motion::stable() const {
  std::pair<double, int> smallest{std::numeric_limits<double>::infinity(), -1};
  std::vector<double> steps(wall_.triangles.size());
  shared([&](const Share& share) {
    for (int t = share.triangle; t < share.last_triangle; ++t) steps[t] = stable_step(wall_, state, t);
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
