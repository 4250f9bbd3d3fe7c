// Patch test: a linear displacement on the boundary of a distorted mesh gives a constant field inside (Irons and Razzaque 1972).
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <random>

#include <solver/implicit/equilibrium.hpp>
#include <tests/verify/shapes.hpp>

using namespace palpate;
using namespace palpate::verify;

namespace {

/// F − I of the patch; for incompressible laws det F = 1 (or tr = 0 at small strain).
Eigen::Matrix3d gradient(const elements::Material& m) {
  Eigen::Matrix3d H;
  H << 0.08, 0.03, -0.02, 0.01, -0.05, 0.04, 0.02, -0.03, 0.02;
  if (std::isfinite(m.bulk_modulus)) return H;
  if (m.law.kinematics == materials::Kinematics::small) return H - H.trace() / 3 * Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d F = Eigen::Matrix3d::Identity() + H;
  return F / std::cbrt(F.determinant()) - Eigen::Matrix3d::Identity();
}

void run_patch(elements::Material m) {
  auto model = brick(uniform(0, 1, 3), uniform(0, 1.2, 3), uniform(0, 0.9, 3));
  std::mt19937 random(11);
  std::uniform_real_distribution<double> move(-0.06, 0.06);
  std::vector<char> on_boundary(model.points.size(), 0);
  for (const auto& f : model.faces)
    for (int node : f) on_boundary[node] = 1;
  const auto H = gradient(m);
  for (std::size_t i = 0; i < model.points.size(); ++i) {
    if (!on_boundary[i]) model.points[i] += Vector3d(move(random), move(random), move(random));
    const Vector3d u = H * model.points[i];
    if (on_boundary[i])
      for (int c = 0; c < 3; ++c) model.prescribed.push_back({int(i), c, u(c)});
  }
  // With the whole boundary prescribed an incompressible law leaves the pressure free by a constant: give it a bulk modulus.
  if (!std::isfinite(m.bulk_modulus)) m.bulk_modulus = 1000 * m.shear_modulus();
  model.materials = {m};
  implicit::NewtonLimits limits;
  limits.tolerance = 1e-13;
  implicit::Equilibrium equilibrium(model, 1, limits);
  implicit::State state = implicit::rest_state(model);
  ASSERT_TRUE(equilibrium.find(state, 1)) << equilibrium.trouble().cause;
  const double J = m.law.kinematics == materials::Kinematics::small ? 1 + H.trace() : (Eigen::Matrix3d::Identity() + H).determinant();
  const double p = m.bulk_modulus * (J - 1) + 4 * m.volume_stiffening[0] * std::pow(J - 1, 3) +
                   6 * m.volume_stiffening[1] * std::pow(J - 1, 5);
  const double stress = m.shear_modulus();
  for (std::size_t i = 0; i < model.points.size(); ++i) {
    EXPECT_LE((state.displacement(i) - H * model.points[i]).norm(), 1e-10);
    EXPECT_LE(std::abs(state.pressure(i) - p), 1e-10 * std::max(std::abs(p), stress));
  }
  for (const auto& b : state.bubbles) EXPECT_LE(b.norm(), 1e-10);
}

}  // namespace

TEST(Patch, EveryLawCompressible) {
  run_patch(material("hooke_linear", {0.02, 0.3}));
  run_patch(material("hooke", {0.02, 0.3}));
  run_patch(material("neo_hookean", {0.0067}));
  run_patch(material("mooney_rivlin", {0.083, 0.0565}));
  run_patch(material("fung_demiray", {0.0067, 1.5}));
  run_patch(material("ogden", {0.004, 3, 0.002, -4, 0.0007, 8}));
  run_patch(material("hgo", {0.0067, 0.004, 1.5, 35, 1, 0, 0, 0, 1, 0}));
  auto yeoh = material("yeoh", {0.0034, 0.0012, 0.0005});
  run_patch(yeoh);
  yeoh.bulk_modulus = 0.05;
  yeoh.volume_stiffening = {2, 300};
  run_patch(yeoh);
}
