// 2/√λ with λ ≤ (tr G⁸)^(1/8), G = R B M⁻¹ Bᵀ Rᵀ · volume, 3 × 3, D = Rᵀ R the law's stiffness in plane stress.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Dense>

#include <solver/explicit/wall.hpp>

namespace palpate::explicit_shell {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;

/// How much stiffer than at rest the law is here: the largest ∂τ_i/∂ln λ_i at the two faces and in the middle, by differences.
template <class Law>
double stiffening(const Law& law, const elements::ShellStrain<double>& s, double thickness) {
  const double mu = law.shear_modulus(), nu = law.poisson(), at_rest = 2 * mu / (1 - nu);
  double largest = 1;
  for (double place : {-1.0, 0.0, 1.0}) {
    const auto C = elements::at_layer(s, place * thickness / 2);
    const double m = (C.xx + C.yy) / 2, r = std::hypot((C.xx - C.yy) / 2, C.xy);
    const double x[2] = {m + r, std::max(m - r, 1e-3)};
    for (int i = 0; i < 2; ++i) {
      const double d = 1e-4, up = x[i] * std::exp(2 * d), down = x[i] * std::exp(-2 * d);
      const auto high = i == 0 ? law(materials::InPlane<double>{up, x[1], 0.0}) : law(materials::InPlane<double>{x[0], up, 0.0});
      const auto low = i == 0 ? law(materials::InPlane<double>{down, x[1], 0.0}) : law(materials::InPlane<double>{x[0], down, 0.0});
      const double slope = i == 0 ? (high.S.xx * up - low.S.xx * down) : (high.S.yy * up - low.S.yy * down);
      largest = std::max(largest, slope / (2 * d) / at_rest);
    }
  }
  return largest;
}

/// Rows of R for strain (xx, yy, engineering xy): the eigenvectors of D by the roots of its eigenvalues.
Matrix3d root_of_stiffness(double mu, double nu) {
  const double both = std::sqrt(2 * mu * (1 + nu) / (1 - nu) / 2), apart = std::sqrt(2 * mu / 2);
  Matrix3d R;
  R << both, both, 0, apart, -apart, 0, 0, 0, std::sqrt(mu);
  return R;
}

double largest_bound(const Matrix3d& G) {
  const Matrix3d G2 = G * G, G4 = G2 * G2;
  return std::pow((G4 * G4).trace(), 1.0 / 8);
}

}  // namespace

double stable_step(const Wall& wall, const WallState& state, int t) {
  const auto rest = lane(wall.packs[t / 4].rest, t % 4);
  const auto s = elements::shell_strain(rest, now(wall, state, t));
  const double area = s.twice_area / 2, thickness = rest.thickness * rest.area / area;
  double mu = 0, nu = 0, stiffer = 1;
  std::visit([&](const auto& law) { mu = law.shear_modulus(), nu = law.poisson(), stiffer = stiffening(law, s, rest.thickness); }, wall.law);
  // the triangle as it is now, in its own plane
  const auto length = [](const elements::Vector<double>& a) { return std::sqrt(dot(a, a)); };
  const double x1 = length(s.edge[2]), x2 = -dot(s.edge[1], s.edge[2]) / x1, y2 = 2 * area / x1;
  const Vector2d g1(1 / x1, -x2 / (x1 * y2)), g2(0, 1 / y2), g[3] = {-g1 - g2, g1, g2};
  const double mass = wall.mass_factor[t] * wall.density * rest.thickness * rest.area / 3;
  const double inertia = mass * std::max(rest.thickness * rest.thickness / 12, rest.area / 8);
  Matrix3d membrane = Matrix3d::Zero(), bending = Matrix3d::Zero();
  Eigen::Matrix<double, 3, 3> by_normal;  // angles of the three edges by the corners' normal displacements
  for (int k = 0; k < 3; ++k) {
    Eigen::Matrix<double, 3, 2> B;
    B << g[k].x(), 0, 0, g[k].y(), g[k].y(), g[k].x();
    membrane += B * B.transpose() / mass;
    for (int c = 0; c < 3; ++c) by_normal(k, c) = g[k].dot(g[c]) / g[k].norm();
  }
  Eigen::Matrix<double, 3, 3> Bk;  // curvature by the three angles: (l/A) m ⊗ m, m = −g/|g|
  for (int k = 0; k < 3; ++k) {
    const Vector2d m = -g[k].normalized();
    Bk.col(k) = s.f_slope[k] * 2 * g[k].norm() * Eigen::Vector3d(m.x() * m.x(), m.y() * m.y(), 2 * m.x() * m.y());
  }
  bending = Bk * (Matrix3d::Identity() / inertia + by_normal * by_normal.transpose() / mass) * Bk.transpose() * (thickness * thickness / 12);
  const Matrix3d R = root_of_stiffness(mu, nu);
  const double volume = rest.area * rest.thickness * stiffer * (wall.stiffening.empty() ? 1 : wall.stiffening[t]);
  const double most = std::max(largest_bound(R * membrane * R.transpose()), largest_bound(R * bending * R.transpose())) * volume;
  return 2 / std::sqrt(most);
}

}  // namespace palpate::explicit_shell
