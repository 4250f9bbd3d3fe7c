// Effects on thin walls: closed forms of each socket.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <numbers>

#include <solver/explicit/closing.hpp>
#include <tests/verify/shell_at_rest.hpp>

namespace palpate::explicit_shell {
namespace {

constexpr double mu = 0.2, thick = 0.4, wide = 2, long_mm = 3;

effects::Active active(const std::string& name, std::vector<double> values) {
  for (const auto& effect : effects::all())
    if (effect.entry.name == name) return {effect, std::move(values)};
  throw std::runtime_error("no effect " + name);
}

elements::Material neo_hookean() {
  for (const auto& law : materials::all())
    if (law.entry.name == "neo_hookean") return {law, {mu}, std::numeric_limits<double>::infinity()};
  throw std::runtime_error("no law");
}

Wall sheet() {
  return make_wall(grid_shell(4, 4, thick, [](double u, double v) { return Vec3{u * long_mm, v * wide, 0}; }), materials::NeoHookeanShell{mu}, 1e-9);
}

/// Pulled by λ along x, free across: x ← λ x, y ← y/√λ.
WallState pulled(const Wall& wall, double stretch) {
  WallState s = rest_state(wall);
  for (Lanes& x : s.x) x[0] *= stretch, x[1] /= std::sqrt(stretch);
  return s;
}

/// The sheet's force at its far end.
double force_of(const Wall& wall, const Slots& slots) {
  const WallLoad load = gathered(wall, slots);
  double force = 0;
  for (std::size_t i = 0; i < wall.rest.size(); ++i)
    if (wall.rest[i][0] > long_mm - 1e-9) force -= load.force[i][0];
  return force;
}

/// Force at the stretch with a tissue, `times` after it was reached at once.
double force_with(const Tissue& tissue, double stretch, const std::vector<double>& steps) {
  const Wall wall = sheet();
  const WallState state = pulled(wall, stretch);
  TissueForces forces(tissue, wall);
  Slots slots = make_slots(wall);
  const int packs = static_cast<int>(wall.packs.size());
  double time = 0;
  for (double dt : steps) {
    wall_forces(wall, state, 0, packs, slots);
    forces.add(state, time += dt, dt, 0, packs, slots);
  }
  return force_of(wall, slots);
}

/// Nominal: μ (λ − λ⁻²) times the section.
double elastic(double modulus, double stretch) { return modulus * (stretch - 1 / (stretch * stretch)) * thick * wide; }

TEST(ShellEffects, PronyFadesInAHold) {
  Tissue tissue{neo_hookean(), {}, {}};
  tissue.material.add(active("prony", {}).effect, {0.3, 0.5, 0.2, 4.0});
  std::vector<double> steps{1e-12};
  double time = 0;
  for (double dt : {0.01, 0.09, 0.4, 0.5, 1.0, 3.0}) {
    steps.push_back(dt);
    time += dt;
    const double wanted = elastic(mu, 1.5) * (1 - 0.3 * (1 - std::exp(-time / 0.5)) - 0.2 * (1 - std::exp(-time / 4)));
    EXPECT_NEAR(force_with(tissue, 1.5, steps), wanted, 1e-6 * wanted) << time;
  }
}

TEST(ShellEffects, StartsScaleTheLaw) {
  const Wall wall = sheet();
  Tissue tissue{neo_hookean(), std::vector<effects::Start>(wall.triangles.size(), {2.5, 0.07}), {}};
  EXPECT_NEAR(force_with(tissue, 1.4, {1e-5}), elastic(2.5 * mu + 0.07, 1.4), 1e-12);
  for (double f : stiffening(tissue, wall)) EXPECT_NEAR(f, 2.5 + 0.07 / mu, 1e-12);
}

TEST(ShellEffects, ALayerPullsAsASkin) {
  const Wall wall = sheet();
  for (double place : {-1.0, 0.0, 1.0}) {
    Tissue tissue{neo_hookean(), {}, {{active("capsule", {0.06, 0}), place, std::vector<char>(wall.triangles.size(), 1)}}};
    const double wanted = elastic(mu, 1.4) + 0.06 / 3 * (1.4 - 1 / (1.4 * 1.4)) * wide;
    EXPECT_NEAR(force_with(tissue, 1.4, {1e-5}), wanted, 1e-12) << place;
  }
}

/// Rolled up to radius R with its middle unstretched: the outer face is wider by t/2R, and a tension T has worked T t/2R per area.
TEST(ShellEffects, ALayerLiesOnItsFace) {
  constexpr double R = 30, T = 0.1;
  const Wall flat = make_wall(grid_shell(12, 12, thick, [](double u, double v) { return Vec3{12 * u, 12 * v, 0}; }), materials::NeoHookeanShell{mu}, 1e-9);
  WallState rolled = rest_state(flat);
  const auto place = [](const Lanes& x) { return Lanes{R * std::sin(x[0] / R), x[1], R * (std::cos(x[0] / R) - 1), 0}; };
  for (std::size_t i = 0; i < flat.rest.size(); ++i) rolled.x[i] = place(flat.rest[i]);
  for (std::size_t e = 0; e < flat.edges.size(); ++e) {
    const auto [a, b] = flat.edges[e];
    const double angle = (flat.rest[a][0] + flat.rest[b][0]) / 2 / R;
    const Lanes along = (rolled.x[b] - rolled.x[a]) / length3(rolled.x[b] - rolled.x[a]);
    Lanes d{std::sin(angle), 0, std::cos(angle), 0};
    d -= dot3(d, along) * along;
    rolled.director[e] = d / length3(d);
  }
  for (double side : {-1.0, 1.0}) {
    const Tissue tissue{neo_hookean(), {}, {{active("capsule", {0, T}), side, std::vector<char>(flat.triangles.size(), 1)}}};
    double energy[2];
    for (int k : {0, 1}) {
      const Tissue none{neo_hookean(), {}, {}};
      TissueForces forces(k == 0 ? none : tissue, flat);
      Slots slots = make_slots(flat);
      const int packs = static_cast<int>(flat.packs.size());
      wall_forces(flat, rest_state(flat), 0, packs, slots);
      forces.add(rest_state(flat), 0, 0, 0, packs, slots);
      wall_forces(flat, rolled, 0, packs, slots);
      forces.add(rolled, 1e-3, 1e-3, 0, packs, slots);
      energy[k] = gathered(flat, slots).energy;
    }
    const double wanted = side * T * 144 * thick / 2 / R;
    EXPECT_NEAR(energy[1] - energy[0], wanted, 0.03 * std::abs(wanted)) << side;
  }
}

/// Every law: P in three dimensions with the pressure taken out is the law for thin walls.
TEST(ShellEffects, PlaneStressIsThatOfTheShellLaws) {
  const materials::InPlane<double> C{1.44, 0.81, 0.3};
  const auto compare = [&](const std::string& name, const std::vector<double>& values, const auto& shell) {
    for (const auto& law : materials::all()) {
      if (law.entry.name != name) continue;
      const auto F = upper_root(C);
      const auto S = plane_stress(F, law.respond(F, values).P), wanted = shell(C).S;
      const double size = std::abs(wanted.xx) + std::abs(wanted.yy);
      EXPECT_NEAR(S.xx, wanted.xx, 1e-12 * size) << name;
      EXPECT_NEAR(S.yy, wanted.yy, 1e-12 * size) << name;
      EXPECT_NEAR(S.xy, wanted.xy, 1e-12 * size) << name;
    }
  };
  compare("neo_hookean", {0.2}, materials::NeoHookeanShell{0.2});
  compare("mooney_rivlin", {0.083, 0.0565}, materials::MooneyRivlinShell{0.083, 0.0565});
  compare("yeoh", {0.1, 0.05, 0.02}, materials::YeohShell{0.1, 0.05, 0.02});
  compare("fung_demiray", {0.1, 1.5}, materials::FungDemirayShell{0.1, 1.5});
  compare("ogden", {0.1, 3, 0.05, -2, 0, 1}, materials::OgdenShell{{0.1, 0.05, 0}, {3, -2, 1}});
  compare("hooke", {0.3, 0.5}, materials::HookeShell{0.3, 0.5});
}

/// A plate of the wall under the upper jaw, moved.
struct Gripped {
  Wall wall;
  WallState state;
  static constexpr double stiffness = 1e6, depth = 0.1;

  Lanes force_at(Jaws& jaws, const Lanes& shift) {
    for (std::size_t i = 0; i < 81; ++i) state.x[i] = wall.rest[i] + shift;  // the floor stays
    FewForces force(wall.rest.size());
    jaws.look(wall, state);
    jaws.touch(wall, state, stiffness, 0, force);
    jaws.remember();
    Lanes sum{};
    for (std::size_t i = 0; i < 81; ++i) sum += force[i];
    return sum;
  }
};

Clamp clamp_with(std::vector<effects::Active> tractions) {
  Clamp c;
  c.centre = {0, 0, 0};
  c.axis = {0, -1, 0};
  c.along = {0, 0, 1};
  c.gap = 0.1;
  c.tractions = std::move(tractions);
  return c;
}

/// A tube is asked for between the jaws: a second plate lies far below, on the lower one.
Gripped with_floor() {
  ShellMesh mesh = grid_shell(8, 8, 1, [](double u, double v) { return Vec3{8 * (u - 0.5), 0, 8 * (0.5 - v)}; });
  const auto floor = grid_shell(2, 2, 1, [](double u, double v) { return Vec3{8 * (u - 0.5), -20, 8 * (0.5 - v)}; });
  const int first = static_cast<int>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), floor.points.begin(), floor.points.end());
  for (const auto& [a, b, c] : floor.triangles) mesh.triangles.push_back({a + first, b + first, c + first});
  mesh.thickness_mm.assign(mesh.points.size(), 1);
  const Wall wall = make_wall(mesh, materials::NeoHookeanShell{mu}, 1e-9);
  return {wall, rest_state(wall)};
}

/// The upper plate's mass: 81 of 90 nodes, but by area.
double plate_mass(const Wall& wall) {
  double sum = 0;
  for (std::size_t i = 0; i < 81; ++i) sum += wall.mass[i];
  return sum;
}

TEST(ShellEffects, FrictionSticksAndSlides) {
  Gripped g = with_floor();
  const double m = 0.3;
  Jaws jaws(clamp_with({active("friction", {m})}), g.wall);
  const double pressed = Gripped::stiffness * Gripped::depth * plate_mass(g.wall), stiff = Gripped::stiffness * plate_mass(g.wall);
  const Lanes in{0, Gripped::depth, 0, 0};  // up, into the upper jaw
  EXPECT_NEAR(g.force_at(jaws, in)[1], -pressed, 1e-9 * pressed);
  for (const double shift : {0.01, 0.025, 0.0}) {  // sticks: as far back as there
    const Lanes f = g.force_at(jaws, in + Lanes{shift, 0, 0, 0});
    EXPECT_NEAR(f[0], -stiff * shift, 1e-9 * pressed) << shift;
  }
  for (const double shift : {0.5, 0.9, 2.0}) EXPECT_NEAR(g.force_at(jaws, in + Lanes{shift, 0, 0, 0})[0], -m * pressed, 1e-4 * pressed) << shift;
  const double back = g.force_at(jaws, in + Lanes{1.98, 0, 0, 0})[0];  // holds on where it slid to
  EXPECT_NEAR(back, -m * pressed + 0.02 * stiff, 1e-4 * pressed);
}

TEST(ShellEffects, AdhesionHoldsWithinItsRange) {
  Gripped g = with_floor();
  const double w = 0.4, range = 0.8;  // J/m², mm
  Jaws jaws(clamp_with({active("adhesion", {w, range})}), g.wall);
  const double area = 64;
  for (double gap : {0.2, 0.4, 0.7}) {
    const double wanted = 1e-3 * w / range * (1 + std::cos(std::numbers::pi * gap / range)) * area;
    EXPECT_NEAR(g.force_at(jaws, Lanes{0, -gap, 0, 0})[1], wanted, 1e-9 * wanted) << gap;
  }
  EXPECT_EQ(g.force_at(jaws, Lanes{0, -0.81, 0, 0})[1], 0);
}

TEST(ShellEffects, ABedPushesBack) {
  const Wall wall = sheet();
  const Bed bed = make_bed(active("support", {0.02, 0.5, 1e6}), wall, {0, 1, 2, 3, 4, 5});
  WallState state = rest_state(wall);
  for (Lanes& x : state.x) x += Lanes{0.1, 0, 0.2, 0};
  std::vector<Lanes> load(wall.rest.size(), Lanes{});
  press({bed}, wall, state, load);
  Lanes sum{};
  for (const Lanes& f : load) sum += f;
  const double area = 6 * wall.packs[0].rest.area[0];
  EXPECT_NEAR(sum[2], -0.02 * 0.2 * area, 1e-12);
  EXPECT_NEAR(sum[0], -0.01 * 0.1 * area, 1e-12);
  const double lightest = 1.0 / 3 * wall.density * thick * wall.packs[0].rest.area[0];
  EXPECT_GT(stiffness_per_mass({bed}, wall), 0);
  EXPECT_LE(stiffness_per_mass({bed}, wall), 0.02 * wall.packs[0].rest.area[0] / 3 / lightest * (1 + 1e-9));
}

}  // namespace
}  // namespace palpate::explicit_shell
