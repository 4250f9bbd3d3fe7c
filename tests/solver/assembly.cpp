// Assembly: the sum of its elements; the same bytes, and the same faulty element, for any number of threads.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <random>

#include <tests/verify/shapes.hpp>
#include <solver/implicit/assembly.hpp>

using namespace palpate;
using namespace palpate::verify;

namespace {

implicit::Model some_block() {
  auto model = brick(uniform(-5, 5, 7), uniform(-5, 5, 6), uniform(0, 6, 5));
  std::mt19937 random(7);  // a mesh's nodes and elements come in any order
  std::vector<int> order(model.points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::shuffle(order.begin(), order.end(), random);
  const auto points = model.points;
  for (std::size_t i = 0; i < order.size(); ++i) model.points[order[i]] = points[i];
  for (auto& tet : model.tets)
    for (int& node : tet) node = order[node];
  std::shuffle(model.tets.begin(), model.tets.end(), random);
  model.faces = boundary(model);
  model.materials = {material("mooney_rivlin", {0.002, 0.00135})};
  model.body_force = [](const Vector3d& x) { return Vector3d(0, 1e-5 * x.x(), -1e-5); };
  return model;
}

implicit::State deformed(const implicit::Model& model) {
  auto state = implicit::rest_state(model);
  for (std::size_t i = 0; i < model.points.size(); ++i) {
    const auto& x = model.points[i];
    state.nodal.segment<4>(4 * i) << 0.1 * std::sin(x.y()), 0.03 * x.x() * x.z(), -0.02 * x.z() * x.z(), 1e-3 * x.x();
  }
  state.time = 1;
  return state;
}

struct Assembled {
  implicit::Equations equations;
  std::vector<double> tangent;
  std::vector<Vector3d> bubbles;
};

Assembled assembled(const implicit::Model& model, implicit::State state, int threads) {
  implicit::BlockMatrix tangent(static_cast<int>(model.points.size()), model.tets);
  Assembled a{implicit::Assembly(model, threads)(state, tangent), {}, {}};
  tangent.values(std::vector<char>(4 * model.points.size(), 0), a.tangent, threads);
  a.bubbles = state.bubbles;
  return a;
}

}  // namespace

TEST(Assembly, IsTheSumOfItsElements) {
  const auto model = some_block();
  const auto state = deformed(model);
  const auto whole = assembled(model, state, 2);
  ASSERT_EQ(whole.equations.fault, elements::ElementFault::none);
  implicit::BlockMatrix tangent(static_cast<int>(model.points.size()), model.tets);
  Eigen::VectorXd residual = Eigen::VectorXd::Zero(state.nodal.size());
  for (std::size_t e = 0; e < model.tets.size(); ++e) {
    Eigen::Matrix<double, 3, 4> X;
    for (int a = 0; a < 4; ++a) X.col(a) = model.points[model.tets[e][a]];
    elements::BodyForce force;
    for (int s = 0; s < 4; ++s) force.col(s) = model.body_force((X.rowwise().sum() * 1.25 - X.col(s)) / 4);
    auto local = implicit::element_state(model, state, e);
    const auto system = elements::mini_element(elements::tetrahedron(X), model.materials[0], local, force);
    for (int a = 0; a < 4; ++a) {
      residual.segment<4>(4 * model.tets[e][a]) += system.residual.segment<4>(4 * a);
      for (int b = 0; b < 4; ++b)
        if (model.tets[e][b] <= model.tets[e][a])
          tangent.add(model.tets[e][a], model.tets[e][b], system.tangent.block<4, 4>(4 * a, 4 * b));
    }
  }
  std::vector<double> values;
  tangent.values(std::vector<char>(4 * model.points.size(), 0), values);
  ASSERT_EQ(values.size(), whole.tangent.size());
  const auto as_vector = [](const std::vector<double>& v) { return Eigen::Map<const Eigen::VectorXd>(v.data(), v.size()); };
  EXPECT_LE((as_vector(values) - as_vector(whole.tangent)).norm(), 1e-14 * as_vector(values).norm());
  EXPECT_LE((residual - whole.equations.residual).norm(), 1e-14 * residual.norm());
}

TEST(Assembly, TheSameBytesForAnyNumberOfThreads) {
  auto model = some_block();
  model.tools = {contact::Tool{tool_named("ball"), {3.0}, -Vector3d::UnitZ(), {0.1, 0.2, 6}, 1.5, {}}};
  const auto state = deformed(model);
  const auto one = assembled(model, state, 1);
  ASSERT_EQ(one.equations.fault, elements::ElementFault::none);
  for (int threads : {2, 3, 8}) {
    const auto more = assembled(model, state, threads);
    EXPECT_EQ(one.equations.residual, more.equations.residual) << threads;
    EXPECT_EQ(one.equations.internal_force, more.equations.internal_force) << threads;
    EXPECT_EQ(one.tangent, more.tangent) << threads;
    EXPECT_EQ(one.bubbles, more.bubbles) << threads;
  }
}

TEST(Assembly, TheFirstFaultyElementIsTold) {
  const auto model = some_block();
  auto state = deformed(model);
  state.nodal.segment<3>(4 * model.tets[700][1]) += Vector3d(9, -9, 9);
  const auto one = assembled(model, state, 1);
  EXPECT_EQ(one.equations.fault, elements::ElementFault::inverted);
  for (int threads : {2, 3}) EXPECT_EQ(assembled(model, state, threads).equations.faulty_tet, one.equations.faulty_tet);
}

TEST(BlockMatrix, HeldUnknownsBecomeTheIdentity) {
  const auto model = some_block();
  auto state = deformed(model);
  implicit::BlockMatrix tangent(static_cast<int>(model.points.size()), model.tets);
  implicit::Assembly(model, 1)(state, tangent);
  std::vector<char> fixed(4 * model.points.size(), 0);
  for (std::size_t i = 0; i < fixed.size(); i += 3) fixed[i] = 1;
  std::vector<int> rows, columns;
  std::vector<double> free, held;
  tangent.coordinates(rows, columns);
  tangent.values(std::vector<char>(fixed.size(), 0), free);
  tangent.values(fixed, held, 3);
  ASSERT_EQ(rows.size(), held.size());
  Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(fixed.size(), -1, 2), y = Eigen::VectorXd::Zero(fixed.size());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const int i = rows[k] - 1, j = columns[k] - 1;
    EXPECT_EQ(held[k], fixed[i] || fixed[j] ? double(i == j) : free[k]);
    y(i) += free[k] * x(j);
    if (i != j) y(j) += free[k] * x(i);
  }
  EXPECT_LE((y - tangent.multiply(x)).norm(), 1e-14 * y.norm());
}
