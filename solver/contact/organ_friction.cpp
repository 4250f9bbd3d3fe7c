// Shear by the way from the anchor, and its derivatives by all nine corners.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/contact/organ_friction.hpp>

#include <solver/contact/gap_law.hpp>
#include <solver/contact/tool_contact.hpp>

namespace palpate::contact {

using Eigen::Vector3d;

double slip_stiffness(const Triangle& own_rest, double softness) { return softness / (deepest_gap * face_size(own_rest)); }

/// In the other face's plane, z − y = shear/ε + c n: seen along n, x − z is −shear/ε.
PairSlip anchored(const Meeting& meeting, const Triangle& own, const Triangle& other, const Vector3d& shear, double stiffness) {
  const Vector3d n = (own[1] - own[0]).cross(own[2] - own[0]).normalized(), m = (other[1] - other[0]).cross(other[2] - other[0]).normalized();
  const Vector3d across = shear / stiffness, aside = weight_gradients(other) * (across - m.dot(across) / m.dot(n) * n);
  PairSlip slip{meeting.other, meeting.weights, shear};
  for (int b = 0; b < 3; ++b) slip.weights[b] += aside(b);
  return slip;
}

namespace {

using Rows27 = Eigen::Matrix<double, 3, 27>;

/// x − z, and how it changes with the corners. Seen from a corner nearby, so that rounding is that of small numbers.
Vector3d elastic_slip(const Meeting& meeting, const PairGeometry& line, const Triangle& own, const Triangle& other, const Hold& hold, Rows27& by_corners) {
  const double* N = quadrature[meeting.q].N;
  Vector3d slip = Vector3d::Zero();
  by_corners.setZero();
  by_corners.leftCols<18>() = line.point_by_corners;
  for (int a = 0; a < 3; ++a) {
    if (hold.before.face >= 0) {
      slip += N[a] * (own[a] - own[0]) - hold.before.weights[a] * (hold.anchor[a] - own[0]);
      by_corners.middleCols<3>(18 + 3 * a).diagonal().setConstant(-hold.before.weights[a]);
      continue;
    }
    const Vector3d moved = other[a] - hold.other[a];
    slip += N[a] * (own[a] - hold.own[a]) - meeting.weights[a] * moved;
    by_corners.middleCols<3>(9 + 3 * a).diagonal().array() -= meeting.weights[a];
    by_corners.leftCols<18>() -= moved * line.weights_by_corners.row(a);
  }
  return slip;
}

}  // namespace

PairShear pair_shear(const Meeting& meeting, const PairPoint& point, const Triangle& own_rest, const Triangle& own, const Triangle& other,
                     const Hold& hold, double mu, double softness, const KnownCoulomb* beside) {
  PairShear result;
  const double stiffness = slip_stiffness(own_rest, softness);
  const PairGeometry line = pair_geometry(meeting, own, other);
  const double* N = quadrature[meeting.q].N;
  const auto& M = meeting.weights;
  Rows27 by_corners;  // of the elastic slip, then of the shear
  const Vector3d slip = elastic_slip(meeting, line, own, other, hold, by_corners);
  const Vector3d trial = -stiffness * slip;
  const Coulomb c = beside ? coulomb_beside(*beside, trial, point.normal, mu, point.pressure) : coulomb(trial, point.normal, mu, point.pressure);
  by_corners = (-stiffness * c.by_trial * by_corners).eval();
  by_corners.leftCols<18>() += c.by_normal * line.normal_by_corners - point.stiffness * c.by_pressure * line.gap_by_corners;

  const double w = quadrature[meeting.q].weight * (own_rest[1] - own_rest[0]).cross(own_rest[2] - own_rest[0]).norm() / 2;
  for (int a = 0; a < 3; ++a) {
    result.residual.segment<3>(3 * a) = -w * N[a] * c.shear;
    result.residual.segment<3>(9 + 3 * a) = w * M[a] * c.shear;
    result.tangent.middleRows<3>(3 * a) = -w * N[a] * by_corners;
    result.tangent.middleRows<3>(9 + 3 * a) = w * M[a] * by_corners;
    result.tangent.block<3, 18>(9 + 3 * a, 0) += w * c.shear * line.weights_by_corners.row(a);
  }
  result.law = {trial, point.normal, mu, point.pressure, c};
  result.after = anchored(meeting, own, other, c.slides ? Vector3d((1 - inside_the_cone) * c.shear) : c.shear, stiffness);
  if (c.slides) result.after.beyond = (trial - point.normal * point.normal.dot(trial) - c.shear) / stiffness;
  result.after.way = hold.before.way + slip - point.normal * point.normal.dot(slip) + hold.before.shear / stiffness;
  return result;
}

}  // namespace palpate::contact
