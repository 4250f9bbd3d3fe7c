// Two blocks of different meshes pressed together: a uniform stress passes through their contact, and all of the force;
// balls against each other and against a plane; a ring that touches itself.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <solver/implicit/steps.hpp>
#include <tests/verify/organs.hpp>

using namespace palpate;
using namespace palpate::verify;

namespace {

constexpr double side = 4, mu = 0.0067, depth = 1.2;

/// A block of 4 × 4 × 3 mm on another one, sliding on the planes x = 0 and y = 0; the upper one's top is pushed down.
implicit::Model stack(int lower, int upper) {
  auto model = brick(uniform(0, side, lower), uniform(0, side, lower), uniform(-3, 0, 3));
  const int faces = static_cast<int>(model.faces.size());
  append(model, brick(uniform(0, side, upper), uniform(0, side, upper), uniform(0, 3, 3)));
  model.materials = {material("neo_hookean", {mu})};
  for (int c : {0, 1}) hold(model, c, [c](const Vector3d& x) { return x(c) < 1e-9; });
  hold(model, 2, [](const Vector3d& x) { return x.z() < -3 + 1e-9; });
  hold(model, 2, [](const Vector3d& x) { return x.z() > 3 - 1e-9; }, -depth);
  touch(model, faces);
  return model;
}

/// Every step, with the pushing force.
struct Pressed {
  implicit::State state;
  implicit::Equations equations;
  double reached = 0, worst_penetration = 0;
  std::vector<elements::ElementResult> results;
};

Pressed press(const implicit::Model& model, int steps) {
  implicit::Equilibrium equilibrium(model, 1);
  Pressed p{implicit::rest_state(model), {}, 0, 0, {}};
  p.reached = run_steps(equilibrium, p.state, {uniform(0, 1, steps)}, [&](const implicit::Step& step) {
    p.equations = step.equations;
    p.worst_penetration = std::max(p.worst_penetration, step.equations.contact.penetration);
  });
  if (p.reached < 1) std::printf("  %s\n", equilibrium.trouble().cause.c_str());
  p.results = equilibrium.assembly().results(p.state);
  return p;
}

}  // namespace

TEST(TwoOrgans, AUniformStressPassesThrough) {
  const auto model = stack(4, 5);
  const auto p = press(model, 4);
  ASSERT_EQ(p.reached, 1);
  const double stretch = 1 - depth / 6, wanted = mu * (1 / (stretch * stretch) - stretch) * side * side;
  double applied = 0, low = 1, high = 0;
  for (const auto& held : model.prescribed)
    if (held.value != 0) applied -= p.equations.residual(4 * held.node + held.component);
  const double transmitted = p.equations.contact.organs.at(0).force.norm(), cauchy = wanted / (side * side) * stretch;
  for (const auto& result : p.results) {
    low = std::min(low, result.von_mises / cauchy);
    high = std::max(high, result.von_mises / cauchy);
  }
  std::printf("  applied %.8g N, transmitted %.8g N, uniform %.8g N; von Mises %.5f to %.5f of the uniform one; penetration %.4f\n", applied,
              transmitted, wanted, low, high, p.worst_penetration);
  EXPECT_LE(std::abs(transmitted / applied - 1), 1e-6);  // asked for: 0.5 %
  EXPECT_LE(std::abs(applied / wanted - 1), 0.005);      // the gap that contact may leave
  EXPECT_LE(high - low, 0.002);                          // six points a face do not integrate what the other mesh sees exactly
  EXPECT_LE(p.worst_penetration, 0.01);
}

TEST(TwoOrgans, FarApartTheyDoNotKnowEachOther) {
  auto model = stack(3, 3);
  for (std::size_t i = 0; i < model.points.size() / 2; ++i) model.points[i].x() += 100;
  for (auto& p : model.prescribed) p.value *= -0.5;  // pulled
  auto alone = model;
  alone.passes.clear();
  const auto with = press(model, 2), without = press(alone, 2);
  EXPECT_TRUE(with.equations.contact.pairs.empty());
  EXPECT_GT(without.state.nodal.norm(), 0.1);
  EXPECT_LE((with.state.nodal - without.state.nodal).norm(), 1e-10 * without.state.nodal.norm());
}

namespace {

/// A quarter of half a ball of radius R around the origin, its pole at ±R e_z, with a hollow core of R/4.
implicit::Model quarter_ball(double R, int n, int layers, double up) {
  auto model = thick_sphere_octant(R / 4, R, n, layers);
  for (auto& x : model.points) x.z() *= up;
  orient(model);
  model.faces = boundary(model);
  return model;
}

}  // namespace

/// Quarter balls whose cores of R/4 come together: the force is that against a rigid plane half way (symmetry), and so for another mesh.
TEST(TwoOrgans, BallsPressEachOtherAsAPlaneDoes) {
  const double R = 4, way = 0.6;
  const Vector3d apart(0, 0, -2 * R);
  const auto hold_ball = [&](implicit::Model& model, const Vector3d& centre, double moved) {
    for (std::size_t i = 0; i < model.points.size(); ++i) {
      const Vector3d x = model.points[i] - centre;
      if (x.norm() > R + 1e-6) continue;
      for (int c = 0; c < 3; ++c)
        if (x.norm() < R / 4 + 1e-6) model.prescribed.push_back({int(i), c, c == 2 ? moved : 0.0});
        else if (c < 2 && x(c) < 1e-9) model.prescribed.push_back({int(i), c, 0});
    }
    model.materials = {material("neo_hookean", {mu})};
  };
  auto single = quarter_ball(R, 10, 6, -1);
  hold_ball(single, Vector3d::Zero(), 0);
  single.tools = {contact::Tool{tool_named("plane"), {}, Vector3d::UnitZ(), {0, 0, -R}, way, {}}};
  const auto against_plane = press(single, 4);
  ASSERT_EQ(against_plane.reached, 1);
  const double plane = against_plane.equations.contact.tools[0].force.z();
  for (int other : {10, 8}) {
    auto model = quarter_ball(R, 10, 6, -1), second = quarter_ball(R, other, 6, 1);
    for (auto& x : second.points) x += apart;
    const int faces = model.faces.size();
    append(model, second);
    hold_ball(model, Vector3d::Zero(), 0);
    hold_ball(model, apart, 2 * way);
    touch(model, faces);
    const auto p = press(model, 4);
    ASSERT_EQ(p.reached, 1);
    const double pair = p.equations.contact.organs[0].force.z();
    std::printf("  against the plane %.6g N, against a ball of %d x %d faces %.6g N, penetration %.4f\n", plane, other, other, pair, p.worst_penetration);
    EXPECT_LE(std::abs(pair / plane - 1), 0.01);
    EXPECT_LE(p.worst_penetration, 0.01);
  }
}

namespace {

/// A ring of radii 2 and 3.5 mm, 1.2 mm wide, between flat plates that come together; it neither leaves the plane of its axis nor slides along x.
implicit::Model flattened_ring(double way) {
  auto model = tube(2, 3.5, 1.2, 28, 3, 2);
  model.materials = {material("neo_hookean", {mu})};
  hold(model, 2, [](const Vector3d&) { return true; });
  hold(model, 0, [](const Vector3d& x) { return std::abs(x.x()) < 1e-6; });
  for (double up : {-1.0, 1.0})
    model.tools.push_back({tool_named("plane"), {}, Vector3d(0, -up, 0), Vector3d(0, 3.5 * up, 0.6), way / 2, {}});
  std::vector<int> all(model.faces.size());
  std::iota(all.begin(), all.end(), 0);
  model.passes = contact::passes_between(all, {}, true, 0);
  return model;
}

/// How far the upper half of the inner line z = 0 reaches below its lower half, mm.
double deepest_overlap(const implicit::Model& model, const implicit::State& state) {
  std::vector<std::pair<double, Vector3d>> line;  // by angle at rest
  for (std::size_t i = 0; i < model.points.size(); ++i) {
    const auto& x = model.points[i];
    if (x.z() < 1e-9 && x.head<2>().norm() < 2 + 1e-6) line.push_back({std::atan2(x.y(), x.x()), x + state.displacement(i)});
  }
  std::sort(line.begin(), line.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  double deepest = 0;
  for (const auto& [angle, x] : line)
    for (std::size_t k = 1; k < line.size(); ++k) {
      const Vector3d &from = line[k - 1].second, &to = line[k].second;
      if (angle < 0.1 || angle > M_PI - 0.1 || line[k].first > 1e-9 || (x.x() - from.x()) * (x.x() - to.x()) > 0) continue;
      deepest = std::max(deepest, from.y() + (x.x() - from.x()) / (to.x() - from.x()) * (to.y() - from.y()) - x.y());
    }
  return deepest;
}

}  // namespace

TEST(TwoOrgans, AFlattenedRingTouchesItself) {
  const auto model = flattened_ring(4.4);
  const auto p = press(model, 10);
  ASSERT_EQ(p.reached, 1);
  const auto& contact = p.equations.contact;
  const double overlap = deepest_overlap(model, p.state);
  std::printf("  force %.6g and %.6g N, touching area %.4g mm2, penetration %.4f, overlap of the inner line %.2g mm\n", contact.tools[0].force.y(),
              contact.tools[1].force.y(), contact.organs[0].area, p.worst_penetration, overlap);
  EXPECT_GT(contact.organs[0].area, 1);
  EXPECT_LE((contact.tools[0].force + contact.tools[1].force).norm(), 1e-6 * contact.tools[0].force.norm());
  EXPECT_LE(p.worst_penetration, 0.01);
  EXPECT_LE(overlap, 0.02 * 0.5);  // nodes may lie deeper than the faces' points: twice the bound, of a face of 0.5 mm
  auto alone = model;
  alone.passes.clear();
  const auto ignorant = press(alone, 10);
  EXPECT_GT(deepest_overlap(model, ignorant.state), 0.1);
  EXPECT_LT(ignorant.equations.contact.tools[0].force.norm(), 0.8 * contact.tools[0].force.norm());
}
