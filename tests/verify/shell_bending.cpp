// Shells that bend: a strip rolled up by an end moment, a ring pressed between two lines, a patch in free rigid rotation.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <numbers>

#include <solver/explicit/motion.hpp>
#include <tests/verify/shell_at_rest.hpp>

namespace palpate::explicit_shell {
namespace {

constexpr double pi = std::numbers::pi;

/// M = 2π EI/L closes a cantilever to a circle: its end comes back to its beginning (Simo & Vu-Quoc 1986, Comput. Methods Appl. Mech. Eng. 58:79).
TEST(Shell, RolledUpByAnEndMoment) {
  constexpr double length = 20, width = 1, t = 0.1, E = 1000;
  const int n = 30;
  AtRest shell(make_wall(grid_shell(n, 2, t, [&](double u, double v) { return Vec3{u * length, v * width, 0}; }), materials::HookeShell{E, 0}, 1));
  const auto at = [&](int e, double x) {
    return std::abs(shell.wall.rest[shell.wall.edges[e][0]][0] - x) < 1e-9 && std::abs(shell.wall.rest[shell.wall.edges[e][1]][0] - x) < 1e-9;
  };
  for (std::size_t i = 0; i < shell.wall.rest.size(); ++i)
    if (shell.wall.rest[i][0] < 1e-9) shell.fixed[i] = {1, 1, 1};
  const double moment = 2 * pi * E * t * t * t / 12 / length;
  for (int step = 1; step <= 16; ++step) {
    for (std::size_t e = 0; e < shell.wall.edges.size(); ++e) {
      if (at(e, 0)) shell.edge_fixed[e] = 1;
      if (at(e, length)) shell.moment[e] = moment * step / 16 * width / 2;  // two edges share the width
    }
    shell.relax(1e-6, 60);
  }
  const int tip = nearest_node(shell.wall, {length, width / 2, 0});
  const Lanes from_root = shell.state.x[tip] - Lanes{0, width / 2, 0, 0};
  std::printf("  end comes back to %.4f %% of the length\n", 100 * length3(from_root) / length);
  EXPECT_LE(length3(from_root), 0.01 * length);
}

/// F = E′ I δ/(0.149 R³) per length, plane strain, δ the closure (Timoshenko & Young; Roark's Formulas, table 9.2 case 1).
TEST(Shell, RingBetweenTwoPlates) {
  constexpr double R = 12, t = 0.3, E = 1, nu = 0.3, width = 1, push = 1e-7;
  double before = 1;
  for (int n : {8, 16, 32}) {
    const auto map = [&](double u, double v) { return Vec3{R * std::sin(u * pi / 2), R * std::cos(u * pi / 2), v * width}; };
    AtRest shell(make_wall(grid_shell(n, 2, t, map), materials::HookeShell{E, nu}, 1));
    shell.symmetric(0, [](const Lanes& x) { return std::abs(x[0]) < 1e-9; });
    shell.symmetric(1, [](const Lanes& x) { return std::abs(x[1]) < 1e-9; });
    shell.symmetric(2, [&](const Lanes& x) { return std::abs(x[2]) < 1e-9 || std::abs(x[2] - width) < 1e-9; });
    for (double v : {0.0, 0.5, 1.0}) shell.load[nearest_node(shell.wall, map(0, v))] = Lanes{0, -push * (v == 0.5 ? 0.25 : 0.125), 0, 0};
    shell.relax();
    const int top = nearest_node(shell.wall, map(0, 0.5));
    const double closure = 2 * (R - shell.state.x[top][1]), inertia = t * t * t / 12;
    const double error = std::abs(push / width / (E / (1 - nu * nu) * inertia * closure / (0.149 * R * R * R)) - 1);
    std::printf("  %d elements a quarter: error %.2f %%\n", n, 100 * error);
    EXPECT_LT(error, before);
    before = error;
  }
  EXPECT_LE(before, 0.03);
}

Lanes turned(const Lanes& x, double angle) {  // about (1, 2, 2)/3
  const Lanes axis{1 / 3.0, 2 / 3.0, 2 / 3.0, 0};
  return std::cos(angle) * x + std::sin(angle) * cross3(axis, x) + (1 - std::cos(angle)) * dot3(axis, x) * axis;
}

double largest_strain(const Wall& wall, const WallState& state) {
  double largest = 0;
  for (int t = 0; t < static_cast<int>(wall.triangles.size()); ++t) {
    const auto rest = lane(wall.packs[t / 4].rest, t % 4);
    const auto s = elements::shell_strain(rest, now(wall, state, t));
    for (double zeta : {-rest.thickness / 2, rest.thickness / 2}) {
      const auto C = elements::at_layer(s, zeta);
      largest = std::max({largest, std::abs(C.xx - 1) / 2, std::abs(C.yy - 1) / 2, std::abs(C.xy) / 2});
    }
  }
  return largest;
}

Wall curved_patch() {
  return make_wall(grid_shell(3, 3, 0.2, [](double u, double v) { return Vec3{3 * std::sin(u), 3 * std::cos(u) - 2.7, 3 * v - 1.5}; }),
                   materials::MooneyRivlinShell{0.083, 0.0565}, 1e-9);
}

TEST(Shell, TurnedByAnyAngleWithoutStrain) {
  const Wall wall = curved_patch();
  WallState state = rest_state(wall);
  for (auto& x : state.x) x = turned(x, 2.5) + Lanes{10, -20, 30, 0};
  for (auto& d : state.director) d = turned(d, 2.5);
  EXPECT_LE(largest_strain(wall, state), 1e-13);
}

/// A part of a turn in free flight, so slow that the centrifugal strain ρ ω² r²/E is below 1e-9.
TEST(Shell, FreeRigidRotation) {
  const Wall wall = curved_patch();
  Motion motion(wall, no_holds(wall), 1);
  constexpr double speed = 0.3;  // rad/s
  Lanes centre{};
  double mass = 0;
  for (std::size_t i = 0; i < wall.rest.size(); ++i) centre += wall.mass[i] * wall.rest[i], mass += wall.mass[i];
  const Lanes omega = speed * Lanes{1 / 3.0, 2 / 3.0, 2 / 3.0, 0};
  for (std::size_t i = 0; i < wall.rest.size(); ++i) motion.state.v[i] = cross3(omega, wall.rest[i] - centre / mass);
  for (std::size_t e = 0; e < wall.edges.size(); ++e) {
    const Lanes along = wall.rest[wall.edges[e][1]] - wall.rest[wall.edges[e][0]];
    motion.state.spin[e] = dot3(omega, along) / length3(along);
  }
  const double dt = 0.8 * motion.stable().first;
  double worst = 0;
  for (int k = 0; motion.time() < 0.5 / speed; ++k) {
    motion.step(dt);
    if (k % 1000 == 0) worst = std::max(worst, largest_strain(wall, motion.state));
  }
  std::printf("  largest strain %.2e\n", worst);
  EXPECT_LE(worst, 1e-8);
  EXPECT_GT(worst, 0);
}

}  // namespace
}  // namespace palpate::explicit_shell
