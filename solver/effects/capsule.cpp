// W = E h/6 (I1 + 1/j² − 3) + T (j − 1) per rest area, I1 = tr C and j² = det C of the surface: an incompressible neo-Hookean skin of Young's
// modulus E and thickness h, and a tension T that is the same however far it is stretched. It has no bending stiffness and does not
// wrinkle. (Skin: Green and Adkins 1970, Large Elastic Deformations, §4.10; Laplace's p = 2 T/r.)
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/effects/effect.hpp>

namespace palpate::effects {
namespace {

// Parameters: E h, T.
SurfaceResponse respond(const Eigen::Matrix<double, 3, 2>& F, std::span<const double> p) {
  const Eigen::Matrix2d C = F.transpose() * F;
  const double D = C.determinant(), j = std::sqrt(D);
  Eigen::Matrix2d cof;
  cof << C(1, 1), -C(0, 1), -C(0, 1), C(0, 0);
  const Eigen::Matrix<double, 3, 2> g = F * cof;  // ½ ∂D/∂F
  const double slope = -p[0] / 3 / (D * D) + p[1] / j, curvature = 2 * p[0] / 3 / (D * D * D) - p[1] / 2 / (D * j);  // 2 ∂W/∂D; its ∂/∂D
  SurfaceResponse r;
  r.W = p[0] / 6 * (C.trace() + 1 / D - 3) + p[1] * (j - 1);
  r.N = p[0] / 3 * F + slope * g;
  const Eigen::Map<const Eigen::Matrix<double, 6, 1>> G(g.data());
  r.A = 2 * curvature * G * G.transpose();
  r.A.diagonal().array() += p[0] / 3;
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
  const auto f = F.col(0), h = F.col(1);
  const Eigen::Matrix3d fh = 2 * f * h.transpose() - C(0, 1) * I - h * f.transpose();  // ∂(f C22 − h C12)/∂h
  r.A.topLeftCorner<3, 3>() += slope * (C(1, 1) * I - h * h.transpose());
  r.A.bottomRightCorner<3, 3>() += slope * (C(0, 0) * I - f * f.transpose());
  r.A.topRightCorner<3, 3>() += slope * fh;
  r.A.bottomLeftCorner<3, 3>() += slope * fh.transpose();
  return r;
}

}  // namespace

Effect capsule() {
  return {.entry = {"effect", "capsule", "a thin stiff skin on the organ: wide dimples, more for small tools", "Green and Adkins 1970, Large Elastic Deformations, section 4.10",
                    {{"E_h", "N/mm", {0, 1e3}, 0.02, "Young's modulus times thickness of the skin"},
                     {"tension", "N/mm", {0, 1e3}, 0.001, "tension in the skin from the start, at any stretch"}}},
          .fallbacks = {0},
          .layer = {respond}};
}

}  // namespace palpate::effects
