// Pressure that follows its faces, tools controlled by force, tools that turn: closed forms and balances.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <solver/implicit/steps.hpp>
#include <tests/verify/organs.hpp>

using namespace palpate;
using namespace palpate::verify;

namespace {

constexpr double mu = 0.0067;

struct Solved {
  implicit::State state;
  implicit::Equations equations;
  Vector3d loads = Vector3d::Zero();
  double reached = 0;
  std::string trouble;
};

Solved solve(const implicit::Model& model, const std::vector<double>& times) {
  implicit::Equilibrium equilibrium(model, 1);
  Solved s{implicit::rest_state(model), {}, {}, 0, {}};
  s.reached = run_steps(equilibrium, s.state, {times}, [&](const implicit::Step& step) { s.equations = step.equations; });
  s.loads = equilibrium.assembly().loads(s.state);
  s.trouble = equilibrium.trouble().cause;
  return s;
}

/// Force on the organ at what is held.
Vector3d reaction(const implicit::Model& model, const Solved& s) {
  Vector3d sum = Vector3d::Zero();
  for (const auto& p : model.prescribed) sum(p.component) += s.equations.residual(4 * p.node + p.component);
  return sum;
}

/// An eighth of a thick sphere, 2 mm inside and 4 mm outside, blown up.
implicit::Model blown_sphere(double pressure, int n, int layers) {
  auto model = thick_sphere_octant(2, 4, n, layers);
  model.materials = {material("neo_hookean", {mu})};
  for (int c : {0, 1, 2}) hold(model, c, [c](const Vector3d& x) { return x(c) < 1e-9; });
  implicit::FacePressure load{{}, pressure, 0};
  for (int f = 0; f < int(model.faces.size()); ++f) {
    const auto& face = model.faces[f];
    if (std::all_of(face.begin(), face.end(), [&](int node) { return model.points[node].norm() < 2 + 1e-6; })) load.faces.push_back(f);
  }
  model.pressures = {load};
  return model;
}

/// Of the design's table: P(λa) of a thick sphere, outer radius twice the inner.
double sphere_pressure(double a) {
  const double b = std::cbrt(1 + (a * a * a - 1) / 8);
  return 2 * mu * (1 / b + 1 / (4 * std::pow(b, 4)) - 1 / a - 1 / (4 * std::pow(a, 4)));
}

/// A cube of 4 mm that slides on the planes x = 0, y = 0 and z = 0; a plane above it.
implicit::Model cube_under_a_plane() {
  auto model = brick(uniform(0, 4, 4), uniform(0, 4, 4), uniform(0, 4, 4));
  model.materials = {material("neo_hookean", {mu})};
  for (int c : {0, 1, 2}) hold(model, c, [c](const Vector3d& x) { return x(c) < 1e-9; });
  model.tools = {contact::Tool{tool_named("plane"), {}, -Vector3d::UnitZ(), {2, 2, 4}, 0, {}}};
  return model;
}

implicit::Model by_force(implicit::Model model, double force) {
  model.tools[0].force_controlled = true;
  model.tools[0].force = force;
  return model;
}

}  // namespace

TEST(FacePressure, ASphereIsBlownUp) {
  const double stretch = 1.4;
  std::vector<double> errors;
  for (int n : {6, 12}) {
    const auto model = blown_sphere(sphere_pressure(stretch), n, n);
    const auto s = solve(model, {0, 0.5, 1});
    ASSERT_EQ(s.reached, 1) << s.trouble;
    double sum = 0;
    int count = 0;
    for (std::size_t i = 0; i < model.points.size(); ++i)
      if (model.points[i].norm() < 2 + 1e-6) {
        sum += (model.points[i] + s.state.displacement(i)).norm() / 2;
        ++count;
      }
    errors.push_back(sum / count - stretch);
    std::printf("  %d: inner stretch %.5f of %.5f; pressure's force and reaction %.3g of %.3g N\n", n, sum / count, stretch,
                (s.loads + reaction(model, s)).norm(), s.loads.norm());
    EXPECT_LE((s.loads + reaction(model, s)).norm(), 1e-7 * s.loads.norm());
  }
  EXPECT_LE(std::abs(errors[1]), 0.01 * stretch);
  EXPECT_LE(std::abs(errors[1]), 0.5 * std::abs(errors[0]));
}

TEST(FacePressure, TangentIsTheDerivative) {
  for (const bool edge_held : {false, true}) {
    auto model = brick(uniform(0, 2, 2), uniform(0, 2, 2), uniform(0, 2, 2));
    model.materials = {material("neo_hookean", {mu})};
    for (int c = 0; c < 3; ++c) hold(model, c, [&](const Vector3d& x) { return x.z() < 1e-9; });
    implicit::FacePressure load{{}, 0.02, 0};
    for (int f = 0; f < int(model.faces.size()); ++f) {
      double lowest = 9, highest = 0;
      for (int node : model.faces[f]) {
        lowest = std::min(lowest, model.points[node].z());
        highest = std::max(highest, model.points[node].z());
      }
      if (edge_held ? highest > 1e-9 : lowest > 2 - 1e-9) load.faces.push_back(f);
    }
    model.pressures = {load};
    EXPECT_EQ(implicit::is_conservative(model), edge_held);
    const implicit::Assembly assembly(model, 1);
    implicit::BlockMatrix tangent(int(model.points.size()), model.tets, edge_held);
    implicit::State state = implicit::rest_state(model);
    state.time = 1;
    Eigen::VectorXd way = Eigen::VectorXd::Zero(state.nodal.size());
    for (int i = 0; i < way.size(); ++i) {
      if (model.points[i / 4].z() < 1e-9) continue;
      state.nodal(i) = i % 4 == 3 ? 0 : 0.05 * std::sin(3.0 * i);
      way(i) = std::cos(5.0 * i);
    }
    const auto at = [&](double h) {
      implicit::State moved = state;
      moved.nodal += h * way;
      return assembly(moved, tangent).residual;
    };
    const Eigen::VectorXd numeric = (at(1e-5) - at(-1e-5)) / 2e-5;
    at(0);
    Eigen::VectorXd difference = tangent.multiply(way) - numeric;
    for (const auto& p : model.prescribed) difference(4 * p.node + p.component) = 0;
    EXPECT_LE(difference.norm(), 1e-6 * numeric.norm());
  }
}

TEST(ForceControl, APlaneSinksByWhatTheForceAsks) {  // F = μ (1/λ² − λ) A (Treloar 1943)
  const double stretch = 0.75, force = mu * (1 / (stretch * stretch) - stretch) * 16;
  auto model = by_force(cube_under_a_plane(), force);
  model.tools[0].ramp = Amplitude{{{0, 0}, {1, 1}, {2, 0.5}, {3, 1}}};
  for (double end : {1.0, 3.0}) {
    std::vector<double> times;
    for (double t = 0; t < end + 0.1; t += 0.25) times.push_back(t);
    const auto s = solve(model, times);
    ASSERT_EQ(s.reached, end) << s.trouble;
    std::printf("  t = %g: travel %.5f mm of %.5f, force %.9g of %.9g N\n", end, s.state.travels[0], 4 * (1 - stretch),
                -s.equations.contact.tools[0].force.z(), force);
    EXPECT_LE(std::abs(-s.equations.contact.tools[0].force.z() / force - 1), 1e-6);
    EXPECT_LE(std::abs(s.state.travels[0] / (4 * (1 - stretch)) - 1), 0.01);  // the gap that contact may leave
    EXPECT_LE((s.equations.contact.tools[0].force + reaction(model, s)).norm(), 1e-7 * force);
  }
}

TEST(ForceControl, IsDepthControlTurnedRound) {  // a ball, with and without friction
  for (double friction : {0.0, 0.5}) {
    auto model = brick(uniform(-5, 5, 7), uniform(-5, 5, 7), uniform(0, 6, 5));
    model.materials = {material("fung_demiray", {mu, 2})};
    for (int c = 0; c < 3; ++c) hold(model, c, [](const Vector3d& x) { return x.z() < 1e-9; });
    model.tools = {contact::Tool{tool_named("ball"), {3.0}, -Vector3d::UnitZ(), {0.1, 0.2, 6}, 1.5, {}}};
    rub(model.tools[0], friction);
    const auto pushed = solve(model, {0, 0.25, 0.5, 0.75, 1});
    ASSERT_EQ(pushed.reached, 1) << pushed.trouble;
    const double force = -pushed.equations.contact.tools[0].force.z();
    const auto loaded = solve(by_force(model, force), {0, 0.25, 0.5, 0.75, 1});
    ASSERT_EQ(loaded.reached, 1) << loaded.trouble;
    std::printf("  friction %.1f: %.6g N at 1.5 mm; by force %.6f mm\n", friction, force, loaded.state.travels[0]);
    EXPECT_LE(std::abs(-loaded.equations.contact.tools[0].force.z() / force - 1), 1e-6);
    EXPECT_LE(std::abs(loaded.state.travels[0] / 1.5 - 1), friction > 0 ? 5e-3 : 1e-6);  // friction remembers the steps, and they differ
  }
}

TEST(Turning, ABarTurnedOnItsWayPressesAsOneThatStoodSo) {
  std::vector<double> forces;
  for (const bool turned : {true, false}) {
    auto model = brick(uniform(0, 4, 4), uniform(0, 4, 5), uniform(0, 4, 4));
    model.materials = {material("neo_hookean", {mu})};
    for (int c = 0; c < 3; ++c) hold(model, c, [](const Vector3d& x) { return x.z() < 1e-9; });
    contact::Tool bar{tool_named("box"), {2, 20, 5, 0.5}, -Vector3d::UnitZ(), {2, 2, 4}, 0.6, Amplitude{{{0, 0}, {1, 0}, {2, 1}}}};
    bar.across = turned ? Vector3d(1, 0, 0) : Vector3d(std::cos(0.9), std::sin(0.9), 0);
    if (turned) {
      bar.spin = Vector3d::UnitZ();
      bar.turn = Amplitude{{{0, 0}, {1, 0.3}, {2, 0.9}}};
    }
    model.tools = {bar};
    const auto s = solve(model, {0, 0.5, 1, 1.25, 1.5, 1.75, 2});
    ASSERT_EQ(s.reached, 2) << s.trouble;
    forces.push_back(-s.equations.contact.tools[0].force.z());
    EXPECT_LE((s.equations.contact.tools[0].force + reaction(model, s)).norm(), 1e-7 * forces.back());
  }
  std::printf("  %.9g and %.9g N\n", forces[0], forces[1]);
  EXPECT_LE(std::abs(forces[0] / forces[1] - 1), 1e-6);
}

/// Moment of a sticking plate that turns the end of a tube, over μ π/2 (b⁴ − a⁴) θ/L: small twist of a circle; a polygon of n sides has
/// (sin x/x)(2 + cos x)/3 of a circle's polar moment, x = 2π/n.
double twisted(int around, int across, int along) {
  const double a = 2, b = 3.5, length = 4, angle = 0.1, x = 2 * M_PI / around;
  auto model = tube(a, b, length, around, across, along);
  model.materials = {material("neo_hookean", {mu})};
  for (int c = 0; c < 3; ++c) hold(model, c, [](const Vector3d& p) { return p.z() < 1e-9; });
  contact::Tool plate{tool_named("plane"), {}, -Vector3d::UnitZ(), {0, 0, length}, 0.01, Amplitude{{{0, 0}, {1, 1}}}};
  rub(plate, std::numeric_limits<double>::infinity());
  plate.spin = Vector3d::UnitZ();
  plate.turn = Amplitude{{{0, 0}, {1, 0}, {2, angle}}};
  model.tools = {plate};
  const auto s = solve(model, {0, 1, 1.5, 2});
  if (s.reached < 2) throw std::runtime_error(s.trouble);
  double held = 0;
  for (const auto& p : model.prescribed) {
    const Vector3d at = model.points[p.node];
    if (p.component == 0) held -= at.y() * s.equations.residual(4 * p.node);
    if (p.component == 1) held += at.x() * s.equations.residual(4 * p.node + 1);
  }
  const double moment = s.equations.contact.tools[0].moment.z();
  EXPECT_LE(std::abs(moment + held), 1e-6 * moment);
  return moment / (mu * M_PI / 2 * (std::pow(b, 4) - std::pow(a, 4)) * angle / length * std::sin(x) / x * (2 + std::cos(x)) / 3);
}

TEST(Turning, ATubeIsTwisted) {
  const double coarse = twisted(24, 2, 4), fine = twisted(48, 4, 8);
  std::printf("  moment over the closed form: %.4f, finer %.4f\n", coarse, fine);
  EXPECT_LE(std::abs(fine - 1), 0.03);
  EXPECT_LE(std::abs(fine - 1), 0.5 * std::abs(coarse - 1));
}
