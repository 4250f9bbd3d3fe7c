// Shells that stretch: sheets in plane stress to 1.5, a sphere inflated by volume; thickness too.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <map>
#include <numbers>

#include <solver/explicit/wall_fields.hpp>
#include <tests/verify/shell_at_rest.hpp>

namespace palpate::explicit_shell {
namespace {

/// P = 2 (λ − λ⁻²)(C10 + C01/λ), sides and thickness by λ^(−1/2) (Treloar 1975, The Physics of Rubber Elasticity, eq. 5.26).
void pulled(const ShellLaw& law, double C10, double C01) {
  constexpr double stretch = 1.5, t = 0.4;
  AtRest sheet(make_wall(grid_shell(4, 4, t, [](double u, double v) { return Vec3{u * 3, v * 2, 0}; }), law, 1));
  for (std::size_t i = 0; i < sheet.wall.rest.size(); ++i) {
    const Lanes& x = sheet.wall.rest[i];
    sheet.fixed[i] = {x[0] < 1e-9 || x[0] > 3 - 1e-9, x[1] < 1e-9, 1};
    sheet.state.x[i][0] *= stretch;
  }
  sheet.relax(1e-10);
  Slots slots = make_slots(sheet.wall);
  wall_forces(sheet.wall, sheet.state, 0, static_cast<int>(sheet.wall.packs.size()), slots);
  const WallLoad load = gathered(sheet.wall, slots);
  double force = 0;
  for (std::size_t i = 0; i < sheet.wall.rest.size(); ++i)
    if (sheet.wall.rest[i][0] > 3 - 1e-9) force -= load.force[i][0];
  const double wanted = 2 * (stretch - 1 / (stretch * stretch)) * (C10 + C01 / stretch) * 2 * t, side = 1 / std::sqrt(stretch);
  EXPECT_NEAR(force, wanted, 0.005 * wanted);
  const int corner = nearest_node(sheet.wall, {3, 2, 0});
  EXPECT_NEAR(sheet.state.x[corner][1], 2 * side, 0.005 * 2 * side);
  for (const auto& s : triangle_states(sheet.wall, sheet.state)) {
    EXPECT_NEAR(s.thickness, t * side, 0.005 * t * side);
    EXPECT_NEAR(s.von_mises, wanted / (2 * t) * stretch, 0.005 * wanted);  // Cauchy
    EXPECT_NEAR(s.strain, std::log(stretch), 0.005);
  }
}

TEST(Shell, SheetOfNeoHookeanPulled) { pulled(materials::NeoHookeanShell{0.2}, 0.1, 0); }
TEST(Shell, SheetOfMooneyRivlinPulled) { pulled(materials::MooneyRivlinShell{0.083, 0.0565}, 0.083, 0.0565); }

/// An octahedron whose triangles are cut in four, `times` times, its points drawn onto the unit sphere.
ShellMesh ball(int times, double radius, double thickness) {
  ShellMesh mesh;
  mesh.points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int k = 0; k < times; ++k) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [entry, fresh] = middles.try_emplace(std::minmax(a, b), static_cast<int>(mesh.points.size()));
      if (fresh) mesh.points.push_back(unit(mesh.points[a] + mesh.points[b]));
      return entry->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh.triangles = finer;
  }
  for (Vec3& x : mesh.points) x = radius * x;
  mesh.thickness_mm.assign(mesh.points.size(), thickness);
  return mesh;
}

/// p = 2 (t/R)(λ⁻¹ − λ⁻⁷)(2 C10 + 2 C01 λ²): the wall's pull against a given volume 4/3 π (λR)³ (Müller & Strehlow 2004, eq. 3.8).
TEST(Shell, SphereInflatedByVolume) {
  constexpr double R = 10, t = 0.05, C10 = 0.083, C01 = 0.0565;
  for (double stretch : {1.1, 1.5, 2.0}) {
    AtRest sphere(make_wall(ball(4, R, t), materials::MooneyRivlinShell{C10, C01}, 1));
    for (Lanes& x : sphere.state.x) x *= stretch;
    Slots slots = make_slots(sphere.wall);
    wall_forces(sphere.wall, sphere.state, 0, static_cast<int>(sphere.wall.packs.size()), slots);
    const WallLoad load = gathered(sphere.wall, slots);
    double power = 0, rate = 0;  // of a growth of all radii: force · x, and dV = ∮ x·n dA
    for (std::size_t i = 0; i < sphere.wall.rest.size(); ++i) power -= dot3(load.force[i], sphere.state.x[i]);
    for (const auto& [a, b, c] : sphere.wall.triangles) rate += dot3(sphere.state.x[a], cross3(sphere.state.x[b], sphere.state.x[c])) / 2;
    const double wanted = 2 * t / R * (1 / stretch - std::pow(stretch, -7)) * 2 * (C10 + C01 * stretch * stretch);
    EXPECT_NEAR(power / rate, wanted, 0.005 * wanted) << stretch;
    for (const auto& s : triangle_states(sphere.wall, sphere.state)) EXPECT_NEAR(s.thickness, t / (stretch * stretch), 0.005 * t);
  }
}

}  // namespace
}  // namespace palpate::explicit_shell
