// Contact at six points a face (Dunavant 1985, degree 4): t condensed from K Δu − n Δt = −r, n·Δu + g = g(t) + g′(t) Δt.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/contact/tool_contact.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpate::contact {
namespace {

using Eigen::Vector3d;

double area(const std::array<Vector3d, 3>& c) { return 0.5 * (c[1] - c[0]).cross(c[2] - c[0]).norm(); }

/// Coulomb's friction by a return to the cone, with a little elastic slip: the trial shear v − n (n·v), v = shear − ε Δplace, is scaled back
/// to μ t where it is larger. (Simo and Laursen 1992, Computers & Structures 42:97, eq. 2.23–2.26; tangent with all of its terms.)
struct Shear {
  Vector3d value = Vector3d::Zero();
  Eigen::Matrix3d by_place = Eigen::Matrix3d::Zero();
};

Shear shear(const Slip& slip, const Vector3d& place, const tools::Distance& d, double t, double t_stiffness, double friction, double stiffness) {
  const Vector3d v = slip.shear - stiffness * (place - slip.place);
  Shear trial;
  trial.value = v - d.n * d.n.dot(v);
  trial.by_place = -stiffness * (Eigen::Matrix3d::Identity() - d.n * d.n.transpose()) - d.n.dot(v) * d.hessian - d.n * (d.hessian * v).transpose();
  const double size = trial.value.norm();
  if (size <= friction * t) return trial;
  const Vector3d m = trial.value / size;
  Shear slipping;
  slipping.value = friction * t * m;
  slipping.by_place = friction * (t / size * (trial.by_place - m * (m.transpose() * trial.by_place)) - t_stiffness * m * d.n.transpose());
  return slipping;
}

/// What is remembered, turned with the tool.
Slip seen_now(const Tool& tool, const Pose& pose, const Slip& slip) {
  if (!tool.turns()) return slip;
  const Eigen::Matrix3d Q = tool.rotation(pose.angle);
  const Vector3d centre = tool.first_contact + tool.pivot;
  return {Q * (slip.place - centre) + centre, Q * slip.shear};
}

/// A face farther away than its own reach cannot touch: the distance changes by at most 1 mm per mm.
bool out_of_reach(const Tool& tool, const Pose& pose, const Face& face) {
  const Vector3d centre = (face.now[0] + face.now[1] + face.now[2]) / 3;
  double reach = 0;
  for (const auto& corner : face.now) reach = std::max(reach, (corner - centre).norm());
  const bool relaxed = std::all_of(face.pressures, face.pressures + points_per_face, [](double t) { return t == 0; });
  return relaxed && tool.distance(centre, pose).g > reach;
}

}  // namespace

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
    if (!(t > 0)) {
      result.mismatch = std::max(result.mismatch, carried / softness);
      continue;
    }
    result.touched = true;
    result.points[q] = {t, stiffness, d.n, Vector3d::Zero()};
    result.mismatch = std::max(result.mismatch, std::abs(gap - d.g) / deepest);
    const double w = weight * rest_area;
    result.force += w * t * d.n;
    result.area += weight * now_area;
    // Where a trial state is deep inside the tool, the pressure it asks for must not bend the surface: the curvature term stops there.
    const double curving = std::min(t, carried + 2 * softness);
    Eigen::Matrix3d k = w * (stiffness * d.n * d.n.transpose() - curving * d.hessian);
    if (face.slips) {
      const Shear s = shear(seen_now(tool, pose, face.slips[q]), x - pose.travel * tool.axis, d, t, stiffness, tool.friction, softness / deepest);
      result.points[q].shear = s.value;
      result.force += w * s.value;
      k -= w * s.by_place;
      for (int a = 0; a < 3; ++a) result.residual.segment<3>(3 * a) -= w * N[a] * s.value;
    }
    for (int a = 0; a < 3; ++a) {
      result.residual.segment<3>(3 * a) -= w * t * N[a] * d.n;
      for (int b = 0; b < 3; ++b) result.tangent.block<3, 3>(3 * a, 3 * b) += N[a] * N[b] * k;
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

bool find_first_contact(Tool& tool, const Vector3d& aim, const std::vector<Vector3d>& points) {
  double back = 0, front = 0;  // how far the points reach along the axis, seen from the aim
  for (const auto& x : points) {
    back = std::max(back, (aim - x).dot(tool.axis));
    front = std::max(front, (x - aim).dot(tool.axis));
  }
  const double touching = 1e-5 * (back + front);  // finer, and a tool that grazes the organ would creep along it
  tool.first_contact = aim - (back + 1e-3 * (back + front)) * tool.axis;
  double travel = 0;
  while (travel <= 2 * (back + front)) {  // the distance is a safe step (sphere tracing, Hart 1996)
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& x : points) nearest = std::min(nearest, tool.distance(x, travel).g);
    if (nearest <= touching) {
      tool.first_contact += (travel + nearest) * tool.axis;
      return true;
    }
    travel += std::max(nearest, touching);
  }
  return false;
}

std::vector<CatalogueEntry> entries() {
  return {{"contact", "frictionless", "rigid tool on the organ's faces, normal pressure alone, perturbed Lagrangian at six points a face",
           "Simo, Wriggers, Taylor 1985, Comput. Methods Appl. Mech. Eng. 50:163", {}},
          {"contact", "coulomb", "shear up to friction times pressure, after a little elastic slip; sticking = true: without bound",
           "Simo and Laursen 1992, Computers & Structures 42:97, eq. 2.23-2.26",
           {{"friction", "1", {0, 10}, 0.3, "Coulomb's coefficient, of a tool"}}},
          {"contact", "organs", "two organs, or an organ and itself, frictionless: lines along both surfaces' normals, pressures as against a tool",
           "Zimmerman and Ateshian 2018, J. Biomech. Eng. 140:081013", {}}};
}

}  // namespace palpate::contact
