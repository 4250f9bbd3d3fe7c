// The obstacle course of shells at 1 % of the load: Scordelis-Lo roof 0.3024, pinched cylinder with diaphragms 1.8248e-5, pinched
// hemisphere with an 18° hole 0.0940. (MacNeal & Harder 1985, Finite Elem. Anal. Des. 1:3; Belytschko et al. 1985, Comput. Methods
// Appl. Mech. Eng. 51:221.)
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <numbers>

#include <tests/verify/shell_at_rest.hpp>

namespace palpate::explicit_shell {
namespace {

constexpr double part = 0.01;  // of the load; the answers are linear
constexpr double pi = std::numbers::pi;
constexpr auto zero = [](double v) { return std::abs(v) < 1e-9; };

/// A quarter: x across, y along, z up.
double roof(int n) {
  constexpr double R = 25, half_length = 25, edge = 40 * pi / 180, per_area = 90;
  const auto map = [](double u, double v) { return Vec3{R * std::sin(u * edge), v * half_length, R * std::cos(u * edge)}; };
  AtRest shell(make_wall(grid_shell(n, n, 0.25, map), materials::HookeShell{4.32e8, 0}, 1));
  shell.symmetric(0, [](const Lanes& x) { return zero(x[0]); });
  shell.symmetric(1, [](const Lanes& x) { return zero(x[1]); });
  for (std::size_t i = 0; i < shell.wall.rest.size(); ++i) {
    if (zero(shell.wall.rest[i][1] - half_length)) shell.fixed[i][0] = shell.fixed[i][2] = 1;  // the diaphragm
    shell.load[i] = Lanes{0, 0, -part * per_area * shell.wall.mass[i] / 0.25, 0};
  }
  shell.relax();
  const int corner = nearest_node(shell.wall, map(1, 0));
  return (shell.wall.rest[corner][2] - shell.state.x[corner][2]) / part;
}

/// An eighth: axis along y.
double cylinder(int n) {
  constexpr double R = 300, half_length = 300;
  const auto map = [](double u, double v) { return Vec3{R * std::sin(u * pi / 2), v * half_length, R * std::cos(u * pi / 2)}; };
  AtRest shell(make_wall(grid_shell(n, n, 3, map), materials::HookeShell{3e6, 0.3}, 1));
  shell.symmetric(0, [](const Lanes& x) { return std::abs(x[0]) < 1e-6; });
  shell.symmetric(1, [](const Lanes& x) { return std::abs(x[1]) < 1e-6; });
  shell.symmetric(2, [](const Lanes& x) { return std::abs(x[2]) < 1e-6; });
  for (std::size_t i = 0; i < shell.wall.rest.size(); ++i)
    if (zero(shell.wall.rest[i][1] - half_length)) shell.fixed[i][0] = shell.fixed[i][2] = 1;
  const int top = nearest_node(shell.wall, {0, 0, R});
  shell.load[top] = Lanes{0, 0, -part / 4, 0};
  shell.relax(1e-2);  // the load is 1e-10 of the stiffness: round-off ends here
  return (R - shell.state.x[top][2]) / part;
}

/// A quarter: axis along z.
double hemisphere(int n) {
  constexpr double R = 10, hole = 18 * pi / 180;
  const auto map = [](double u, double v) {
    const double up = v * (pi / 2 - hole);
    return Vec3{R * std::cos(up) * std::cos(u * pi / 2), R * std::cos(up) * std::sin(u * pi / 2), R * std::sin(up)};
  };
  AtRest shell(make_wall(grid_shell(n, n, 0.04, map), materials::HookeShell{6.825e7, 0.3}, 1));
  shell.symmetric(0, [](const Lanes& x) { return zero(x[0]); });
  shell.symmetric(1, [](const Lanes& x) { return zero(x[1]); });
  const int a = nearest_node(shell.wall, {R, 0, 0}), b = nearest_node(shell.wall, {0, R, 0});
  shell.fixed[a][2] = 1;
  shell.load[a] = Lanes{part, 0, 0, 0};
  shell.load[b] = Lanes{0, -part, 0, 0};
  shell.relax();
  return (shell.state.x[a][0] - R) / part;
}

void converges(double (*run)(int), double answer, const std::vector<int>& sizes) {
  double before = std::numeric_limits<double>::infinity();
  for (int n : sizes) {
    const double value = run(n), error = std::abs(value / answer - 1);
    std::printf("  %3d x %-3d  %.6g  error %.2f %%\n", n, n, value, 100 * error);
    EXPECT_LT(error, before) << n;
    before = error;
  }
  EXPECT_LE(before, 0.03);
}

TEST(Shell, ScordelisLoRoof) { converges(roof, 0.3024, {8, 16, 32}); }
TEST(Shell, PinchedCylinder) { converges(cylinder, 1.8248e-5, {24, 48, 96}); }
TEST(Shell, PinchedHemisphere) { converges(hemisphere, 0.0940, {8, 16, 32}); }

}  // namespace
}  // namespace palpate::explicit_shell
