// Potential of an element of volume V, over its four sub-tetrahedra s with F_s = I + Σ u_a ⊗ ∇N_a + 4 b ⊗ ∇N_s:
//   Π = Σ_s V/4 [W(F_s) + p_s (J_s − 1)] − ∫ U*(p),   p_s = Σ_a w_sa p_a,   w_sa = 5/16 for a ≠ s, 1/16 for a = s,
// U* = p²/(2κ) for a quadratic volume energy. Its stationary value is what physics.md §1 writes as two equations. (Arnold,
// Brezzi, Fortin 1984.)
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/elements/mini_tetrahedron.hpp>

#include <solver/elements/sub_tetrahedra.hpp>

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
using Vec81 = Eigen::Matrix<double, 81, 1>;
using Mat93 = Eigen::Matrix<double, 9, 3>;
using Mat94 = Eigen::Matrix<double, 9, 4>;

/// J − 1 and its gradient by F: the volume term of one sub-tetrahedron.
struct VolumeTerm {
  double dilation = 0;  ///< J − 1
  Vec9 gradient;        ///< cof F, or I when the geometry is not updated
};

Eigen::Map<const Vec9> flat(const Mat3& m) { return Eigen::Map<const Vec9>(m.data()); }
/// Of 81 numbers in a row Eigen makes better loops than of 9 × 9.
Eigen::Map<const Vec81> flat(const Mat9& m) { return Eigen::Map<const Vec81>(m.data()); }
Eigen::Map<Vec81> flat(Mat9& m) { return Eigen::Map<Vec81>(m.data()); }

VolumeTerm volume_term(const Mat3& F, Kinematics kinematics) {
  if (kinematics == Kinematics::small) return {F.trace() - 3, flat(Mat3(Mat3::Identity()))};
  return {F.determinant() - 1, flat(cofactor(F))};
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

/// A bubble's trial, with what its equation needs summed over the sub-tetrahedra. Suffixes: u 12 displacements, b bubble, p 4
/// pressures.
struct Trial {
  SubTetrahedra subs;
  std::array<VolumeTerm, 4> volume;
  Mat9 A;    ///< Σ A_s, the laws' part
  Mat93 AG;  ///< Σ A_s 4 (I⊗∇N_s), the laws' part
  Vec9 P;    ///< Σ P_s + p_s cof F_s
  Mat3 bb;   ///< ∂cof F/∂F has no part in it: it is antisymmetric
  Eigen::Vector3d rb;
  double stress_size;
  double W;  ///< Σ W_s + p_s (J_s − 1)
  bool inverted;
};

void try_bubble(Trial& t, const Tetrahedron& rest, const Material& material, const ElementState& state,
                const BodyForce& body_force) {
  t.subs = sub_tetrahedra(rest, state);
  t.A.setZero();
  t.AG.setZero();
  t.P.setZero();
  t.bb.setZero();
  t.rb = -0.25 * body_force.rowwise().sum();  // the bubble's mean over a sub-tetrahedron is 1/4
  t.stress_size = t.W = 0;
  t.inverted = false;
  const auto kinematics = material.law.kinematics;
  for (int s = 0; s < 4; ++s) {
    const auto& [F, p] = t.subs[s];
    t.volume[s] = volume_term(F, kinematics);
    if (kinematics == Kinematics::finite && !(t.volume[s].dilation > -1)) {
      t.inverted = true;
      return;
    }
    const Response r = respond(material, F, state, s);
    const Vec9 P = flat(r.P) + p * t.volume[s].gradient;
    const Eigen::Vector3d g = 4 * rest.gradients.col(s);
    const Mat93 AG = along_columns<9>(g, r.A);
    flat(t.A) += flat(r.A);
    t.AG += AG;
    t.P += P;
    t.W += r.W + p * t.volume[s].dilation;
    t.bb += along_rows<3>(g, AG);
    t.rb += along_rows<1>(g, P);
    t.stress_size += flat(r.P).norm() + std::abs(p) * t.volume[s].gradient.norm();
  }
}

/// Newton for the bubble: at most a few steps, halved while a sub-tetrahedron would invert. What is left of its residual is small
/// enough for a last linear step, which the condensation takes.
ElementFault solve_bubble(const Tetrahedron& rest, const Material& material, ElementState& state, const BodyForce& body_force,
                          Trial& trial) {
  constexpr int most_iterations = 30;
  constexpr double linear = 1e-7;  // the last step's error is its square
  const double gradient_size = 4 * rest.gradients.norm();
  try_bubble(trial, rest, material, state, body_force);
  if (trial.inverted) {  // an old bubble in a new shape: begin again from none
    state.bubble.setZero();
    try_bubble(trial, rest, material, state, body_force);
  }
  for (int i = 0; i < most_iterations; ++i) {
    if (trial.inverted) return ElementFault::inverted;
    const Eigen::LLT<Mat3> factor(trial.bb);
    if (factor.info() != Eigen::Success) return ElementFault::bubble_not_positive;
    // Relative to the stress, but not below what rounding F near I leaves of it.
    if (trial.rb.norm() <= gradient_size * (linear * trial.stress_size + 1e-13 * material.shear_modulus()))
      return ElementFault::none;
    const Eigen::Vector3d step = -factor.solve(trial.rb), start = state.bubble;
    for (double length = 1; length > 1e-3; length /= 2) {
      state.bubble = start + length * step;
      try_bubble(trial, rest, material, state, body_force);
      if (!trial.inverted) break;
    }
  }
  return ElementFault::bubble_not_converged;
}

/// The volume terms at the bubble solved: Σ_s x_s w_sa = far Σ_s x_s + (near − far) x_a.
struct VolumeSums {
  Mat94 cw;                        ///< Σ cof F_s w_sᵀ
  Eigen::Matrix<double, 3, 4> bp;  ///< Σ 4 (I⊗∇N_s)ᵀ cof F_s w_sᵀ
  Eigen::Vector4d rp;              ///< Σ (J_s − 1) w_s
};

VolumeSums volume_sums(const Trial& trial, const Tetrahedron& rest) {
  VolumeSums sums;
  for (int s = 0; s < 4; ++s) {
    sums.cw.col(s) = trial.volume[s].gradient;
    sums.bp.col(s) = along_rows<1>(4 * rest.gradients.col(s), trial.volume[s].gradient);
    sums.rp(s) = trial.volume[s].dilation;
  }
  const auto weigh = [](auto&& column_of, const auto& sum) {
    for (int a = 0; a < 4; ++a) column_of(a) = far_weight * sum + (near_weight - far_weight) * column_of(a);
  };
  weigh([&](int a) { return sums.cw.col(a); }, Vec9(sums.cw.rowwise().sum()));
  weigh([&](int a) { return sums.bp.col(a); }, Eigen::Vector3d(sums.bp.rowwise().sum()));
  weigh([&](int a) -> double& { return sums.rp(a); }, sums.rp.sum());
  return sums;
}

/// A += Σ p_s ∂cof F_s/∂F, AG += Σ p_s ∂cof F_s/∂F 4 (I⊗∇N_s). In AG the bubble's part of F_s vanishes, by antisymmetry again.
void add_geometric_stiffness(Trial& t, const Tetrahedron& rest) {
  Mat3 pF = Mat3::Zero(), mean_F = Mat3::Zero();
  Eigen::Vector3d pg = Eigen::Vector3d::Zero();
  for (int s = 0; s < 4; ++s) {
    pF += t.subs[s].p * t.subs[s].F;
    mean_F += 0.25 * t.subs[s].F;
    pg += 4 * t.subs[s].p * rest.gradients.col(s);
  }
  add_cofactor_derivative(t.A, pF);
  for (int i = 0; i < 3; ++i) {
    const int k = (i + 1) % 3, m = (i + 2) % 3;
    const Eigen::Vector3d c = pg.cross(mean_F.row(m).transpose());
    for (int j = 0; j < 3; ++j) {
      t.AG(i + 3 * j, k) += c(j);
      t.AG(k + 3 * j, i) -= c(j);
    }
  }
}

/// ∫ U*(p), ∫ N_a U*′(p) and its derivative ∫ N_a U*″(p) N_b, at four points that are exact for a quadratic U* (Hammer, Marlowe, Stroud
/// 1956).
struct DilationTerm {
  double energy = 0;
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
    term.energy += volume / 4 * materials::dual(energy, N.dot(p), value);
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

Eigen::Matrix<double, 3, 4> sub_centroids(const Eigen::Matrix<double, 3, 4>& X) {
  const Eigen::Vector3d sum = X.rowwise().sum();
  Eigen::Matrix<double, 3, 4> centroids;
  for (int s = 0; s < 4; ++s) centroids.col(s) = (sum - X.col(s) + sum / 4) / 4;  // three corners and the barycentre
  return centroids;
}

ElementSystem mini_element(const Tetrahedron& rest, const Material& material, ElementState& state, const BodyForce& body_force, Condensation* kept) {
  ElementSystem system;
  Trial trial;
  system.fault = solve_bubble(rest, material, state, body_force, trial);
  if (system.fault != ElementFault::none) return system;
  if (material.law.kinematics == Kinematics::finite) add_geometric_stiffness(trial, rest);
  const VolumeSums sums = volume_sums(trial, rest);
  const double quarter = rest.volume / 4;
  const Eigen::Vector4d p(state.nodal(3), state.nodal(7), state.nodal(11), state.nodal(15));
  const DilationTerm dilation = dilation_term(material.volume_energy(mean_modulus(state)), p, rest.volume);
  const Eigen::Matrix4d pp = -dilation.derivative;
  const Eigen::Vector4d rp = quarter * sums.rp - dilation.value;

  // Blocks of the lower triangle, node by node, before condensation; and the bubble's columns.
  auto& K = system.tangent;
  Eigen::Matrix<double, 16, 3> Kb;
  for (int a = 0; a < 4; ++a) {
    const Eigen::Vector3d ga = quarter * rest.gradients.col(a);
    const Mat93 AGa = along_columns<9>(ga, trial.A);
    const Eigen::Matrix<double, 3, 4> up = along_rows<4>(ga, sums.cw);
    for (int b = 0; b < 4; ++b) {
      if (b >= a) {
        K.block<3, 3>(4 * b, 4 * a) = along_rows<3>(rest.gradients.col(b), AGa);
        K(4 * b + 3, 4 * a + 3) = pp(b, a);
        K.block<1, 3>(4 * b + 3, 4 * a) = up.col(b).transpose();
      }
      if (b <= a) K.block<3, 1>(4 * a, 4 * b + 3) = up.col(b);
    }
    Kb.middleRows<3>(4 * a) = along_rows<3>(ga, trial.AG);
    Kb.row(4 * a + 3) = quarter * sums.bp.col(a).transpose();
    system.residual.segment<3>(4 * a) = along_rows<1>(ga, trial.P);
    for (int s = 0; s < 4; ++s) system.residual.segment<3>(4 * a) -= quarter * mean_weight(a, s) * body_force.col(s);
    system.residual(4 * a + 3) = rp(a);
  }

  // Condensation: K − K_qb K_bb⁻¹ K_bq; r − K_qb K_bb⁻¹ r_b, the bubble's last step.
  const Mat3 inverse = (quarter * trial.bb).inverse();
  if (kept) *kept = {Kb, inverse};
  const Eigen::Vector3d step = -inverse * (quarter * trial.rb);
  state.bubble += step;
  system.residual += Kb * step;
  const Eigen::Matrix<double, 3, 16> X = inverse * Kb.transpose();
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b <= a; ++b) {
      K.block<4, 4>(4 * a, 4 * b) -= Kb.middleRows<4>(4 * a).lazyProduct(X.middleCols<4>(4 * b));
      if (b < a) K.block<4, 4>(4 * b, 4 * a) = K.block<4, 4>(4 * a, 4 * b).transpose();
    }
  system.energy = quarter * trial.W - dilation.energy;
  system.internal_force = quarter * trial.stress_size * rest.gradients.norm();
  return system;
}

CatalogueEntry mini_tetrahedron_entry() {
  return {"element",
          "mini_tetrahedron",
          "P1+/P1: linear displacement with a bubble, linear pressure; stable for incompressible tissue",
          "Arnold, Brezzi, Fortin 1984, Calcolo 21:337",
          {}};
}

}  // namespace palpate::elements
