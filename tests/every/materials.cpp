// Every law of the catalogue: no energy at rest, objectivity, P = ∂W/∂F, A = ∂P/∂F, symmetric tangent, a full entry.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <solver/materials/law.hpp>

using namespace palpate::materials;

namespace {

std::vector<double> typical(const Law& law) {
  std::vector<double> values;
  for (const auto& p : law.entry.parameters) values.push_back(p.typical);
  return values;
}

/// Deformations of moderate and large size, equal principal stretches among them; det F > 0.
std::vector<Mat3> deformations() {
  Mat3 general, shear = Mat3::Identity(), uniaxial = Mat3::Zero();
  general << 1.3, 0.2, -0.1, 0.05, 0.8, 0.3, -0.2, 0.1, 1.1;
  shear(0, 1) = 0.7;
  uniaxial.diagonal() << 1.5, 1 / std::sqrt(1.5), 1 / std::sqrt(1.5);
  return {Mat3::Identity(), general, shear, uniaxial, 0.6 * general};
}

class EveryMaterial : public testing::TestWithParam<Law> {};

}  // namespace

TEST_P(EveryMaterial, RestHasNoEnergyAndNoStress) {
  const auto r = GetParam().respond(Mat3::Identity(), typical(GetParam()));
  EXPECT_LE(std::abs(r.W), 1e-14);
  EXPECT_LE(r.P.norm(), 1e-14);
}

TEST_P(EveryMaterial, InitialShearModulusIsTheTangents) {
  const auto p = typical(GetParam());
  const auto r = GetParam().respond(Mat3::Identity(), p);
  EXPECT_NEAR(r.A(3, 3), GetParam().shear_modulus(p), 1e-10);  // ∂P_01/∂F_01
}

TEST_P(EveryMaterial, IsObjective) {
  if (GetParam().kinematics == Kinematics::small) return;  // the one law exempt: physics.md §1
  const Mat3 Q = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  for (const auto& F : deformations()) {
    const auto at = GetParam().respond(F, typical(GetParam())), turned = GetParam().respond(Q * F, typical(GetParam()));
    EXPECT_LE(std::abs(at.W - turned.W), 1e-12 * (1 + at.W));
    EXPECT_LE((Q * at.P - turned.P).norm(), 1e-12 * (1 + at.P.norm()));
  }
}

TEST_P(EveryMaterial, StressIsTheGradientAndTangentItsDerivative) {
  const auto p = typical(GetParam());
  const double h = 1e-5;
  for (const auto& F : deformations()) {
    const auto r = GetParam().respond(F, p);
    for (int k = 0; k < 9; ++k) {
      Mat3 plus = F, minus = F;
      plus(k % 3, k / 3) += h;
      minus(k % 3, k / 3) -= h;
      const auto rp = GetParam().respond(plus, p), rm = GetParam().respond(minus, p);
      const double scale = r.A.norm();
      EXPECT_LE(std::abs((rp.W - rm.W) / (2 * h) - r.P(k % 3, k / 3)), 1e-8 * scale);
      const Mat3 dP = (rp.P - rm.P) / (2 * h);
      EXPECT_LE((Eigen::Map<const Vec9>(dP.data()) - r.A.col(k)).norm(), 1e-8 * scale);
    }
    EXPECT_LE((r.A - r.A.transpose()).norm(), 1e-12 * r.A.norm());
  }
}

TEST_P(EveryMaterial, EntryIsComplete) {
  const auto& entry = GetParam().entry;
  EXPECT_EQ(entry.kind, "material");
  EXPECT_FALSE(entry.sentence.empty() || entry.reference.empty() || entry.parameters.empty());
  for (const auto& p : entry.parameters) {
    EXPECT_FALSE(p.name.empty() || p.unit.empty() || p.meaning.empty());
    EXPECT_TRUE(p.range.contains(p.typical));
  }
}

INSTANTIATE_TEST_SUITE_P(Catalogue, EveryMaterial, testing::ValuesIn(all()), [](const auto& instance) { return instance.param.entry.name; });
