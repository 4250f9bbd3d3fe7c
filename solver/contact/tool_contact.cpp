// Contact at six points a face (Dunavant 1985, degree 4): t condensed from K Δu − n Δt = −r, n·Δu + g = g(t) + g′(t) Δt; and the tractions that a tool has besides.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/contact/tool_contact.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpate::contact {
namespace {

using Eigen::Vector3d;

double area(const std::array<Vector3d, 3>& c) { return 0.5 * (c[1] - c[0]).cross(c[2] - c[0]).norm(); }

/// What is remembered, turned with the tool.
Slip seen_now(const Tool& tool, const Pose& pose, const Slip& slip) {
  if (!tool.turns()) return slip;
  const Eigen::Matrix3d Q = tool.rotation(pose.angle);
  const Vector3d centre = tool.first_contact + tool.pivot;
  return {Q * (slip.place - centre) + centre, Q * slip.shear};
}

/// A pressure below this part of the softness, or a gap that would ask for as much tension, tells neither contact from a gap.
constexpr double weak_pressure = 1e-5;

/// A face farther away than its own reach cannot touch: the distance changes by at most 1 mm per mm.
bool out_of_reach(const Tool& tool, const Pose& pose, const Face& face) {
  const Vector3d centre = (face.now[0] + face.now[1] + face.now[2]) / 3;
  double reach = 0;
  for (const auto& corner : face.now) reach = std::max(reach, (corner - centre).norm());
  const bool relaxed = std::all_of(face.pressures, face.pressures + points_per_face, [](double t) { return t == 0; });
  return relaxed && tool.distance(centre, pose).g > reach + tool.reach();
}

}  // namespace

bool Tool::holds_on() const {
  return std::any_of(tractions.begin(), tractions.end(), [](const auto& active) { return active.effect.traction.holds_on; });
}

double Tool::reach() const {
  double farthest = 0;
  for (const auto& [effect, values] : tractions)
    if (effect.traction.reach) farthest = std::max(farthest, effect.traction.reach(values));
  return farthest;
}

Eigen::Matrix3d Tool::frame() const {
  const Vector3d z = -axis;
  const Vector3d helper = std::abs(z.x()) < 0.6 ? Vector3d::UnitX() : Vector3d::UnitY();
  Eigen::Matrix3d columns;
  columns.col(0) = across.isZero() ? helper.cross(z).normalized() : (across - across.dot(z) * z).normalized();
  columns.col(1) = z.cross(columns.col(0));
  columns.col(2) = z;
  return columns;
}

tools::Distance Tool::distance(const Vector3d& x, const Pose& pose) const {
  Eigen::Matrix3d R = frame();
  Vector3d from_tip = x - first_contact - pose.travel * axis;
  if (turns()) {
    const Eigen::Matrix3d Q = rotation(pose.angle);
    R = Q * R;
    from_tip += Q * pivot - pivot;
  }
  tools::Distance d = shape.distance(R.transpose() * from_tip, parameters);
  d.n = R * d.n;
  d.hessian = R * d.hessian * R.transpose();
  return d;
}

double face_size(const std::array<Vector3d, 3>& corners) { return std::sqrt(area(corners) * 4 / std::sqrt(3.0)); }

FaceContact face_contact(const Tool& tool, const Pose& pose, const Face& face, double softness) {
  FaceContact result;
  if (out_of_reach(tool, pose, face)) return result;
  const double rest_area = area(face.rest), now_area = area(face.now);
  const Vector3d rest_normal = (face.rest[1] - face.rest[0]).cross(face.rest[2] - face.rest[0]).normalized();
  const double size = face_size(face.rest), deepest = deepest_gap * size;
  for (int q = 0; q < points_per_face; ++q) {
    const auto& [N, weight] = quadrature[q];
    const Vector3d x = N[0] * face.now[0] + N[1] * face.now[1] + N[2] * face.now[2];
    const tools::Distance d = tool.distance(x, pose);
    const double carried = face.pressures[q];
    const GapLaw law(carried, softness, deepest);
    const auto [gap, stiffness] = law;
    const double t = law.pressure(carried, d.g);
    result.penetration = std::max(result.penetration, -d.g / size);
    const bool presses = t > 0;
    result.weakly_active += std::abs(t) <= weak_pressure * softness;
    if (!presses) result.mismatch = std::max(result.mismatch, carried / softness);
    if (!presses && !(d.g < tool.reach())) continue;
    result.touched = true;
    effects::Traction traction;
    if (presses) {
      result.points[q] = {t, stiffness, d.n};
      result.mismatch = std::max(result.mismatch, std::abs(gap - d.g) / deepest);
      result.area += weight * now_area;
      result.energy += weight * rest_area * GapLaw::energy(t, softness, deepest);
      // Where a trial state is deep inside the tool, the pressure it asks for must not bend the surface: the curvature term stops there.
      const double curving = std::min(t, carried + 2 * softness);
      traction = {t * d.n, curving * d.hessian - stiffness * d.n * d.n.transpose()};
    }
    for (const auto& [effect, values] : tool.tractions) {
      const auto& socket = effect.traction;
      if (!presses && !socket.reach) continue;
      const auto more = socket.respond({x - pose.travel * tool.axis, d, presses ? t : 0, presses ? stiffness : 0, softness / deepest,
                                        face.slips ? seen_now(tool, pose, face.slips[q]) : Slip{}, face.branches ? face.branches[q] : Branch::by_bound},
                                       values);
      // What reaches out holds the area that the tool sees, not a face at right angles to it.
      const double seen = socket.reach ? std::max(0.0, -rest_normal.dot(d.n)) : 1;
      traction.value += seen * more.value;
      traction.by_place += seen * more.by_place;
      if (socket.reach) result.points[q].cling += seen * more.value;
      if (socket.reach && seen > 0) traction.by_place -= more.value * (d.hessian * rest_normal).transpose();
      if (!socket.holds_on) continue;
      result.points[q].shear = more.value;
      result.points[q].slides = more.slides;
      result.points[q].beyond = more.beyond;
    }
    const double w = weight * rest_area;
    result.force += w * traction.value;
    for (int a = 0; a < 3; ++a) {
      result.residual.segment<3>(3 * a) -= w * N[a] * traction.value;
      for (int b = 0; b < 3; ++b) result.tangent.block<3, 3>(3 * a, 3 * b) -= w * N[a] * N[b] * traction.by_place;
    }
  }
  return result;
}

Vector3d place(const Tool& tool, const Pose& pose, const std::array<Vector3d, 3>& corners, int q) {
  const auto& N = quadrature[q].N;
  const Vector3d without_travel = N[0] * corners[0] + N[1] * corners[1] + N[2] * corners[2] - pose.travel * tool.axis;
  if (!tool.turns()) return without_travel;
  const Vector3d centre = tool.first_contact + tool.pivot;
  return tool.rotation(pose.angle).transpose() * (without_travel - centre) + centre;
}

double next_pressure(const Point& point, int q, double before, const std::array<Vector3d, 3>& corner_steps, double length) {
  Vector3d step = Vector3d::Zero();
  for (int a = 0; a < 3; ++a) step += quadrature[q].N[a] * corner_steps[a];
  const double after = std::max(0.0, point.pressure - point.stiffness * point.normal.dot(step));
  return before + length * (after - before);
}

std::vector<CatalogueEntry> entries() {
  return {{"contact", "frictionless", "rigid tool on the organ's faces, normal pressure alone, perturbed Lagrangian at six points a face",
           "Simo, Wriggers, Taylor 1985, Comput. Methods Appl. Mech. Eng. 50:163", {}},
          {"contact", "organs", "two organs, or an organ and itself, frictionless, rough or sticking: lines along both surfaces' normals, pressures as against a tool",
           "Zimmerman and Ateshian 2018, J. Biomech. Eng. 140:081013", {}}};
}

}  // namespace palpate::contact
