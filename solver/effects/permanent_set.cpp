// F_e = F U_p⁻¹: of a strain beyond `yield` the part `fraction` stays. The permanent stretch U_p grows, without change of volume, along
// the elastic strain h = dev ln √(F_eᵀ F_e) by fraction · (ε_e − yield) − (1 − fraction) α, where ε_e = √⅔ |h| and α is the permanent
// strain so far; it is written at the end of a step. (Yield in strain space: Naghdi and Trapp 1975, Int. J. Eng. Sci. 13:785.)
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/effects/second_stress.hpp>

#include <Eigen/Eigenvalues>

namespace palpate::effects {
namespace {

// Memory: U_p − I (six numbers), α. Parameters: fraction, yield.
Mat3 permanent(std::span<const double> memory) { return Mat3::Identity() + tensor(memory.data()); }

/// P = P_e U_p⁻¹, A_ijkl = A_e,imkn U⁻¹_mj U⁻¹_nl: with U = I nothing is touched.
Response respond(const Inner& inner, const Point& point, std::span<const double> memory, std::span<const double>) {
  if (memory[6] == 0) return inner(point.F);
  if (point.kinematics == materials::Kinematics::small) {
    return inner(point.F - tensor(memory.data()));
  }
  const Mat3 inverse = permanent(memory).inverse();
  const Response e = inner(point.F * inverse);
  Response r{e.W, e.P * inverse, Mat9::Zero()};
  if (!point.wants_tangent()) return r;
  Mat9 T;  // ∂F_e/∂F: (i + 3 m, k + 3 l) = δ_ik U⁻¹_lm
  T.setZero();
  for (int m = 0; m < 3; ++m)
    for (int l = 0; l < 3; ++l) T.block<3, 3>(3 * m, 3 * l).diagonal().setConstant(inverse(l, m));
  r.A = T.transpose() * e.A * T;
  return r;
}

void remember(const Inner&, const Point& point, std::span<double> memory, std::span<const double> p) {
  const bool small = point.kinematics == materials::Kinematics::small;
  const Mat3 U = permanent(memory);
  const Mat3 F = small ? Mat3(point.F - tensor(memory.data())) : Mat3(point.F * U.inverse());
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(small ? Mat3(0.5 * (F + F.transpose())) : Mat3(F.transpose() * F));
  Eigen::Vector3d h = small ? eigen.eigenvalues() : Eigen::Vector3d(0.5 * eigen.eigenvalues().array().log());
  h.array() -= h.mean();
  const double strain = std::sqrt(2.0 / 3) * h.norm();
  const double growth = p[0] * (strain - p[1]) - (1 - p[0]) * memory[6];
  if (!(growth > 0)) return;
  const Eigen::Vector3d flow = growth / strain * h;
  const Mat3& axes = eigen.eigenvectors();
  if (small) {
    Eigen::Map<Vec6>(memory.data()) += six(axes * flow.asDiagonal() * axes.transpose());
  } else {  // U_p² ← U_p exp(2 flow) U_p: the square of the stretch of exp(flow) U_p
    const Mat3 square = U * axes * (2 * flow).array().exp().matrix().asDiagonal() * axes.transpose() * U;
    const Eigen::SelfAdjointEigenSolver<Mat3> root(0.5 * (square + square.transpose()));
    Eigen::Map<Vec6>(memory.data()) = six(root.operatorSqrt() - Mat3::Identity());
  }
  memory[6] += growth;
}

}  // namespace

Effect permanent_set() {
  return {{"effect", "permanent_set", "of a strain beyond a yield strain a part stays, also after rest",
           "Naghdi and Trapp 1975, Int. J. Eng. Sci. 13:785 (yield in strain space)",
           {{"fraction", "1", {0, 0.9}, 0.1, "part of the strain beyond yield that stays"},
            {"yield", "1", {0, 10}, 0.05, "equivalent logarithmic strain up to which all comes back"}}},
          false,
          {[](std::span<const double>) { return 7; }, respond, remember}};
}

}  // namespace palpate::effects
