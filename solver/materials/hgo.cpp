// W = μ/2 (Ī1 − 3) + Σ k1/(2 k2) (exp(k2 (Īa − 1)²) − 1) over two fibre families a with Īa = a·C̄a > 1: fibres carry tension only.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/materials/isochoric.hpp>

#include <array>
#include <numbers>

namespace palpate::materials {
namespace {

using Eigen::Vector3d;

Vector3d axis_of(std::span<const double> p) { return {p[4], p[5], p[6]}; }
Vector3d side_of(std::span<const double> p) { return {p[7], p[8], p[9]}; }

/// Unit vectors at ± the angle from the axis, in the plane of axis and side.
std::array<Vector3d, 2> families(std::span<const double> p) {
  const double angle = p[3] * std::numbers::pi / 180;
  const Vector3d axis = axis_of(p).normalized(), side = side_of(p);
  const Vector3d along = std::cos(angle) * axis, across = std::sin(angle) * (side - side.dot(axis) * axis).normalized();
  return {along + across, along - across};
}

Response respond(const Mat3& F, std::span<const double> p, Asked asked) {
  const auto I1 = first_invariant(F, asked);
  Response r = from_one(I1, p[0] / 2 * (I1.value - 3), p[0] / 2, 0);
  const double k1 = p[1], k2 = p[2];
  for (const Vector3d& a : families(p)) {
    const auto I4 = fibre_invariant(F, a, asked);
    const double stretch = I4.value - 1;
    if (stretch <= 1e-14) continue;  // slack; round-off must not decide whether a fibre at rest counts
    const double Q = k2 * stretch * stretch, E = k1 * std::exp(Q);
    const Response fibre = from_one(I4, k1 / (2 * k2) * std::expm1(Q), E * stretch, E * (1 + 2 * Q));
    r.W += fibre.W;
    r.P += fibre.P;
    if (asked == Asked::all) r.A += fibre.A;
  }
  return r;
}

std::string objection(std::span<const double> p) {
  const Vector3d axis = axis_of(p), side = side_of(p);
  if (axis.cross(side).norm() > 1e-6 * axis.norm() * side.norm()) return "";
  return "the fibres' plane is not defined: axis and side are parallel or have no length";
}

}  // namespace

Law hgo() {
  const Range component = {-1e6, 1e6};
  return {{"material", "hgo", "incompressible; neo-Hookean matrix and two families of fibres, exponential in tension, slack in compression",
           "Holzapfel, Gasser, Ogden 2000, A new constitutive framework for arterial wall mechanics, J. Elasticity 61:1",
           {{"mu", "MPa", {1e-9, 1e6}, 0.0067, "shear modulus of the matrix"},
            {"k1", "MPa", {0, 1e6}, 0.004, "stiffness of one family; 0 leaves the fibres out"},
            {"k2", "1", {1e-6, 1e3}, 1.5, "rate of the fibres' stiffening"},
            {"angle_deg", "degree", {0, 90}, 35, "each family lies at plus or minus this angle from the axis"},
            {"axis_x", "1", component, 1, "x (LPS) of the axis midway between the families, of any length"},
            {"axis_y", "1", component, 0, "y of the axis"},
            {"axis_z", "1", component, 0, "z of the axis"},
            {"side_x", "1", component, 0, "x (LPS) of any other direction in the plane of the fibres, of any length"},
            {"side_y", "1", component, 1, "y of that direction"},
            {"side_z", "1", component, 0, "z of that direction"}}},
          Kinematics::finite, respond, [](std::span<const double> p) { return p[0]; }, incompressible, 0, objection};
}

}  // namespace palpate::materials
