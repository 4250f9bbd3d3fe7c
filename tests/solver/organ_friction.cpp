// Friction between faces: the tangent against differences of the residual, sticking and sliding; forces that cancel; what is remembered asks for the
// same shear again and turns with the organs; a point that has just touched; and what a finer mesh is told.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <solver/contact/coulomb.hpp>
#include <solver/implicit/slips.hpp>
#include <tests/solver/origins.hpp>
#include <tests/verify/organs.hpp>

using namespace palpate;
using namespace palpate::verify;
using contact::Triangle;

namespace {

constexpr double softness = 0.01, carried = 0.05, sticking = std::numeric_limits<double>::infinity();

/// A face looking up, another one looking down at a slant, and a third one beside that, in which the point's anchor is.
struct Rubbing {
  double mu;
  Triangle tall{Vector3d(0, 0, 0), Vector3d(8, 0, 8), Vector3d(0, 8, 8)};  // of a thick body: decides how far back a line looks
  Triangle rest{Vector3d(0, 0, 0), Vector3d(1, 0.1, 0), Vector3d(0.2, 1.1, 0)};
  std::array<Vector3d, 9> corners{Vector3d(0.01, 0, 0.02), Vector3d(1.1, 0.1, 0), Vector3d(0.2, 1.1, 0.03),
                                  Vector3d(-1, -1, 0.001), Vector3d(0, 3, 0.011), Vector3d(3, -1, 0.031),
                                  Vector3d(-1, -1, 0.002), Vector3d(-1, 3, 0.012), Vector3d(0, 3, 0.011)};
  contact::PairSlip before{2, {-0.3, 0.1, 1.2}, {1e-4, 2e-4, 0}, {0.3, 0.2, 0}};
  std::array<Vector3d, 9> earlier = corners;  ///< when the last step was found

  Triangle triangle(const std::array<Vector3d, 9>& at, int i) const { return {at[3 * i], at[3 * i + 1], at[3 * i + 2]}; }

  contact::Meeting meeting(const std::array<Vector3d, 9>& at) const {
    for (const auto& found : contact::meetings({{0}, {1}, false, 0}, {tall, tall}, {triangle(at, 0), triangle(at, 1)}))
      if (found.q == 3) return found;
    throw std::logic_error("the point meets nothing");
  }
  contact::PairPoint point(const std::array<Vector3d, 9>& at) const {
    return contact::pair_point(meeting(at), rest, triangle(at, 0), triangle(at, 1), carried, softness);
  }
  contact::PairShear operator()(const std::array<Vector3d, 9>& at) const {
    return contact::pair_shear(meeting(at), point(at), rest, triangle(at, 0), triangle(at, 1), {before, triangle(at, 2), triangle(earlier, 0), triangle(earlier, 1)}, mu, softness);
  }
};

/// With its anchor at this way from where its line ends.
Rubbing rubbing(double mu, const Vector3d& way) {
  Rubbing pair{mu};
  const auto& c = pair.corners;
  const auto met = pair.meeting(c);
  Vector3d end = way;
  for (int b = 0; b < 3; ++b) end += met.weights[b] * c[3 + b];
  const Eigen::Vector3d weights = contact::weight_gradients({c[6], c[7], c[8]}) * (end - c[6]);
  pair.before.weights = {1 + weights(0), weights(1), weights(2)};
  return pair;
}

void expect_tangent(const Rubbing& pair) {
  const auto whole = pair(pair.corners);
  Eigen::Matrix<double, 18, 27> numeric;
  const double h = 1e-6;
  for (int i = 0; i < 27; ++i) {
    auto plus = pair.corners, minus = pair.corners;
    plus[i / 3](i % 3) += h;
    minus[i / 3](i % 3) -= h;
    numeric.col(i) = (pair(plus).residual - pair(minus).residual) / (2 * h);
  }
  EXPECT_LE((numeric - whole.tangent).norm(), 1e-6 * whole.tangent.norm()) << pair.mu;
}

const Vector3d little(0.003, -0.002, 0), much(0.3, -0.2, 0);

}  // namespace

TEST(OrganFriction, TangentIsTheDerivative) {
  for (const Rubbing& pair : {rubbing(sticking, little), rubbing(0.05, little), rubbing(0.4, much)}) {
    EXPECT_EQ(pair(pair.corners).law.answer.slides, pair.mu < 1);
    expect_tangent(pair);
  }
}

TEST(OrganFriction, ForcesCancelAndStayInTheCone) {
  const Rubbing pair = rubbing(0.4, much);
  const auto shear = pair(pair.corners);
  const auto point = pair.point(pair.corners);
  Vector3d force = Vector3d::Zero();
  for (int a = 0; a < 6; ++a) force += shear.residual.segment<3>(3 * a);
  EXPECT_LE(force.norm(), 1e-14 * shear.residual.norm());
  EXPECT_NEAR(shear.after.shear.norm(), 0.4 * point.pressure * (1 - contact::inside_the_cone), 1e-15);
  EXPECT_LE(std::abs(shear.after.shear.dot(point.normal)), 1e-15);
  EXPECT_GT(shear.after.shear.dot(much), 0);  // pulled towards the anchor
}

/// Where nothing moves on, the next step begins with the shear of the last one, sticking; and so it does when both organs have turned together.
TEST(OrganFriction, WhatIsRememberedTurnsWithTheOrgans) {
  const auto Q = Eigen::AngleAxisd(1.1, Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  for (const Rubbing& pair : {rubbing(sticking, little), rubbing(0.4, much)}) {
    const auto first = pair(pair.corners);
    Rubbing next = pair;
    next.before = first.after;
    for (int b = 0; b < 3; ++b) next.corners[6 + b] = next.corners[3 + b];  // the anchor is in the other face's plane now
    const auto again = next(next.corners);
    EXPECT_FALSE(again.law.answer.slides);
    EXPECT_LE((again.after.shear - first.after.shear).norm(), 1e-12 * first.after.shear.norm());
    EXPECT_LE((again.after.way - first.after.way).norm(), 1e-12);
    for (auto& x : next.corners) x = Q * x + Vector3d(1, 2, 3);
    for (auto& x : next.tall) x = Q * x;
    EXPECT_LE((next(next.corners).after.shear - Q * first.after.shear).norm(), 1e-10 * first.after.shear.norm());
  }
}

/// It did not press: it slips by what both have moved since.
TEST(OrganFriction, APointThatHasJustTouchedSlipsByTheStep) {
  for (double mu : {sticking, 0.02}) {
    Rubbing pair{mu};
    pair.before = {};
    for (int i = 0; i < 3; ++i) {
      pair.earlier[i] -= Vector3d(0.004, 0.001, -0.3);
      pair.earlier[3 + i] -= Vector3d(0.001, -0.002, 0.0) + 0.001 * Vector3d(i, -i, 0);
    }
    expect_tangent(pair);
    const auto met = pair.meeting(pair.corners);
    Vector3d slip(0.004, 0.001, -0.3);
    for (int b = 0; b < 3; ++b) slip -= met.weights[b] * (Vector3d(0.001, -0.002, 0) + 0.001 * Vector3d(b, -b, 0));
    const auto shear = pair(pair.corners);
    const Vector3d n = pair.point(pair.corners).normal, along = slip - n * n.dot(slip);
    EXPECT_LE((shear.after.way - along).norm(), 1e-12);
    EXPECT_LE((shear.after.shear.normalized() + along.normalized()).norm(), 1e-12);
    EXPECT_EQ(shear.law.answer.slides, mu < 1);
    EXPECT_EQ(shear.after.face, 1);
  }
}

namespace {

/// A block of 3 × 3 × 2 mm, half a millimetre over the middle of one of 5 × 5 × 2 mm.
implicit::Model one_over_another(int cells, double friction) {
  auto model = brick(uniform(0, 5, 5 * cells), uniform(0, 5, 5 * cells), uniform(0, 2, 2 * cells));
  const int faces = model.faces.size();
  append(model, brick(uniform(1, 4, 2 * cells), uniform(1, 4, 2 * cells), uniform(2.5, 4.5, cells)));
  model.materials = {material("neo_hookean", {0.0067})};
  touch(model, faces, friction);
  return model;
}

}  // namespace

/// The work of its shear ends where it left; with its way lost, all that it had rubbed would count once more.
TEST(OrganFriction, APointThatLeavesKeepsItsWay) {
  const auto model = one_over_another(1, 0.3);
  auto state = implicit::rest_state(model);
  const Vector3d way(0.3, -0.2, 0.1);
  for (auto& slip : state.pair_slips) slip = {1, {0.2, 0.3, 0.5}, Vector3d(1e-4, 0, 0), way};
  implicit::remember_slips(model, {}, state);
  for (const auto& slip : state.pair_slips) {
    EXPECT_EQ(slip.way, way);
    EXPECT_EQ(slip.shear, Vector3d(0, 0, 0));
    EXPECT_EQ(slip.face, -1);
  }
}

/// Pressed together, with a shear that is the same everywhere: on a mesh twice as fine every point asks for that shear again.
TEST(OrganFriction, AFinerMeshIsToldTheShear) {
  const auto coarse = one_over_another(1, 0.3), fine = one_over_another(2, 0.3);
  auto state = implicit::rest_state(coarse);
  for (std::size_t n = 0; n < coarse.points.size(); ++n)
    if (coarse.points[n].z() > 2.2) state.nodal.segment<3>(4 * n) = Vector3d(0.2, 0.1, -0.502);
  const Vector3d shear(2e-4, -1e-4, 0);
  std::size_t at = 0;
  for (std::size_t p = 0; p < coarse.passes.size(); ++p)
    for (std::size_t i = 0; i < contact::points_per_face * coarse.passes[p].own.size(); ++i, ++at) {
      state.pair_slips[at].shear = p == 0 ? shear : Vector3d(-shear);
      state.pair_pressures[at] = 0.001;
    }
  const auto carried_state = implicit::carried(coarse, state, fine, origins_in(coarse, fine));
  implicit::Assembly assembly(fine, 1);
  implicit::BlockMatrix tangent(fine.points.size(), fine.tets, false);
  auto trial = carried_state;
  const auto equations = assembly(trial, tangent);
  int told = 0;
  for (const auto& place : equations.contact.pairs) {
    if (place.law.answer.slides) continue;
    ++told;
    const bool first = place.at < contact::points_per_face * fine.passes[0].own.size();
    EXPECT_LE((place.after.shear - (first ? shear : Vector3d(-shear))).norm(), 1e-10 * shear.norm());
  }
  EXPECT_GT(told, 100);
}
