// Adhesion: a layer's contact area against its stiffness, pulls against Johnson, Kendall and Roberts', a layer's own and Kendall's flat punch.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <loop/forward/adhesion.hpp>
#include <tests/verify/bonded_layer.hpp>

using namespace palpate::loop;

namespace {

constexpr double mu = 0.01, work = 0.5, R = 5;  // MPa, J/m², mm; E* = 4 μ

Tissue sticky() {
  Tissue tissue;
  tissue.law = &law_named("hooke_linear");
  tissue.parameters = {3 * mu};
  tissue.adhesion_J_per_m2 = work;
  return tissue;
}

Site site_of(const char* kind, double height) { return {{kind, R}, {0, 0, 0}, height, true, Strains::small}; }

/// A tool that was pressed to `deepest`, on that many springs.
Row pressed(const Site& site, double deepest, int count = 2000) {
  const Tissue tissue = sticky();
  std::vector<double> depths, forces;
  for (int i = 0; i <= count; ++i) {
    depths.push_back(deepest * i / count);
    forces.push_back(elastic_force(site, tissue, depths.back()));
  }
  auto springs = springs_of(depths, forces);
  add_adhesion(springs, depths, site, tissue);
  Row row(springs, tissue, deepest, true);
  row.advance(deepest, 1);
  return row;
}

/// Force, N, when it is drawn back to `depth`.
double force_drawn_back(const Site& site, double deepest, double depth) {
  Row row = pressed(site, deepest);
  double force = 0;
  for (double d = deepest; d > depth - 5e-4; d -= 0.001) force = row.advance(d, 1);
  return force;
}

/// Until nothing holds: the largest pull, N.
double largest_pull(const Site& site, double deepest) {
  Row row = pressed(site, deepest);
  double lowest = 0;
  for (double d = deepest; d > -2; d -= 0.001) lowest = std::min(lowest, row.advance(d, 1));
  return -lowest;
}

}  // namespace

/// Without adhesion a contact's stiffness dF/dδ is that of a flat punch of its radius, 8 μ a κ(a/h).
TEST(Adhesion, ALayersContactAreaBelongsToItsStiffness) {
  for (double h : {1e4, 40.0, 20.0, 10.0})
    for (double depth : {0.1, 0.5, 2.0}) {
      const Site site = site_of("ball", h);
      const double slope = (elastic_force(site, sticky(), depth * 1.001) - elastic_force(site, sticky(), depth * 0.999)) / (0.002 * depth);
      const double a = std::sqrt(contact_area(site, sticky(), depth) / M_PI);
      EXPECT_TRUE(std::abs(slope / (8 * mu * a * palpate::verify::punch_on_layer_factor(a / h)) - 1) <= 2e-3) << h << " " << depth;
    }
}

/// At finite strains by GetFEM: bench/hidden/contact_radii.csv, a neo-Hookean layer 20 mm high.
TEST(Adhesion, AContactIsNarrowerAtDepth) {
  Tissue tissue = sticky();
  tissue.law = &law_named("neo_hookean");
  tissue.parameters = {mu};
  for (const auto& [radius, depth, wide] : std::initializer_list<std::array<double, 3>>{{5, 1.15, 2.4514}, {5, 2.3, 3.3681}, {5, 4.6, 4.3110}, {2.5, 1.5, 1.8295}, {2.5, 3.0, 2.26}}) {
    const double a = std::sqrt(contact_area({{"ball", radius}, {0, 0, 0}, 20, true, Strains::finite}, tissue, depth) / M_PI);
    EXPECT_TRUE(std::abs(a / wide - 1) <= 0.01) << radius << " " << depth << " " << a;
  }
}

/// Few springs let go little by little: no stairs in the pull.
TEST(Adhesion, FewSpringsPullAsManyDo) {
  const Site site = site_of("ball", 20);
  Row few = pressed(site, 2, 64), many = pressed(site, 2);
  double most = 0;
  for (double d = 2; d > 0; d -= 0.01) most = std::max(most, std::abs(few.advance(d, 1) - many.advance(d, 1)));
  std::printf("  apart by up to %.1f %% of JKR's pull\n", 100 * most / (1.5 * M_PI * 1e-3 * work * R));
  EXPECT_LE(most, 0.08 * 1.5 * M_PI * 1e-3 * work * R);
}

/// The largest pull is 3/2 π w R under load control, which displacement control passes before it lets go (Johnson 1985, eq. 5.47).
TEST(Adhesion, ABallPullsAsJkrSays) {
  const double pull = largest_pull(site_of("ball", 1e4), 2);
  EXPECT_TRUE(std::abs(pull / (1.5 * M_PI * 1e-3 * work * R) - 1) <= 0.02) << pull;
}

/// Drawn back to where the surface was, F = F_H(a) − K(a) Δ(a) with Δ(a) = √(4π a w/K′(a)) = δ_H(a), δ_H(a) from the integral equation: on a thin layer another pull than on a half-space.
TEST(Adhesion, ABallOnALayerPullsAsItsIntegralEquationSays) {
  constexpr double h = 4, step = 0.04;
  const auto stiffness = [](double a) { return 8 * mu * a * palpate::verify::punch_on_layer_factor(a / h); };
  double a = 0, depth = 0, before = 0, force = 0, K = 0, drawn_back = 1;
  while (depth < drawn_back) {
    const double last = K, at = depth;
    a += step;
    K = stiffness(a);
    depth = h * h / R * palpate::verify::solve_layer(a / h, 0, 1).at_edge / palpate::verify::solve_layer(a / h, 1, 0).at_edge;
    force += 0.5 * (last + K) * (depth - at);  // dF = K dδ
    drawn_back = std::sqrt(4 * M_PI * a * 1e-3 * work * step / (stiffness(a + step / 2) - stiffness(a - step / 2)));
    before = at;
  }
  const double exact = K * drawn_back - force, half_space = -force_drawn_back(site_of("ball", 1e4), 1.5, 0), layer = -force_drawn_back(site_of("ball", h), 1.5, 0);
  std::printf("  pull %.5f N, by the integral equation %.5f N (a = %.2f mm, last step %.4f mm), on a half-space %.5f N\n", layer, exact, a, depth - before, half_space);
  EXPECT_TRUE(std::abs(layer / exact - 1) <= 0.03) << layer << " " << exact;
  EXPECT_TRUE(std::abs(half_space / (8.0 / 9 * 1.5 * M_PI * 1e-3 * work * R) - 1) <= 0.01) << half_space;  // Johnson 1985, eq. 5.46 at δ = 0
  EXPECT_GT(std::abs(layer / half_space - 1), 0.05);
}

/// √(8π E* a³ w) on a half-space (Kendall 1971, J. Phys. D 4:1186); on a layer K(a) √(4π a w/K′(a)).
TEST(Adhesion, AFlatPunchLetsGoAtOnce) {
  const double half_space = largest_pull(site_of("flat_punch", 1e4), 2);
  EXPECT_TRUE(std::abs(half_space / std::sqrt(8 * M_PI * 4 * mu * R * R * R * 1e-3 * work) - 1) <= 0.005) << half_space;
  const auto stiffness = [](double a) { return 8 * mu * a * palpate::verify::punch_on_layer_factor(a / 10); };
  const double slope = (stiffness(R + 0.05) - stiffness(R - 0.05)) / 0.1, layer = largest_pull(site_of("flat_punch", 10), 1);
  EXPECT_TRUE(std::abs(layer / (stiffness(R) * std::sqrt(4 * M_PI * R * 1e-3 * work / slope)) - 1) <= 0.005) << layer;
}
