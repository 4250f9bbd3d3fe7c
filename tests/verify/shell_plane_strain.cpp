// The clamp's cross-section as a long tube in plane strain, closed by two plates: force per length of the explicit shells beside solid elements of
// the implicit scheme, a quarter of the section, the same Mooney-Rivlin law, up to the first contact of the wall with itself.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <numbers>

#include <solver/explicit/closing.hpp>
#include <solver/implicit/steps.hpp>
#include <tests/verify/organs.hpp>
#include <tests/verify/shapes.hpp>

namespace palpate {
namespace {

constexpr double outer = 12.5, C10 = 0.083, C01 = 0.0565;

/// Force per length (N/mm) at plates' gaps (mm), ascending in closure.
using Curve = std::vector<std::array<double, 2>>;

double at_gap(const Curve& curve, double gap) {
  for (std::size_t i = 1; i < curve.size(); ++i)
    if (curve[i][0] <= gap) {
      const double part = (curve[i - 1][0] - gap) / (curve[i - 1][0] - curve[i][0]);
      return curve[i - 1][1] + part * (curve[i][1] - curve[i - 1][1]);
    }
  return std::numeric_limits<double>::quiet_NaN();
}

/// Up to `last_gap`. `first_touch`: gap at which the wall first meets itself, or 0.
Curve by_shells(double wall, double edge, double last_gap, double& first_touch) {
  using namespace explicit_shell;
  const double mid = outer - wall / 2, length = 3 * edge * std::sqrt(0.75);
  const int around = 2 * static_cast<int>(std::round(std::numbers::pi * mid / edge)), rings = 3;
  Case c;
  for (int r = 0; r <= rings; ++r)
    for (int i = 0; i < around; ++i) {
      const double a = 2 * std::numbers::pi * (i + 0.5 * (r % 2)) / around;
      c.mesh.points.push_back({mid * std::cos(a), mid * std::sin(a), length * r / rings});
      c.mesh.thickness_mm.push_back(wall);
      c.mesh.end.push_back(r == 0 ? 1 : r == rings ? 2 : 0);
    }
  for (int r = 0; r < rings; ++r)
    for (int i = 0; i < around; ++i) {
      const int p = r * around + i, q = r * around + (i + 1) % around, s = p + around, t = q + around;
      if (r % 2 == 0) c.mesh.triangles.insert(c.mesh.triangles.end(), {{p, q, s}, {q, t, s}});
      else c.mesh.triangles.insert(c.mesh.triangles.end(), {{p, q, t}, {p, t, s}});
    }
  c.wall = make_wall(c.mesh, materials::MooneyRivlinShell{C10, C01}, 1.05e-9);
  c.holds = no_holds(c.wall);
  for (std::size_t i = 0; i < c.mesh.points.size(); ++i)
    if (c.mesh.end[i] != 0) c.holds.hold[i] = Hold::across, c.holds.direction[i] = Lanes{0, 0, 1, 0};
  for (std::size_t e = 0; e < c.wall.edges.size(); ++e) {
    const auto [a, b] = c.wall.edges[e];
    c.holds.edge_fixed[e] = c.mesh.end[a] != 0 && c.mesh.end[a] == c.mesh.end[b];
  }
  c.clamp.centre = {0, 0, length / 2};
  c.clamp.axis = {0, -1, 0};
  c.clamp.along = {0, 0, 1};
  c.clamp.width = 60;
  c.clamp.length = length + 4;
  c.clamp.gap = last_gap;
  c.clamp.speed = 30;  // faster, and a wall of 0.8 mm drags by a tenth of its force
  c.damping = 30;
  c.rows = 100;
  Closing closing(c, 1);
  Curve curve;
  first_touch = 0;
  closing.run([&](const Row& row) {
    curve.push_back({row.gap, row.closing_force / length});
    if (first_touch == 0 && row.self_area > 0) first_touch = row.gap;
  }, [](const Row&) {});
  return curve;
}

Curve by_solids(double wall, int arc, int through, double last_gap) {
  using verify::uniform;
  const double width = (outer - wall / 2) * std::numbers::pi / 2 / arc;
  auto model = verify::brick(uniform(0, 1, arc), uniform(0, 1, through), uniform(0, width, 1));
  for (auto& x : model.points) {
    const double a = std::numbers::pi / 2 * x.x(), r = outer - wall + wall * x.y();
    x = {r * std::sin(a), r * std::cos(a), x.z()};
  }
  model.materials = {verify::material("mooney_rivlin", {C10, C01})};
  for (int i = 0; i < static_cast<int>(model.points.size()); ++i) {
    const auto& x = model.points[i];
    model.prescribed.push_back({i, 2, 0});
    if (x.x() < 1e-9) model.prescribed.push_back({i, 0, 0});
    if (x.y() < 1e-9) model.prescribed.push_back({i, 1, 0});
  }
  contact::Tool plate{verify::tool_named("flat_punch"), {60.0, 0.5}, -Eigen::Vector3d::UnitY(), {0, outer, 0}, outer - last_gap / 2, {{{0, 0}, {1, 1}}}};
  model.tools = {plate};
  implicit::Equilibrium equilibrium(model, 1);
  auto state = implicit::rest_state(model);
  Curve curve;
  const double reached = run_steps(equilibrium, state, {uniform(0, 1, 24)}, [&](const implicit::Step& step) {
    const double force = step.index == 0 ? 0 : step.equations.contact.tools[0].force.norm();
    curve.push_back({2 * (outer - plate.travel(step.state.time)), 2 * force / width});
  });
  if (reached < 1) std::printf("  solids came to gap %.3f mm: %s\n", curve.back()[0], equilibrium.trouble().cause.c_str());
  return curve;
}

/// Linear tetrahedra are stiff in bending by the square of their size (measured with two, four and eight through 1.4 mm: 2.0 to 2.2): the limit of two meshes.
TEST(PlaneStrain, TubeBetweenTwoPlates) {
  constexpr double wall = 1.4, last = 10;
  double touch = 0;
  const auto shells = by_shells(wall, 1, last, touch), coarse = by_solids(wall, 60, 2, last), fine = by_solids(wall, 120, 4, last);
  EXPECT_EQ(touch, 0);  // not yet
  for (double gap = 23; gap > last + 0.25; gap -= 1.5) {
    const double limit = at_gap(fine, gap) - (at_gap(coarse, gap) - at_gap(fine, gap)) / 3, ours = at_gap(shells, gap);
    std::printf("  gap %5.2f mm: shells %.6f N/mm, solids %.6f N/mm, %+.2f %%\n", gap, ours, limit, 100 * (ours / limit - 1));
    EXPECT_NEAR(ours, limit, 0.05 * limit) << gap;
  }
}

}  // namespace
}  // namespace palpate
