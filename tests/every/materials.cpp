// Every law of the catalogue: no energy at rest, objectivity, P = ∂W/∂F, A = ∂P/∂F, symmetric tangent, a full entry.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <solver/materials/law.hpp>

using namespace palpate::materials;

namespace palpate::materials {
/// The name of a test shows this.
void PrintTo(const Law& tested, std::ostream* out) { *out << tested.entry.name; }
}  // namespace palpate::materials

namespace {

std::vector<double> typical(const Law& law) {
  std::vector<double> values;
  for (const auto& p : law.entry.parameters) values.push_back(p.typical);
  return values;
}

const Mat3 turn = Eigen::AngleAxisd(0.9, Eigen::Vector3d(1, 2, -0.7).normalized()).toRotationMatrix();
const Mat3 other_turn = Eigen::AngleAxisd(-2.1, Eigen::Vector3d(-0.3, 1, 1.4).normalized()).toRotationMatrix();

Mat3 stretched(double x, double y, double z) { return turn * Eigen::Vector3d(x, y, z).asDiagonal() * other_turn; }

const std::vector<double> apart = {0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-4};  ///< relative differences of principal stretches

/// No distortion, or next to none.
std::vector<Mat3> undistorted() {
  std::vector<Mat3> list = {Mat3::Identity()};
  for (double d : apart) list.push_back(stretched(1.1, 1.1 * (1 + d), 1.1 * (1 - 2 * d)));
  return list;
}

/// Deformations of moderate and large size, two equal or nearly equal principal stretches among them; det F > 0.
std::vector<Mat3> distorted() {
  Mat3 general, shear = Mat3::Identity(), uniaxial = Mat3::Zero();
  general << 1.3, 0.2, -0.1, 0.05, 0.8, 0.3, -0.2, 0.1, 1.1;
  shear(0, 1) = 0.7;
  uniaxial.diagonal() << 1.5, 1 / std::sqrt(1.5), 1 / std::sqrt(1.5);
  std::vector<Mat3> list = {
      general, shear, uniaxial, 0.6 * general, stretched(2.5, 0.5, 0.9), stretched(0.35, 1.7, 1.6), stretched(3, 0.4, 0.6)};
  for (double d : apart)
    for (const Mat3& F : {stretched(1.3, 1.3 * (1 + d), 0.7), stretched(0.8, 0.8 * (1 - d), 1.6)}) list.push_back(F);
  return list;
}

std::vector<Mat3> deformations() {
  auto list = undistorted();
  for (const auto& F : distorted()) list.push_back(F);
  return list;
}

/// ∂f/∂F_k by differences of fourth order.
template <class Function>
auto derivative(const Function& f, const Mat3& F, int k) {
  const double h = 5e-5;
  const auto at = [&](double step) {
    Mat3 moved = F;
    moved(k % 3, k / 3) += step;
    return f(moved);
  };
  return decltype(f(F))((8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h));
}

/// Change of stress from rest, by a small distortion (positive) or its opposite (negative).
Vec9 change_from_rest(const Law& law, double size) {
  const Mat3 F = Mat3::Identity() + size * Mat3(Eigen::Vector3d(1, 0.3, -0.8).asDiagonal());
  const Mat3 P = law.respond(F, typical(law)).P;
  return Eigen::Map<const Vec9>(P.data());
}

/// Fibres that are slack in compression give the stress a kink at rest: no tangent there but that of either side.
bool has_kink_at_rest(const Law& law) {
  const Vec9 forward = change_from_rest(law, 1e-6), backward = -change_from_rest(law, -1e-6);
  return (forward - backward).norm() > 1e-2 * forward.norm();
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
  const Law& law = GetParam();
  const auto p = typical(law);
  for (const auto& F : has_kink_at_rest(law) ? distorted() : deformations()) {
    const auto r = law.respond(F, p);
    const double scale = r.A.norm();
    for (int k = 0; k < 9; ++k) {
      const double dW = derivative([&](const Mat3& at) { return law.respond(at, p).W; }, F, k);
      const Mat3 dP = derivative([&](const Mat3& at) { return law.respond(at, p).P; }, F, k);
      EXPECT_LE(std::abs(dW - r.P(k % 3, k / 3)), 1e-9 * scale) << F;
      EXPECT_LE((Eigen::Map<const Vec9>(dP.data()) - r.A.col(k)).norm(), 1e-9 * scale) << F;
    }
  }
}

TEST_P(EveryMaterial, TangentIsSymmetric) {
  for (const auto& F : deformations()) {
    const auto A = GetParam().respond(F, typical(GetParam())).A;
    EXPECT_LE((A - A.transpose()).norm(), 1e-12 * A.norm());
  }
}

TEST_P(EveryMaterial, TangentAtRestIsThatOfASide) {
  const double size = 1e-6;
  const Mat3 direction = Eigen::Vector3d(1, 0.3, -0.8).asDiagonal();
  const Vec9 told = size * GetParam().respond(Mat3::Identity(), typical(GetParam())).A * Eigen::Map<const Vec9>(direction.data());
  const double forward = (change_from_rest(GetParam(), size) - told).norm(),
               backward = (change_from_rest(GetParam(), -size) + told).norm();
  EXPECT_LE(std::min(forward, backward), 1e-4 * told.norm());  // one-sided differences are of first order
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
