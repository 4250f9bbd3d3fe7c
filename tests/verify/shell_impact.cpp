// Two shell patches that meet, head-on and grazing: momentum and energy are kept, nothing passes through.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <solver/explicit/self_contact.hpp>
#include <tests/verify/shell_at_rest.hpp>

namespace palpate::explicit_shell {
namespace {

constexpr double thickness = 1, area_mm = 20;

/// One patch below, one turned by 30° above it, both facing up.
Wall two_patches() {
  ShellMesh mesh = grid_shell(8, 8, thickness, [](double u, double v) { return Vec3{area_mm * (u - 0.5), area_mm * (v - 0.5), 0}; });
  const ShellMesh other = grid_shell(7, 7, thickness, [](double u, double v) {
    const double x = area_mm * (u - 0.5), y = area_mm * (v - 0.5);
    return Vec3{0.866 * x - 0.5 * y, 0.5 * x + 0.866 * y, 2.5};
  });
  const int first = static_cast<int>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
  for (const auto& [a, b, c] : other.triangles) mesh.triangles.push_back({a + first, b + first, c + first});
  mesh.thickness_mm.assign(mesh.points.size(), thickness);
  return make_wall(mesh, materials::MooneyRivlinShell{0.083, 0.0565}, 1.05e-9);
}

void meet(const Lanes& speed) {
  const Wall wall = two_patches();
  Motion motion(wall, no_holds(wall), 1);
  SelfContact contact(wall);
  Lanes momentum{};
  double scale = 0;
  for (std::size_t i = 0; i < wall.rest.size(); ++i) {
    motion.state.v[i] = (wall.rest[i][2] < 1 ? 1.0 : -0.5) * speed;
    momentum += wall.mass[i] * motion.state.v[i];
    scale += wall.mass[i] * length3(motion.state.v[i]);
  }
  const double energy = motion.ledger().kinetic, usual = 0.7 * motion.stable().first, dt = usual / 4;  // a contact lasts a few usual steps only
  double deepest_energy = 0;
  bool touched = false;
  FewForces force(wall.rest.size());
  for (int k = 0; motion.time() < 3 * 1.5 / (1.5 * speed[2]); ++k) {  // three times the way they have to go
    force.clear();
    contact.touch(motion.state, {0.4 / (usual * usual), 0, 0}, force);
    for (std::size_t i = 0; i < wall.rest.size(); ++i) motion.outside.contact[i] = force[i];
    touched |= contact.touching();
    motion.step(dt);
    if (k % 80 == 0) {
      EXPECT_EQ(crossings(wall, motion.state.x), 0) << k;
    }
    const Ledger l = motion.ledger();
    deepest_energy = std::max(deepest_energy, l.contact / energy);
  }
  EXPECT_TRUE(touched);
  EXPECT_FALSE(contact.touching());
  const Ledger after = motion.ledger();
  Lanes kept{};
  for (std::size_t i = 0; i < wall.rest.size(); ++i) kept += wall.mass[i] * motion.state.v[i];
  std::printf("  energy %.4f %%, momentum %.1e, most in contact %.1f %%\n", 100 * ((after.kinetic + after.internal) / energy - 1),
              length3(kept - momentum) / scale, 100 * deepest_energy);
  EXPECT_NEAR(after.kinetic + after.internal, energy, 0.01 * energy);
  EXPECT_LE(length3(kept - momentum), 0.01 * scale);
  EXPECT_GT(deepest_energy, 0.01);
}

TEST(Shell, HeadOnImpact) { meet(Lanes{0, 0, 1000, 0}); }
TEST(Shell, GrazingImpact) { meet(Lanes{2000, 500, 500, 0}); }

}  // namespace
}  // namespace palpate::explicit_shell
