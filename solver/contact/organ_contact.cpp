// Search by lines backward from the points; linearisation of g, n and y along them.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/contact/organ_contact.hpp>

#include <algorithm>
#include <cmath>

#include <solver/contact/gap_law.hpp>
#include <solver/contact/tool_contact.hpp>
#include <solver/contact/triangle_tree.hpp>

namespace palpate::contact {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Surfaces that meet more steeply than this do not press each other: −n·m of 73 degrees.
constexpr double facing = 0.3;
/// How far back a line looks: of the smaller body's thinnest side, or of a joined body's face.
constexpr double reach_of_body = 0.25, reach_of_face = 1.0;
/// Nearer than this many face sizes at rest, what lies behind a face is its own body's back.
constexpr double own_back = 3;

Vector3d area_vector(const Triangle& c) { return (c[1] - c[0]).cross(c[2] - c[0]) / 2; }

Vector3d at(const Triangle& c, const double* N) { return N[0] * c[0] + N[1] * c[1] + N[2] * c[2]; }

Matrix3d cross_matrix(const Vector3d& v) {
  Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

Eigen::AlignedBox3d box_of(const std::vector<int>& faces, const std::vector<Triangle>& at) {
  Eigen::AlignedBox3d box;
  for (int f : faces)
    for (const auto& corner : at[f]) box.extend(corner);
  return box;
}

}  // namespace

std::vector<Pass> passes_between(const std::vector<int>& a, const std::vector<int>& b, bool joined, int contact, double friction) {
  if (b.empty()) return {{a, a, true, contact, friction}};
  return {{a, b, joined, contact, friction}, {b, a, joined, contact, friction}};
}

Matrix3d weight_gradients(const Triangle& c) {
  const Vector3d normal = (c[1] - c[0]).cross(c[2] - c[0]);
  Matrix3d gradients;
  for (int b = 0; b < 3; ++b) gradients.row(b) = normal.cross(c[(b + 2) % 3] - c[(b + 1) % 3]) / normal.squaredNorm();
  return gradients;
}

std::vector<Meeting> meetings(const Pass& pass, const std::vector<Triangle>& rest, const std::vector<Triangle>& now) {
  std::vector<Meeting> found;
  std::vector<Triangle> others;
  for (int f : pass.other) others.push_back(now[f]);
  const TriangleTree tree(std::move(others));
  const double thinnest = std::min(box_of(pass.own, rest).sizes().minCoeff(), box_of(pass.other, rest).sizes().minCoeff());
  const Eigen::AlignedBox3d other_box = box_of(pass.other, now);
  for (int i = 0; i < static_cast<int>(pass.own.size()); ++i) {
    const int f = pass.own[i];
    Eigen::AlignedBox3d box;
    for (const auto& corner : now[f]) box.extend(corner);
    if (!other_box.intersects(box)) continue;
    const Vector3d n = area_vector(now[f]).normalized(), rest_normal = area_vector(rest[f]).normalized();
    const double size = face_size(rest[f]), reach = pass.joined ? reach_of_face * size : reach_of_body * thinnest;
    for (int q = 0; q < points_per_face; ++q) {
      const Vector3d rest_point = at(rest[f], quadrature[q].N);
      const auto first = tree.first_crossing(at(now[f], quadrature[q].N), -n, reach, [&](const Crossing& crossing) {
        const int other = pass.other[crossing.triangle];
        if (other == f) return false;
        if (!pass.joined) return true;
        const Vector3d way = at(rest[other], crossing.weights.data()) - rest_point;
        return !(way.dot(rest_normal) < 0 && way.norm() < own_back * size);
      });
      // The way out of the other body; a surface met from its outside means that the point is not in it.
      if (first.triangle < 0 || !(n.dot(area_vector(now[pass.other[first.triangle]]).normalized()) < -facing)) continue;
      found.push_back({i, q, pass.other[first.triangle], first.weights});
    }
  }
  return found;
}

PairGeometry pair_geometry(const Meeting& meeting, const Triangle& own, const Triangle& other) {
  PairGeometry line;
  const double* N = quadrature[meeting.q].N;
  const auto& M = meeting.weights;
  const Vector3d area = area_vector(own), x = at(own, N), m = line.other_normal = area_vector(other).normalized();
  const Vector3d n = line.normal = area.normalized();
  const double along = m.dot(n);
  line.gap = m.dot(other[0] - x) / along;
  Rows18 &by_x = line.point_by_corners = Rows18::Zero(), &by_n = line.normal_by_corners = Rows18::Zero();
  Rows18 by_y = Rows18::Zero();  // of y's material place
  const Matrix3d normal_part = (Matrix3d::Identity() - n * n.transpose()) / (2 * area.norm());
  for (int a = 0; a < 3; ++a) {
    by_x.middleCols<3>(3 * a) = N[a] * Matrix3d::Identity();
    by_y.middleCols<3>(9 + 3 * a) = M[a] * Matrix3d::Identity();
    by_n.middleCols<3>(3 * a) = normal_part * cross_matrix(own[(a + 2) % 3] - own[(a + 1) % 3]);
  }
  // m·(x + g n − y) = 0 for the plane of the other face: m·(dx + dg n + g dn − Σ M dy_b) = 0, and what is left of the bracket slides in it.
  line.gap_by_corners = m.transpose() * (by_y - by_x - line.gap * by_n) / along;
  const Rows18 slide = by_x + n * line.gap_by_corners + line.gap * by_n - by_y;
  line.weights_by_corners = weight_gradients(other) * slide;
  return line;
}

PairPoint pair_point(const Meeting& meeting, const Triangle& own_rest, const Triangle& own, const Triangle& other, double carried, double softness) {
  PairPoint point;
  const double* N = quadrature[meeting.q].N;
  const auto& M = meeting.weights;
  const PairGeometry line = pair_geometry(meeting, own, other);
  const Vector3d n = point.normal = line.normal;
  const double deepest = deepest_gap * face_size(own_rest);
  point.gap = line.gap;
  const GapLaw law(carried, softness, deepest);
  const double t = law.pressure(carried, point.gap);
  if (!(t > 0)) {
    point.mismatch = carried / softness;
    return point;
  }
  point.mismatch = std::abs(law.gap - point.gap) / deepest;
  point.pressure = t;
  point.stiffness = law.stiffness;
  point.gap_by_corners = line.gap_by_corners;
  const double w = quadrature[meeting.q].weight * area_vector(own_rest).norm();
  // Where a trial state is deep inside, the pressure it asks for must not turn the forces: those terms stop there, as against a tool.
  const double turning = std::min(t, carried + 2 * softness);
  point.energy = w * GapLaw::energy(t, softness, deepest);
  const Rows18 pressing = turning * line.normal_by_corners - law.stiffness * n * line.gap_by_corners;
  for (int a = 0; a < 3; ++a) {
    point.residual.segment<3>(3 * a) = w * t * N[a] * n;
    point.residual.segment<3>(9 + 3 * a) = -w * t * M[a] * n;
    point.tangent.middleRows<3>(3 * a) = w * N[a] * pressing;
    point.tangent.middleRows<3>(9 + 3 * a) = -w * (M[a] * pressing + turning * n * line.weights_by_corners.row(a));
  }
  return point;
}

}  // namespace palpate::contact
