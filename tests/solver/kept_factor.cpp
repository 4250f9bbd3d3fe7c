// GMRES beside a dense solution; equilibria found with a kept factor beside those with a factor in every iteration.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <solver/implicit/krylov.hpp>
#include <solver/implicit/steps.hpp>
#include <tests/solver/newtons_order.hpp>
#include <tests/verify/shapes.hpp>

using namespace palpate;
using namespace palpate::verify;

namespace {

/// Large enough that a factor is worth keeping.
implicit::Model pressed_block() {
  auto model = brick(uniform(-6, 6, 13), uniform(-6, 6, 13), uniform(0, 6, 8));
  model.materials = {material("fung_demiray", {0.0067, 2})};
  for (int c = 0; c < 3; ++c) hold(model, c, [](const Vector3d& x) { return x.z() < 1e-9; });
  model.tools = {contact::Tool{tool_named("ball"), {3.0}, -Vector3d::UnitZ(), {0.1, 0.2, 6}, 1.5, {}}};
  return model;
}

struct Pressed {
  implicit::State state;
  implicit::Work work;
  double force = 0;
  std::vector<double> residuals;  ///< of the last step
};

Pressed pressed(const implicit::Model& model, bool keep_factor, int threads) {
  implicit::NewtonLimits limits;
  limits.keep_factor = keep_factor;
  implicit::Equilibrium equilibrium(model, threads, limits);
  Pressed run{implicit::rest_state(model), {}, 0, {}};
  for (double load : {0.2, 0.4, 0.6}) {
    const auto found = equilibrium.find(run.state, load);
    if (!found) throw std::runtime_error(equilibrium.trouble().cause);
    run.force = -found->equations.contact.tools[0].force.z();
    run.residuals = found->residuals;
  }
  run.work = equilibrium.work();
  return run;
}

const Pressed& kept_by_one() {
  static const Pressed run = pressed(pressed_block(), true, 1);
  return run;
}

}  // namespace

TEST(Krylov, SolvesAsADenseFactorDoes) {
  std::srand(1);
  const int n = 60;
  const Eigen::MatrixXd P = Eigen::MatrixXd::Random(n, n) + 8 * Eigen::MatrixXd::Identity(n, n);
  const Eigen::MatrixXd A = P + 0.3 * Eigen::MatrixXd::Random(n, n);
  const Eigen::VectorXd b = Eigen::VectorXd::Random(n), weights = Eigen::VectorXd::LinSpaced(n, 1, 1000);
  const Eigen::PartialPivLU<Eigen::MatrixXd> lu(P);
  const auto product = [&](const Eigen::VectorXd& x) { return Eigen::VectorXd(A * x); };
  Eigen::VectorXd x = b;
  const auto krylov = implicit::gmres(product, [&](Eigen::VectorXd& z) { z = lu.solve(z).eval(); }, weights, 1e-12, n, x);
  EXPECT_TRUE(krylov.found);
  EXPECT_LT(krylov.iterations, n / 2);
  EXPECT_LE((A * x - b).norm(), 1e-10 * b.norm());
  EXPECT_LE(weights.cwiseProduct(A * x - b).norm(), 1.01e-12 * weights.cwiseProduct(b).norm());
}

TEST(Krylov, LeavesTheRightHandSideWhereItFindsNothing) {
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(20, 1, 2), ones = Eigen::VectorXd::Ones(20);
  const auto shift = [](const Eigen::VectorXd& x) {  // a cycle: nothing is found before the last iteration
    Eigen::VectorXd y(20);
    for (int i = 0; i < 20; ++i) y((i + 1) % 20) = x(i);
    return y;
  };
  Eigen::VectorXd x = Eigen::VectorXd::Unit(20, 0);
  EXPECT_FALSE(implicit::gmres(shift, [](Eigen::VectorXd&) {}, ones, 1e-6, 10, x).found);
  EXPECT_EQ(x, Eigen::VectorXd::Unit(20, 0));
}

TEST(KeptFactor, FindsTheSameWithFewerFactors) {
  const Pressed &kept = kept_by_one(), fresh = pressed(pressed_block(), false, 1);
  std::printf("  %d factors and %d iterations of GMRES; %d factors without\n", kept.work.factors, kept.work.iterations, fresh.work.factors);
  EXPECT_GT(kept.work.iterations, 0);
  EXPECT_LT(kept.work.factors, 0.7 * fresh.work.factors);
  EXPECT_LE(std::abs(kept.force - fresh.force), 1e-8 * fresh.force);
  EXPECT_LE((kept.state.nodal - fresh.state.nodal).norm(), 1e-7 * fresh.state.nodal.norm());
}

TEST(KeptFactor, KeepsNewtonsOrder) {
  expect_newtons_order(kept_by_one().residuals);
}

TEST(KeptFactor, ThreadsDoNotChangeABit) {
  const Pressed &one = kept_by_one(), two = pressed(pressed_block(), true, 2);
  EXPECT_EQ(one.state.nodal, two.state.nodal);
  EXPECT_EQ(one.work.factors, two.work.factors);
}

TEST(SparseDirect, OrdersALargePatternAlikeEveryTime) {
  const auto model = brick(uniform(0, 1, 16), uniform(0, 1, 16), uniform(0, 1, 16));
  const implicit::BlockMatrix tangent(static_cast<int>(model.points.size()), model.tets);
  std::vector<Eigen::VectorXd> solutions;
  std::vector<int> rows, columns;
  tangent.coordinates(rows, columns);
  std::vector<double> values;
  for (std::size_t i = 0; i < rows.size(); ++i) values.push_back(rows[i] == columns[i] ? 200 + i % 7 : 1.0 / (1 + i % 11));
  for (int turn = 0; turn < 2; ++turn) {
    implicit::SparseDirect solver(4 * tangent.nodes(), rows, columns, true, 1);
    ASSERT_TRUE(solver.factor(values));
    Eigen::VectorXd x = Eigen::VectorXd::Ones(4 * tangent.nodes());
    solver.solve(x);
    solutions.push_back(x);
  }
  EXPECT_EQ(solutions[0], solutions[1]);
}
