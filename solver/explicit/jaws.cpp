// Penalty forces normal to a rounded block, regularised Coulomb friction, and the jaw's own motion.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/explicit/jaws.hpp>

#include <algorithm>
#include <sstream>

#include <palpate/errors.hpp>
#include <solver/explicit/block_triangle.hpp>

namespace palpate::explicit_shell {
namespace {

using Eigen::Vector3d;

constexpr double clear_chord = 0.1;    ///< of the thickness, that triangles between their nodes keep from a jaw

Vector3d vector(const Lanes& a) { return {a[0], a[1], a[2]}; }

/// From 0 to 1, slow at the start, where little energy is stored: velocity zero at both ends, acceleration at the first.
double smooth(double s) {
  s = std::clamp(s, 0.0, 1.0);
  return s * s * s * (4 - 3 * s);
}

}  // namespace

double Clamp::friction() const {
  double sum = 0;
  for (const auto& [effect, parameters] : tractions)
    if (effect.traction.holds_on) sum += parameters[0];
  return sum;
}

Jaws::Jaws(const Clamp& clamp, const Wall& wall, int threads) : clamp_(clamp), pushes_(threads) {
  for (const auto& shape : tools::all())
    if (shape.entry.name == "box") block_ = shape;
  parameters_ = {clamp.width, clamp.length, clamp.height, clamp.edge_radius};
  const Vector3d up = -clamp.axis, along = (clamp.along - clamp.along.dot(up) * up).normalized();
  double top = -1e30, bottom = 1e30, thickest = 0;
  for (std::size_t i = 0; i < wall.rest.size(); ++i) {
    const Vector3d x = vector(wall.rest[i]) - clamp.centre;
    if (std::abs(x.dot(along)) > clamp.length / 2 || std::abs(x.dot(along.cross(up))) > clamp.width / 2) continue;
    top = std::max(top, x.dot(up) + wall.thickness[i] / 2);
    bottom = std::min(bottom, x.dot(up) - wall.thickness[i] / 2);
    thickest = std::max(thickest, wall.thickness[i]);
  }
  if (!(top > bottom)) throw Failure(ExitCode::misuse, "the jaws miss the wall: nothing of it lies between them", "", "[clamp] centre_mm on the tube's centre line");
  if (top - bottom - thickest < 2 * thickest) {
    std::ostringstream text;
    text << "the wall between the jaws is thicker than the tube's radius: " << thickest << " mm, and its mid-surface is " << top - bottom - thickest << " mm high";
    throw Failure(ExitCode::misuse, text.str(), "", "a mesh of a thinner wall (palpate-mesh --thickness, --offset)");
  }
  is_near_.assign(wall.rest.size(), 0);
  for (auto& local : local_) local.assign(wall.rest.size(), Lanes{});
  node_area_ = node_areas(wall);
  node_normal_.assign(wall.rest.size(), Lanes{});
  for (const auto& [a, b, c] : wall.triangles)
    for (int i : {a, b, c}) node_normal_[i] += cross3(wall.rest[b] - wall.rest[a], wall.rest[c] - wall.rest[a]);
  for (Lanes& n : node_normal_) n /= length3(n);
  for (int j : {0, 1}) slips_[j].assign(wall.rest.size(), {}), slips_now_[j] = slips_[j];
  for (const auto& [effect, parameters] : clamp.tractions)
    if (effect.traction.reach) reach_ = std::max(reach_, effect.traction.reach(parameters));
  for (const auto& [a, b] : wall.edges) margin_ = std::max(margin_, 2 * length3(wall.rest[b] - wall.rest[a]));
  met_gap_ = top - bottom;
  start_gap_ = clamp.open.value_or(met_gap_);
  if (start_gap_ < met_gap_ * (1 - 1e-9)) {
    std::ostringstream text;
    text << "the jaws start inside the wall: " << start_gap_ << " mm apart, and the wall is " << met_gap_ << " mm from outside to outside";
    throw Failure(ExitCode::misuse, text.str(), "", "a larger open_mm, or leave it out: both jaws then touch the wall");
  }
  if (!(clamp.gap < start_gap_)) throw Failure(ExitCode::misuse, "the jaws are to stop farther apart than they start", "", "a smaller gap_mm");
  if (const double nearer = clamp.width * std::sin(std::abs(clamp.angle) / 2); nearer > clamp.gap) {
    std::ostringstream text;
    text << "the jaws would pass through each other: at " << std::abs(clamp.angle) * 180 / M_PI << " degrees they are " << nearer << " mm nearer at one end than in their middles, which stop " << clamp.gap << " mm apart";
    throw Failure(ExitCode::misuse, text.str(), "", "a larger [clamp] gap_mm, a smaller angle_deg or width_mm");
  }
  const double middle = (top + bottom) / 2;
  for (int j : {0, 1}) {
    const Vector3d back = j == 0 ? up : -up;
    jaws_[j].face = clamp.centre + middle * up + start_gap_ / 2 * back;
    jaws_[j].frame << along.cross(back).normalized(), along, back;
    jaws_[j].frame = Eigen::AngleAxisd((j == 0 ? 0.5 : -0.5) * clamp.angle, along) * jaws_[j].frame;
    forces_[j].setZero();
  }
}

double Jaws::closing_time() const { return (start_gap_ - clamp_.gap) / clamp_.speed; }
double Jaws::motion_time() const { return closing_time() * (clamp_.opens ? 2 : 1) + clamp_.hold; }

double Jaws::kinetic() const { return clamp_.pressure ? 0.5 * clamp_.mass * velocity_ * velocity_ : 0; }

tools::Distance Jaws::distance(const Jaw& jaw, const Vector3d& x) const {
  auto d = block_.distance(jaw.frame.transpose() * (x - jaw.face), parameters_);
  d.n = jaw.frame * d.n;
  return d;
}

Lanes Jaws::local(const Jaw& jaw, const Lanes& x) const {
  const Vector3d p = jaw.frame.transpose() * (vector(x) - jaw.face);
  return Lanes{p.x(), p.y(), p.z() - clamp_.height / 2, 0};
}

void Jaws::look(const Wall& wall, const WallState& state) {
  looked_at_ = travel_;
  for (int j : {0, 1}) {
    near_nodes_[j].clear(), near_triangles_[j].clear();
    for (std::size_t i = 0; i < state.x.size(); ++i) {
      const Lanes x = local(jaws_[j], state.x[i]);
      is_near_[i] = std::abs(x[0]) < clamp_.width / 2 + margin_ && std::abs(x[1]) < clamp_.length / 2 + margin_ && std::abs(x[2]) < clamp_.height / 2 + margin_;
      if (is_near_[i]) near_nodes_[j].push_back(static_cast<int>(i));
    }
    for (int t = 0; t < static_cast<int>(wall.triangles.size()); ++t) {
      const auto& [a, b, c] = wall.triangles[t];
      if (is_near_[a] && is_near_[b] && is_near_[c]) near_triangles_[j].push_back(t);
    }
  }
}

void Jaws::touch(const Wall& wall, const WallState& state, double stiffness, double damping, FewForces& force) {
  if (!has_looked()) look(wall, state);
  const Motion::Share all{0, 0, static_cast<int>(wall.rest.size()), 0, static_cast<int>(wall.triangles.size())};
  touch_nodes(all, wall, state, stiffness, damping);
  touch_triangles(all, wall, stiffness);
  gather(wall, force);
}

void Jaws::touch_nodes(const Motion::Share& share, const Wall& wall, const WallState& state, double stiffness, double damping) {
  for (int j : {0, 1}) {
    auto& pushes = pushes_[share.thread][j][0];
    pushes.clear();
    const Vector3d jaw_velocity = j == 0 ? Vector3d(velocity_ * clamp_.axis) : Vector3d(Vector3d::Zero());
    const auto& near = near_nodes_[j];
    for (auto at = std::lower_bound(near.begin(), near.end(), share.node); at != near.end() && *at < share.last_node; ++at) {
      const int i = *at;
      const Lanes x = local_[j][i] = local(jaws_[j], state.x[i]);
      const double within = wall.thickness[i] / 2 + reach_;
      if (std::abs(x[0]) - clamp_.width / 2 > within || std::abs(x[1]) - clamp_.length / 2 > within || std::abs(x[2]) - clamp_.height / 2 > within) continue;
      const auto d = distance(jaws_[j], vector(state.x[i]));
      const double depth = wall.thickness[i] / 2 - d.g;
      if (!(depth > -reach_)) continue;
      const Vector3d v = vector(state.v[i]) - jaw_velocity;
      const double normal = depth > 0 ? wall.mass[i] * std::max(stiffness * depth - 2 * damping * std::sqrt(stiffness) * v.dot(d.n), 0.0) : 0;
      Vector3d f = normal * d.n;
      if (!clamp_.tractions.empty()) f += tractions_on(j, i, d, normal, stiffness, wall, state);
      pushes.push_back({f, {i, -1, -1}, {1, 0, 0}, depth});
    }
  }
}

void Jaws::touch_triangles(const Motion::Share& share, const Wall& wall, double stiffness) {
  for (int j : {0, 1}) {
    auto& pushes = pushes_[share.thread][j][1];
    pushes.clear();
    const auto& near = near_triangles_[j];
    for (auto at = std::lower_bound(near.begin(), near.end(), share.triangle); at != near.end() && *at < share.last_triangle; ++at) touch_between(j, *at, wall, stiffness / 4, pushes);
  }
}

/// In the order of nodes and triangles, however many threads found them.
void Jaws::gather(const Wall& wall, FewForces& force) {
  touched_.clear();
  through_ = -1;
  for (int j : {0, 1}) {
    forces_[j].setZero();
    for (int kind : {0, 1})
      for (const auto& of_thread : pushes_)
        for (const Push& push : of_thread[j][kind]) {
          for (int k = 0; k < 3 && push.nodes[k] >= 0; ++k) force.add(push.nodes[k], push.weights[k] * Lanes{push.force[0], push.force[1], push.force[2], 0});
          forces_[j] += push.force;
          if (kind == 1 || !(push.depth > 0)) continue;
          const int i = push.nodes[0];
          deepest_ = std::max(deepest_, push.depth);
          if (push.depth > wall.thickness[i] / 2) through_ = i;
          if (j == 0) touched_.push_back(i);
        }
  }
}

/// Of effects on the traction, by the node's area. What holds on begins where the node first touched: the slip of one that does not is forgotten.
Vector3d Jaws::tractions_on(int j, int i, const tools::Distance& d, double normal, double stiffness, const Wall& wall, const WallState& state) {
  Vector3d sum = Vector3d::Zero();
  contact::Touch touch{vector(state.x[i]) - jaws_[j].face, d, normal / node_area_[i], stiffness * wall.mass[i] / node_area_[i], stiffness * wall.mass[i] / node_area_[i], slips_[j][i]};
  touch.distance.g -= wall.thickness[i] / 2;
  const double facing = std::abs(vector(node_normal_[i]).dot(d.n));
  slips_now_[j][i] = {touch.place, Vector3d::Zero()};
  for (const auto& [effect, parameters] : clamp_.tractions) {
    if (!(normal > 0) && !effect.traction.reach) continue;
    if (effect.traction.holds_on && touch.before.place.isZero()) touch.before.place = touch.place;
    const Vector3d t = effect.traction.respond(touch, parameters).value;
    if (effect.traction.holds_on) slips_now_[j][i].shear = t;
    sum += (effect.traction.reach ? facing : 1) * node_area_[i] * t;
  }
  if (!(normal > 0)) slips_now_[j][i] = {};
  return sum;
}

void Jaws::remember() {
  if (clamp_.tractions.empty()) return;
  for (int j : {0, 1})
    for (int i : near_nodes_[j]) slips_[j][i] = slips_now_[j][i], slips_now_[j][i] = {};
}

/// Where a thin wall bends around a jaw's edge a triangle between nodes that lie as they should may cut it: its point nearest to the jaw's core
/// is kept outside, but not half a thickness away, for a chord of what is bent lies deeper than its ends.
void Jaws::touch_between(int j, int triangle, const Wall& wall, double stiffness, std::vector<Push>& pushes) const {
  const double r = std::min({clamp_.edge_radius, clamp_.width / 2, clamp_.length / 2, clamp_.height / 2});
  const Lanes half{clamp_.width / 2 - r, clamp_.length / 2 - r, clamp_.height / 2 - r, 0};
  const auto over_face = [&](const Lanes& x) { return std::abs(x[0]) <= half[0] && std::abs(x[1]) <= half[1]; };
  const auto& n = wall.triangles[triangle];
  const std::array<Lanes, 3> x{local_[j][n[0]], local_[j][n[1]], local_[j][n[2]]};
  const double clear = clear_chord * std::min({wall.thickness[n[0]], wall.thickness[n[1]], wall.thickness[n[2]]}), within = r + clear;
  const auto beyond = [&](int axis) {
    return std::min({x[0][axis], x[1][axis], x[2][axis]}) > half[axis] + within || std::max({x[0][axis], x[1][axis], x[2][axis]}) < -half[axis] - within;
  };
  if (beyond(2) || beyond(1) || beyond(0)) return;
  if (over_face(x[0]) && over_face(x[1]) && over_face(x[2])) return;  // its nodes say it all
  const auto near = nearest_to_block(x, half, within);
  if (!(near.distance < within) || !(near.distance > 0)) return;
  double softness = 0;
  for (int k = 0; k < 3; ++k) softness += near.weights[k] * near.weights[k] / wall.mass[n[k]];
  pushes.push_back({stiffness / softness * (within - near.distance) / near.distance * (jaws_[j].frame * vector(near.apart)), n, near.weights, 0});
}

void Jaws::move(double clock, double pace, double dt) {
  const double before = travel_, farthest = start_gap_ - clamp_.gap;
  if (clamp_.pressure) {
    const double push = *clamp_.pressure * clamp_.width * clamp_.length;
    velocity_ += dt * (push - closing_force() - clamp_.jaw_damping * velocity_) / clamp_.mass;
    travel_ += dt * velocity_;
  } else {
    const double closing = closing_time(), now = clock + pace, back = clamp_.opens ? std::max(0.0, now - closing - clamp_.hold) : 0;
    travel_ = farthest * smooth(std::min(now, closing - back) / closing);
    velocity_ = (travel_ - before) / dt;
  }
  if (travel_ >= farthest) travel_ = farthest, velocity_ = 0;
  moved_ = travel_ - before;
  force_before_ = closing_force();
  jaws_[0].face += moved_ * clamp_.axis;
}

double Jaws::take_work() {
  const double work = (force_before_ + closing_force()) / 2 * moved_;
  moved_ = 0;
  return work;
}

void Jaws::keep(Archive& a) {
  for (int j : {0, 1}) {
    a(jaws_[j].face, forces_[j]);
    for (auto* slips : {&slips_[j], &slips_now_[j]})
      for (auto& slip : *slips) a(slip.place, slip.shear);
  }
  a(touched_, travel_, velocity_, deepest_, moved_, force_before_);
  looked_at_ = -1e30;
}

std::vector<Vector3d> Jaws::corners() const {
  std::vector<Vector3d> points;
  for (const auto& jaw : jaws_)
    for (int k = 0; k < 8; ++k)
      points.push_back(jaw.face + jaw.frame * Vector3d((k & 1 ? 0.5 : -0.5) * clamp_.width, (k & 2 ? 0.5 : -0.5) * clamp_.length, (k & 4 ? 1 : 0) * clamp_.height));
  return points;
}

}  // namespace palpate::explicit_shell
