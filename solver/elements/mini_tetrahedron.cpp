// Potential of an element of volume V, over its four sub-tetrahedra s with F_s = I + Σ u_a ⊗ ∇N_a + 4 b ⊗ ∇N_s:
//   Π = Σ_s V/4 [W(F_s) + p_s (J_s − 1)] − ∫ U*(p),   p_s = Σ_a w_sa p_a,   w_sa = 5/16 for a ≠ s, 1/16 for a = s,
// U* = p²/(2κ) for a quadratic volume energy. Its stationary value is what physics.md §1 writes as two equations. (Arnold,
// Brezzi, Fortin 1984.)
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/elements/mini_tetrahedron.hpp>

#include <Eigen/Cholesky>
#include <cmath>
#include <stdexcept>

namespace palpate::elements {
namespace {

using materials::Kinematics;
using materials::Mat3;
using materials::Mat9;
using materials::Response;
using materials::Vec9;
using Mat94 = Eigen::Matrix<double, 9, 4>;

constexpr double mean_weight(int a, int s) { return a == s ? 1.0 / 16 : 5.0 / 16; }

/// J − 1, its gradient by F, and the Hessian contracted with p: the volume term of one sub-tetrahedron.
struct VolumeTerm {
  double dilation = 0;  ///< J − 1
  Vec9 gradient;        ///< cof F, or I when the geometry is not updated
};

Vec9 flat(const Mat3& m) { return Eigen::Map<const Vec9>(m.data()); }

Mat3 cofactor(const Mat3& F) {
  Mat3 c;
  c.col(0) = F.col(1).cross(F.col(2));
  c.col(1) = F.col(2).cross(F.col(0));
  c.col(2) = F.col(0).cross(F.col(1));
  return c;
}

VolumeTerm volume_term(const Mat3& F, Kinematics kinematics) {
  if (kinematics == Kinematics::small) return {F.trace() - 3, flat(Mat3::Identity())};
  return {F.determinant() - 1, flat(cofactor(F))};
}

/// A += p ∂cof F/∂F: ∂(cof F)_ij/∂F_kl = ε_ikm ε_jln F_mn.
void add_cofactor_derivative(Mat9& A, double p, const Mat3& F) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int k = (i + 1) % 3, m = (i + 2) % 3, l = (j + 1) % 3, n = (j + 2) % 3;
      A(i + 3 * j, k + 3 * l) += p * F(m, n);
      A(i + 3 * j, m + 3 * n) += p * F(k, l);
      A(i + 3 * j, k + 3 * n) -= p * F(m, l);
      A(i + 3 * j, m + 3 * l) -= p * F(k, n);
    }
}

/// Gᵀ X for G = I ⊗ g, the deformation gradient of a displacement that is 1 at a node with gradient g: 9 × n to 3 × n.
template <int n>
Eigen::Matrix<double, 3, n> along_rows(const Eigen::Vector3d& g, const Eigen::Matrix<double, 9, n>& X) {
  return g(0) * X.template middleRows<3>(0) + g(1) * X.template middleRows<3>(3) + g(2) * X.template middleRows<3>(6);
}
/// X G: m × 9 to m × 3.
template <int m>
Eigen::Matrix<double, m, 3> along_columns(const Eigen::Vector3d& g, const Eigen::Matrix<double, m, 9>& X) {
  return g(0) * X.template middleCols<3>(0) + g(1) * X.template middleCols<3>(3) + g(2) * X.template middleCols<3>(6);
}

struct SubTetrahedron {
  Mat3 F;
  double p = 0;
};

using SubTetrahedra = std::array<SubTetrahedron, 4>;

SubTetrahedra sub_tetrahedra(const Tetrahedron& rest, const ElementState& state) {
  Mat3 F = Mat3::Identity();
  Eigen::Vector4d p;
  for (int a = 0; a < 4; ++a) {
    F += state.nodal.segment<3>(4 * a) * rest.gradients.col(a).transpose();
    p(a) = state.nodal(4 * a + 3);
  }
  SubTetrahedra subs;
  for (int s = 0; s < 4; ++s) {
    subs[s].F = F + 4 * state.bubble * rest.gradients.col(s).transpose();
    for (int a = 0; a < 4; ++a) subs[s].p += mean_weight(a, s) * p(a);
  }
  return subs;
}

/// Everything summed over the sub-tetrahedra, before condensation. Suffixes: u 12 displacements, b bubble, p 4 pressures.
struct Sums {
  Vec9 P = Vec9::Zero();                        ///< Σ P_s + p_s cof F_s
  Mat9 A = Mat9::Zero();                        ///< Σ A_s
  Eigen::Matrix<double, 3, 9> GA = Eigen::Matrix<double, 3, 9>::Zero();  ///< Σ 4 (I⊗∇N_s)ᵀ A_s
  Eigen::Matrix3d bb = Eigen::Matrix3d::Zero();
  Eigen::Vector3d rb = Eigen::Vector3d::Zero();
  Mat94 cw = Mat94::Zero();                     ///< Σ cof F_s w_sᵀ
  Eigen::Matrix<double, 3, 4> bp = Eigen::Matrix<double, 3, 4>::Zero();
  Eigen::Vector4d rp = Eigen::Vector4d::Zero();
  double stress_size = 0;
  bool inverted = false;
};

Sums sum_over(const SubTetrahedra& subs, const Tetrahedron& rest, const Material& material, const BodyForce& body_force) {
  Sums sums;
  const auto kinematics = material.law.kinematics;
  for (int s = 0; s < 4; ++s) {
    const auto& [F, p] = subs[s];
    const VolumeTerm volume = volume_term(F, kinematics);
    if (kinematics == Kinematics::finite && !(volume.dilation > -1)) {
      sums.inverted = true;
      return sums;
    }
    Response r = material.respond(F);
    if (kinematics == Kinematics::finite) add_cofactor_derivative(r.A, p, F);
    const Vec9 P = flat(r.P) + p * volume.gradient;
    const Eigen::Vector3d g = 4 * rest.gradients.col(s);
    const Eigen::Matrix<double, 3, 9> GA = along_rows<9>(g, r.A);
    Eigen::RowVector4d w;
    for (int a = 0; a < 4; ++a) w(a) = mean_weight(a, s);
    sums.P += P;
    sums.A += r.A;
    sums.GA += GA;
    sums.bb += along_columns<3>(g, GA);
    sums.rb += along_rows<1>(g, P) - 0.25 * body_force.col(s);  // the bubble's mean over a sub-tetrahedron is 1/4
    sums.cw += volume.gradient * w;
    sums.bp += along_rows<1>(g, volume.gradient) * w;
    sums.rp += volume.dilation * w.transpose();
    sums.stress_size += flat(r.P).norm() + std::abs(p) * volume.gradient.norm();
  }
  return sums;
}

/// Newton for the bubble: at most a few steps, halved while a sub-tetrahedron would invert.
ElementFault solve_bubble(const Tetrahedron& rest, const Material& material, ElementState& state, const BodyForce& body_force, Sums& sums) {
  constexpr int most_iterations = 30;
  const double gradient_size = 4 * rest.gradients.norm();
  sums = sum_over(sub_tetrahedra(rest, state), rest, material, body_force);
  if (sums.inverted) {  // an old bubble in a new shape: begin again from none
    state.bubble.setZero();
    sums = sum_over(sub_tetrahedra(rest, state), rest, material, body_force);
  }
  for (int i = 0; i < most_iterations; ++i) {
    if (sums.inverted) return ElementFault::inverted;
    // Relative to the stress, but not below what rounding F near I leaves of it.
    if (sums.rb.norm() <= gradient_size * (1e-11 * sums.stress_size + 1e-13 * material.shear_modulus())) return ElementFault::none;
    const Eigen::LLT<Eigen::Matrix3d> factor(sums.bb);
    if (factor.info() != Eigen::Success) return ElementFault::bubble_not_positive;
    const Eigen::Vector3d step = -factor.solve(sums.rb), start = state.bubble;
    for (double length = 1; length > 1e-3; length /= 2) {
      state.bubble = start + length * step;
      sums = sum_over(sub_tetrahedra(rest, state), rest, material, body_force);
      if (!sums.inverted) break;
    }
  }
  return ElementFault::bubble_not_converged;
}

/// ∫ N_a U*′(p) and its derivative ∫ N_a U*″(p) N_b, at four points that are exact for a quadratic U* (Hammer, Marlowe, Stroud
/// 1956).
struct DilationTerm {
  Eigen::Vector4d value = Eigen::Vector4d::Zero();
  Eigen::Matrix4d derivative = Eigen::Matrix4d::Zero();
};

DilationTerm dilation_term(const materials::VolumeEnergy& energy, const Eigen::Vector4d& p, double volume) {
  constexpr double far = 0.1381966011250105151795413, near = 1 - 3 * far;  // (5 − √5)/20
  DilationTerm term;
  for (int q = 0; q < 4; ++q) {
    Eigen::Vector4d N = Eigen::Vector4d::Constant(far);
    N(q) = near;
    const auto [value, slope] = materials::dilation(energy, N.dot(p));
    term.value += volume / 4 * value * N;
    term.derivative += volume / 4 * slope * N * N.transpose();
  }
  return term;
}

}  // namespace

Tetrahedron tetrahedron(const Eigen::Matrix<double, 3, 4>& X) {
  Mat3 edges;
  for (int a = 0; a < 3; ++a) edges.col(a) = X.col(a + 1) - X.col(0);
  Tetrahedron t;
  t.volume = edges.determinant() / 6;
  if (!(t.volume > 0)) throw std::domain_error("tetrahedron without positive volume");
  t.gradients.rightCols<3>() = edges.inverse().transpose();
  t.gradients.col(0) = -t.gradients.rightCols<3>().rowwise().sum();
  return t;
}

ElementSystem mini_element(const Tetrahedron& rest, const Material& material, ElementState& state, const BodyForce& body_force) {
  ElementSystem system;
  Sums sums;
  system.fault = solve_bubble(rest, material, state, body_force, sums);
  if (system.fault != ElementFault::none) return system;
  const double quarter = rest.volume / 4;

  // Full blocks, displacements then pressures.
  Eigen::Matrix<double, 16, 16> K;
  Vec16 r;
  Eigen::Matrix<double, 3, 16> Kb;
  for (int a = 0; a < 4; ++a) {
    const Eigen::Vector3d ga = quarter * rest.gradients.col(a);
    const Eigen::Matrix<double, 3, 9> row = along_rows<9>(ga, sums.A);
    for (int b = 0; b < 4; ++b) K.block<3, 3>(3 * a, 3 * b) = along_columns<3>(rest.gradients.col(b), row);
    K.block<3, 4>(3 * a, 12) = along_rows<4>(ga, sums.cw);
    Kb.middleCols<3>(3 * a) = along_columns<3>(ga, sums.GA);
    r.segment<3>(3 * a) = along_rows<1>(ga, sums.P);
    for (int s = 0; s < 4; ++s) r.segment<3>(3 * a) -= quarter * mean_weight(a, s) * body_force.col(s);
  }
  Eigen::Vector4d p;
  for (int a = 0; a < 4; ++a) p(a) = state.nodal(4 * a + 3);
  const DilationTerm dilation = dilation_term(material.volume_energy(), p, rest.volume);
  K.bottomRightCorner<4, 4>() = -dilation.derivative;
  r.tail<4>() = quarter * sums.rp - dilation.value;

  // Condensation: K − K_qb K_bb⁻¹ K_bq, where the bubble's own residual is already solved.
  Kb.rightCols<4>() = quarter * sums.bp;
  const Eigen::LLT<Eigen::Matrix3d> factor(quarter * sums.bb);
  if (factor.info() != Eigen::Success) {
    system.fault = ElementFault::bubble_not_positive;
    return system;
  }
  K.bottomLeftCorner<4, 12>() = K.topRightCorner<12, 4>().transpose();
  K -= Kb.transpose().lazyProduct(Eigen::Matrix<double, 3, 16>(factor.solve(Kb)));

  static constexpr std::array<int, 16> from = {0, 1, 2, 12, 3, 4, 5, 13, 6, 7, 8, 14, 9, 10, 11, 15};  // node by node
  for (int i = 0; i < 16; ++i) {
    system.residual(i) = r(from[i]);
    for (int j = 0; j < 16; ++j) system.tangent(i, j) = K(from[i], from[j]);
  }
  system.internal_force = quarter * sums.stress_size * rest.gradients.norm();
  return system;
}

ElementResult mini_element_result(const Tetrahedron& rest, const Material& material, const ElementState& state) {
  ElementResult result;
  for (const auto& [F, p] : sub_tetrahedra(rest, state)) {
    const bool small = material.law.kinematics == Kinematics::small;
    const double J = small ? F.trace() - 2 : F.determinant();
    const Mat3 P = material.respond(F).P;
    const Mat3 sigma = small ? P : Mat3(P * F.transpose() / J);
    const Mat3 deviator = sigma - sigma.trace() / 3 * Mat3::Identity();
    result.von_mises += 0.25 * std::sqrt(1.5) * deviator.norm();
    result.J += 0.25 * J;
  }
  return result;
}

CatalogueEntry mini_tetrahedron_entry() {
  return {"element", "mini_tetrahedron", "P1+/P1: linear displacement with a bubble, linear pressure; stable for incompressible tissue",
          "Arnold, Brezzi, Fortin 1984, Calcolo 21:337", {}};
}

}  // namespace palpate::elements
