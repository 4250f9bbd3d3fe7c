// The mini-element's residual close to an equilibrium: what sensitivities ask of every number, without tangents and with the bubble condensed as it was
// there. With r_q, r_b the parts of the nodes and of the bubble: r = r_q − K_qb K_bb⁻¹ r_b.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/elements/sub_tetrahedra.hpp>

namespace palpate::elements {
namespace {

using materials::Kinematics;
using materials::Mat3;

/// ∫ N_a U*′(p), at the four points of mini_element.
Eigen::Vector4d dilation(const materials::VolumeEnergy& energy, const Eigen::Vector4d& p, double volume) {
  constexpr double far = 0.1381966011250105151795413, near = 1 - 3 * far;  // (5 − √5)/20
  Eigen::Vector4d sum = Eigen::Vector4d::Zero();
  for (int q = 0; q < 4; ++q) {
    Eigen::Vector4d N = Eigen::Vector4d::Constant(far);
    N(q) = near;
    sum += volume / 4 * materials::dilation(energy, N.dot(p)).value * N;
  }
  return sum;
}

}  // namespace

Vec16 residual_beside(const Tetrahedron& rest, const Material& material, ElementState& state, const BodyForce& body_force, const Condensation& known) {
  const double quarter = rest.volume / 4;
  const bool small = material.law.kinematics == Kinematics::small;
  const SubTetrahedra subs = sub_tetrahedra(rest, state);
  const Eigen::Vector4d p(state.nodal(3), state.nodal(7), state.nodal(11), state.nodal(15));
  Mat3 P = Mat3::Zero();
  Eigen::Vector3d of_bubble = -0.25 * body_force.rowwise().sum();
  Eigen::Vector4d volume = Eigen::Vector4d::Zero();
  for (int s = 0; s < 4; ++s) {
    const Mat3& F = subs[s].F;
    const Mat3 stress = respond(material, F, state, s).P + subs[s].p * (small ? Mat3(Mat3::Identity()) : cofactor(F));
    P += stress;
    of_bubble += stress * (4 * rest.gradients.col(s));
    const double J = small ? F.trace() - 2 : F.determinant();
    for (int a = 0; a < 4; ++a) volume(a) += quarter * mean_weight(a, s) * (J - 1);
  }
  volume -= dilation(material.volume_energy(mean_modulus(state)), p, rest.volume);
  Vec16 residual;
  for (int a = 0; a < 4; ++a) {
    residual.segment<3>(4 * a) = quarter * (P * rest.gradients.col(a));
    for (int s = 0; s < 4; ++s) residual.segment<3>(4 * a) -= quarter * mean_weight(a, s) * body_force.col(s);
    residual(4 * a + 3) = volume(a);
  }
  const Eigen::Vector3d step = -known.inverse * (quarter * of_bubble);
  state.bubble += step;
  return residual + known.columns * step;
}

}  // namespace palpate::elements
