// Laws that contain one another agree; the fibres' frame; the dilation that a pressure calls for.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <tests/verify/shapes.hpp>

using namespace palpate;
using namespace palpate::verify;
using materials::Mat3;
using materials::Response;

namespace {

Mat3 turn(double angle, const Vector3d& axis) { return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix(); }

/// Equal, nearly equal, and far principal stretches, with axes away from the frame's.
std::vector<Mat3> deformations() {
  std::vector<Mat3> list = {Mat3::Identity()};
  const Mat3 Q = turn(0.9, {1, 2, -0.7}), R = turn(-2.1, {-0.3, 1, 1.4});
  for (double apart : {0.0, 1e-15, 1e-13, 1e-11, 1e-9, 1e-7, 1e-5, 1e-3, 0.1, 2.0}) {
    list.push_back(Q * Vector3d(1.2, 1.2 * (1 + apart), 0.7).asDiagonal() * R);
    list.push_back(Q * Vector3d(0.8, 0.8 * (1 + apart), 0.8 * (1 + 2 * apart)).asDiagonal() * R);
    list.push_back(Vector3d(1 + apart, 1, 1).asDiagonal());
  }
  return list;
}

Response respond(const char* law, const std::vector<double>& parameters, const Mat3& F) {
  return material(law, parameters).respond(F);
}

void expect_equal(const Response& a, const Response& b, double tolerance) {
  const double scale = b.A.norm();
  EXPECT_LE(std::abs(a.W - b.W), tolerance * scale);
  EXPECT_LE((a.P - b.P).norm(), tolerance * scale);
  EXPECT_LE((a.A - b.A).norm(), tolerance * scale);
}

}  // namespace

TEST(Laws, OgdenWithPowerTwoIsNeoHookean) {
  for (const auto& F : deformations())
    expect_equal(respond("ogden", {0.0067, 2, 0, 1, 0, 1}, F), respond("neo_hookean", {0.0067}, F), 1e-13);
}

TEST(Laws, OgdenWithPowersTwoAndMinusTwoIsMooneyRivlin) {
  for (const auto& F : deformations())
    expect_equal(respond("ogden", {0.01, 2, 0, 5, 0.006, -2}, F), respond("mooney_rivlin", {0.005, 0.003}, F), 1e-13);
}

TEST(Laws, OgdenGoesOverIntoLogarithmicStrain) {
  for (const auto& F : deformations()) {
    expect_equal(respond("ogden", {0.02 / 3, 0, 0, 1, 0, 1}, F), respond("hooke", {0.02, 0.5}, F), 1e-13);
    expect_equal(respond("ogden", {0.02 / 3, 1e-9, 0, 1, 0, 1}, F), respond("hooke", {0.02, 0.5}, F), 1e-8);
  }
}

TEST(Laws, YeohWithOneTermIsNeoHookean) {
  for (const auto& F : deformations())
    expect_equal(respond("yeoh", {0.00335, 0, 0}, F), respond("neo_hookean", {0.0067}, F), 1e-15);
}

TEST(Laws, HgoWithoutFibresIsNeoHookean) {
  for (const auto& F : deformations())
    expect_equal(respond("hgo", {0.0067, 0, 1.5, 35, 1, 2, 0, 0, 1, 3}, F), respond("neo_hookean", {0.0067}, F), 1e-15);
}

TEST(Laws, HgoFibresAreSlackInCompression) {
  const std::vector<double> along_x = {0.0067, 0.02, 1.5, 0, 1, 0, 0, 0, 1, 0};
  for (double stretch : {0.5, 0.9, 0.999, 1.0})
    expect_equal(respond("hgo", along_x, Vector3d(stretch, 1, 1 / stretch).asDiagonal()),
                 respond("neo_hookean", {0.0067}, Vector3d(stretch, 1, 1 / stretch).asDiagonal()), 1e-15);
  const Mat3 stretched = Vector3d(1.001, 1, 1 / 1.001).asDiagonal();
  EXPECT_GT(respond("hgo", along_x, stretched).P(0, 0), 1.5 * respond("neo_hookean", {0.0067}, stretched).P(0, 0));
}

TEST(Laws, HgoTurnsWithItsFibres) {  // fibres turned by R in the rest shape: W(F; R a) = W(F R; a)
  Mat3 F;
  F << 1.3, 0.2, -0.1, 0.05, 0.8, 0.3, -0.2, 0.1, 1.1;
  const Mat3 R = turn(1.2, {1, -0.4, 0.8});
  const Vector3d axis = 3 * R.col(0), side = 0.5 * R.col(1) - 7 * R.col(0);
  const Response turned = respond("hgo", {0.0067, 0.02, 1.5, 35, axis.x(), axis.y(), axis.z(), side.x(), side.y(), side.z()}, F);
  const Response plain = respond("hgo", {0.0067, 0.02, 1.5, 35, 1, 0, 0, 0, 1, 0}, F * R);
  EXPECT_LE(std::abs(turned.W - plain.W), 1e-14 * plain.A.norm());
  EXPECT_LE((turned.P - plain.P * R.transpose()).norm(), 1e-14 * plain.A.norm());
}

TEST(Laws, HgoObjectsToAxesThatSpanNoPlane) {
  const auto objection = law_named("hgo").objection;
  EXPECT_TRUE(objection(std::vector<double>{1, 1, 1, 35, 1, 0, 0, 1, 1, 0}).empty());
  EXPECT_FALSE(objection(std::vector<double>{1, 1, 1, 35, 1, 2, 3, -2, -4, -6}).empty());
  EXPECT_FALSE(objection(std::vector<double>{1, 1, 1, 35, 0, 0, 0, 1, 0, 0}).empty());
}

TEST(VolumeEnergy, DilationIsTheInverseOfThePressure) {
  for (const materials::VolumeEnergy& U :
       {materials::VolumeEnergy{3, 0, 0}, {3, 5, 0}, {3, 0, 70}, {0.01, 40, 700}, {1e6, 1, 1e3}})
    for (double t : {-0.9, -0.3, -1e-6, 0.0, 1e-9, 0.02, 0.5, 4.0}) {
      const double p = U.bulk_modulus * t + 4 * U.s2 * std::pow(t, 3) + 6 * U.s3 * std::pow(t, 5);
      const double stiffness = U.bulk_modulus + 12 * U.s2 * std::pow(t, 2) + 30 * U.s3 * std::pow(t, 4);
      const auto found = materials::dilation(U, p);
      EXPECT_LE(std::abs(found.value - t), 1e-14 * std::abs(t));
      EXPECT_LE(std::abs(found.slope * stiffness - 1), 1e-13);
    }
  EXPECT_EQ(materials::dilation({}, 5).value, 0);
  EXPECT_EQ(materials::dilation({}, 5).slope, 0);
}
