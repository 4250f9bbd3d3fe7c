// The mini-element: no force in rigid motion, tangent by differences, constant field on a distorted patch.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <random>

#include <tests/verify/shapes.hpp>

using namespace palpate;
using namespace palpate::verify;
using elements::BodyForce;
using elements::ElementState;

namespace {

elements::Tetrahedron some_tetrahedron() {
  Eigen::Matrix<double, 3, 4> X;
  X << 0, 1.1, 0.2, 0.1, 0, 0.1, 1.3, 0.2, 0, -0.1, 0.1, 0.9;
  return elements::tetrahedron(X);
}

std::vector<elements::Material> all_materials() {
  std::vector<elements::Material> list;
  for (const auto& law : materials::all()) {
    std::vector<double> values;
    for (const auto& p : law.entry.parameters) values.push_back(p.typical);
    list.push_back(material(law.entry.name, values));
    list.back().bulk_modulus = std::min(list.back().bulk_modulus, 3.0);
  }
  list.push_back(list.back());
  list.back().bulk_modulus = 0.02;
  list.back().volume_stiffening = {0.3, 2};
  return list;
}

ElementState some_state(double size) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  ElementState state;
  for (int i = 0; i < 16; ++i) state.nodal(i) = size * unit(random) * (i % 4 == 3 ? 0.01 : 1);
  state.bubble.setZero();
  return state;
}

}  // namespace

TEST(MiniTetrahedron, RigidMotionMakesNoForce) {
  Eigen::Matrix<double, 3, 4> X;
  X << 0, 1.1, 0.2, 0.1, 0, 0.1, 1.3, 0.2, 0, -0.1, 0.1, 0.9;
  const Eigen::Matrix3d Q = Eigen::AngleAxisd(0.8, Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  for (const auto& m : all_materials()) {
    if (m.law.kinematics == materials::Kinematics::small) continue;  // turns only by small angles
    ElementState state;
    state.bubble.setZero();
    for (int a = 0; a < 4; ++a) state.nodal.segment<4>(4 * a) << (Q - Eigen::Matrix3d::Identity()) * X.col(a) + Vector3d(5, 6, 7), 0.0;
    const auto system = elements::mini_element(some_tetrahedron(), m, state, BodyForce::Zero());
    EXPECT_LE(system.residual.norm(), 1e-13) << m.law.entry.name;
  }
}

TEST(MiniTetrahedron, TangentIsTheResidualsDerivative) {
  const double h = 1e-6;
  for (const auto& m : all_materials()) {
    const ElementState at = some_state(0.15);
    ElementState solved = at;
    const auto system = elements::mini_element(some_tetrahedron(), m, solved, BodyForce::Zero());
    ASSERT_EQ(system.fault, elements::ElementFault::none);
    for (int i = 0; i < 16; ++i) {
      ElementState plus = solved, minus = solved;
      plus.nodal(i) += h;
      minus.nodal(i) -= h;
      const auto rp = elements::mini_element(some_tetrahedron(), m, plus, BodyForce::Zero()).residual;
      const auto rm = elements::mini_element(some_tetrahedron(), m, minus, BodyForce::Zero()).residual;
      EXPECT_LE(((rp - rm) / (2 * h) - system.tangent.col(i)).norm(), 1e-7 * (1 + system.tangent.col(i).norm())) << m.law.entry.name << i;
    }
    EXPECT_LE((system.tangent - system.tangent.transpose()).norm(), 1e-12 * system.tangent.norm());
  }
}

TEST(MiniTetrahedron, AnInvertedElementIsReported) {
  ElementState state;
  state.nodal.setZero();
  state.bubble.setZero();
  state.nodal(14) = -3;  // node 3 through the opposite face
  const auto system = elements::mini_element(some_tetrahedron(), all_materials().front(), state, BodyForce::Zero());
  EXPECT_EQ(system.fault, elements::ElementFault::inverted);
}
