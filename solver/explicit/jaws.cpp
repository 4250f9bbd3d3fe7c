// Penalty forces normal to a rounded block, regularised Coulomb friction, and the jaw's own motion.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/explicit/jaws.hpp>

#include <algorithm>
#include <sstream>

#include <palpate/errors.hpp>

namespace palpate::explicit_shell {
namespace {

using Eigen::Vector3d;

constexpr double clear_chord = 0.1;    ///< of the thickness, that the middles of the wall's edges and triangles keep from a jaw
constexpr double sticking_speed = 1;  ///< mm/s below which friction grows with the speed

Vector3d vector(const Lanes& a) { return {a[0], a[1], a[2]}; }

/// From 0 to 1, slow at the start, where little energy is stored: velocity zero at both ends, acceleration at the first.
double smooth(double s) {
  s = std::clamp(s, 0.0, 1.0);
  return s * s * s * (4 - 3 * s);
}

}  // namespace

Jaws::Jaws(const Clamp& clamp, const Wall& wall) : clamp_(clamp) {
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
  near_.assign(wall.rest.size(), 0);
  for (const auto& [a, b] : wall.edges) margin_ = std::max(margin_, 2 * length3(wall.rest[b] - wall.rest[a]));
  start_gap_ = clamp.open.value_or(top - bottom);
  if (start_gap_ < (top - bottom) * (1 - 1e-9)) {
    std::ostringstream text;
    text << "the jaws start inside the wall: " << start_gap_ << " mm apart, and the wall is " << top - bottom << " mm from outside to outside";
    throw Failure(ExitCode::misuse, text.str(), "", "a larger open_mm, or leave it out: both jaws then touch the wall");
  }
  if (!(clamp.gap < start_gap_)) throw Failure(ExitCode::misuse, "the jaws are to stop farther apart than they start", "", "a smaller gap_mm");
  const double middle = (top + bottom) / 2;
  for (int j : {0, 1}) {
    const Vector3d back = j == 0 ? up : -up;
    jaws_[j].face = clamp.centre + middle * up + start_gap_ / 2 * back;
    jaws_[j].frame << along.cross(back).normalized(), along, back;
    forces_[j].setZero();
  }
}

double Jaws::closing_time() const { return (start_gap_ - clamp_.gap) / clamp_.speed; }

double Jaws::kinetic() const { return clamp_.pressure ? 0.5 * clamp_.mass * velocity_ * velocity_ : 0; }

tools::Distance Jaws::distance(const Jaw& jaw, const Vector3d& x) const {
  auto d = block_.distance(jaw.frame.transpose() * (x - jaw.face), parameters_);
  d.n = jaw.frame * d.n;
  return d;
}

void Jaws::touch(const Wall& wall, const WallState& state, double stiffness, double damping, std::vector<Lanes>& force) {
  touched_.clear();
  const double reach = std::max({clamp_.width, clamp_.length, clamp_.height});
  for (int j : {0, 1}) {
    forces_[j].setZero();
    const Vector3d jaw_velocity = j == 0 ? Vector3d(velocity_ * clamp_.axis) : Vector3d(Vector3d::Zero());
    const Lanes face{jaws_[j].face[0], jaws_[j].face[1], jaws_[j].face[2], 0}, back{jaws_[j].frame(0, 2), jaws_[j].frame(1, 2), jaws_[j].frame(2, 2), 0};
    const Lanes along{jaws_[j].frame(0, 1), jaws_[j].frame(1, 1), jaws_[j].frame(2, 1), 0};
    for (std::size_t i = 0; i < state.x.size(); ++i) {
      const Lanes from = state.x[i] - face;
      near_[i] = dot3(from, back) > -margin_ && std::abs(dot3(from, along)) < clamp_.length / 2 + margin_;
      if (dot3(from, back) < -wall.thickness[i] / 2 || dot3(from, from) > reach * reach) continue;
      const auto d = distance(jaws_[j], vector(state.x[i]));
      const double depth = wall.thickness[i] / 2 - d.g;
      if (!(depth > 0)) continue;
      const Vector3d v = vector(state.v[i]) - jaw_velocity;
      const double normal = wall.mass[i] * std::max(stiffness * depth - 2 * damping * std::sqrt(stiffness) * v.dot(d.n), 0.0);
      Vector3d f = normal * d.n;
      if (clamp_.friction > 0) {
        const Vector3d slip = v - v.dot(d.n) * d.n;
        f -= clamp_.friction * normal / std::max(slip.norm(), sticking_speed) * slip;
      }
      force[i] += Lanes{f[0], f[1], f[2], 0};
      forces_[j] += f;
      deepest_ = std::max(deepest_, depth);
      if (j == 0) touched_.push_back(static_cast<int>(i));
    }
    touch_between(j, wall, state, stiffness / 4, force);
  }
}

/// Where a thin wall bends around a jaw's edge the chord between nodes may cut it, though the nodes lie as they should: the middles of the
/// wall's edges and triangles are kept outside, but not half a thickness away, for a chord of what is bent lies deeper than its ends.
void Jaws::touch_between(int j, const Wall& wall, const WallState& state, double stiffness, std::vector<Lanes>& force) {
  const Jaw& jaw = jaws_[j];
  const double reach = std::max({clamp_.width, clamp_.length, clamp_.height});
  const Lanes face{jaw.face[0], jaw.face[1], jaw.face[2], 0}, back{jaw.frame(0, 2), jaw.frame(1, 2), jaw.frame(2, 2), 0};
  const auto keep_outside = [&](const auto& nodes) {
    if (!near_[nodes[0]]) return;
    const double share = 1.0 / nodes.size();
    Lanes middle{};
    double clear = 0;
    for (int i : nodes) middle += share * state.x[i], clear += share * clear_chord * wall.thickness[i];
    const Lanes from = middle - face;
    if (dot3(from, back) < -clear || dot3(from, from) > reach * reach) return;
    const auto d = distance(jaw, vector(middle));
    if (!(clear - d.g > 0)) return;
    double softness = 0;
    for (int i : nodes) softness += share * share / wall.mass[i];
    const Vector3d f = stiffness / softness * (clear - d.g) * d.n;
    for (int i : nodes) force[i] += share * Lanes{f[0], f[1], f[2], 0};
    forces_[j] += f;
  };
  for (const auto& edge : wall.edges) keep_outside(edge);
  for (const auto& triangle : wall.triangles) keep_outside(triangle);
}

void Jaws::move(double clock, double pace, double dt) {
  const double before = travel_, farthest = start_gap_ - clamp_.gap;
  if (clamp_.pressure) {
    const double push = *clamp_.pressure * clamp_.width * clamp_.length;
    velocity_ += dt * (push - closing_force() - clamp_.jaw_damping * velocity_) / clamp_.mass;
    travel_ += dt * velocity_;
  } else {
    travel_ = farthest * smooth((clock + pace) / closing_time());
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

std::vector<Vector3d> Jaws::corners() const {
  std::vector<Vector3d> points;
  for (const auto& jaw : jaws_)
    for (int k = 0; k < 8; ++k)
      points.push_back(jaw.face + jaw.frame * Vector3d((k & 1 ? 0.5 : -0.5) * clamp_.width, (k & 2 ? 0.5 : -0.5) * clamp_.length, (k & 4 ? 1 : 0) * clamp_.height));
  return points;
}

}  // namespace palpate::explicit_shell
