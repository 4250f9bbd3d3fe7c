// Implicit shapes: closed-form volumes, gradients no longer than 1, contours that are closed, outward and on the zero level.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/implicit_shapes.hpp>

#include <gtest/gtest.h>

#include <map>
#include <numbers>
#include <set>

#include <pipeline/image/marching_tetrahedra.hpp>
#include <pipeline/image/phantom_organs.hpp>
#include <pipeline/image/phantom_truth.hpp>

using namespace palpate;

namespace {

constexpr double pi = std::numbers::pi;

struct Known {
  const char* name;
  Implicit shape;
  Box box;
  double volume_mm3;
};

std::vector<Known> known_shapes() {
  const double ra = 4, rb = 2, h = 10;  // frustum between the circles where the cone touches the balls, and two caps
  const double s = (ra - rb) / h, c2 = 1 - s * s;
  const auto cap = [](double r, double height) { return pi * height * height * (3 * r - height) / 3; };
  const double r1 = ra * std::sqrt(c2), r2 = rb * std::sqrt(c2), length = h - ra * s + rb * s;
  const double cone = pi * length * (r1 * r1 + r1 * r2 + r2 * r2) / 3 + cap(ra, ra + ra * s) + cap(rb, rb - rb * s);
  return {
      {"ball", ball({1, 2, 3}, 5), {{-4.3, -3.1, -2.2}, {6.1, 7.4, 8.3}}, 4 * pi / 3 * 125},
      {"capsule", capsule({0, 0, 0}, {3, 4, 0}, 2), {{-2.1, -2.2, -2.3}, {5.1, 6.2, 2.4}}, 4 * pi / 3 * 8 + pi * 4 * 5},
      {"torus", arc_tube({0, 0, 0}, 10, pi, 3), {{-13.1, -3.2, -13.3}, {13.2, 3.1, 13.4}}, 2 * pi * pi * 10 * 9},
      {"half torus", arc_tube({0, 0, 0}, 10, pi / 2, 3), {{-3.2, -3.1, -13.2}, {13.1, 3.3, 13.1}}, pi * pi * 10 * 9 + 4 * pi / 3 * 27},
      {"ellipsoid", stretched(ball({0, 0, 0}, 1), {8, 5, 3}), {{-8.1, -5.1, -3.1}, {8.2, 5.2, 3.2}}, 4 * pi / 3 * 120},
      {"round cone", round_cone({0, 0, 0}, ra, {0, 0, h}, rb), {{-4.1, -4.2, -4.3}, {4.2, 4.1, 12.2}}, cone},
      {"tube", polyline_tube({{0, 0, 0}, {5, 0, 0}, {12, 0, 0}}, 2), {{-2.1, -2.2, -2.3}, {14.1, 2.2, 2.1}}, 4 * pi / 3 * 8 + pi * 4 * 12},
      {"kidney without bend and hilum", kidney({.length_mm = 60, .width_mm = 30, .thickness_mm = 20, .fullness = 0.99999, .hilum_depth_mm = 0}).shape,
       {{-15.1, -10.1, -30.1}, {15.2, 10.2, 30.2}}, (4 * pi / 3 * 3375 + pi * 225 * 30) * 20 / 30},
  };
}

/// Every directed edge once, its opposite once.
bool is_closed(const TriangleSoup& s) {
  std::set<std::pair<int, int>> edges;
  for (const auto& t : s.triangles)
    for (int i = 0; i < 3; ++i)
      if (!edges.insert({t[i], t[(i + 1) % 3]}).second) return false;
  for (const auto& [a, b] : edges)
    if (!edges.contains({b, a})) return false;
  return true;
}

}  // namespace

TEST(ImplicitShapes, VolumesAreThoseOfTheBooks) {
  for (const Known& k : known_shapes())  // 1e-3: 64 cells along the box
    EXPECT_NEAR(integrate(k.shape, k.box, 6, 2).volume_mm3 / k.volume_mm3, 1, 1e-3) << k.name;
}

TEST(ImplicitShapes, IntegralIsTheSameForEveryNumberOfThreads) {
  const Known k = known_shapes().front();
  EXPECT_EQ(integrate(k.shape, k.box, 6, 1).volume_mm3, integrate(k.shape, k.box, 6, 3).volume_mm3);
}

TEST(ImplicitShapes, NeverChangeFasterThanDistance) {
  std::vector<Known> shapes = known_shapes();
  const Organ organs[] = {kidney({}), colon({}), uterus({})};
  for (const Organ& organ : organs) {
    shapes.push_back({"organ", organ.shape, organ.box, 0});
    for (std::size_t p = 0; p < organ.parts.size(); ++p) shapes.push_back({"part", part_alone(organ, int(p)), organ.box, 0});
  }
  for (const Known& k : shapes) {
    const Vec3 d = (1.0 / 23) * (k.box.max - k.box.min);
    for (int i = 0; i < 23 * 23; ++i) {
      const Vec3 x = k.box.min + Vec3{(i % 23 + 0.37) * d[0], (i / 23 + 0.61) * d[1], ((i * 7) % 23 + 0.53) * d[2]};
      EXPECT_LE(norm(gradient(k.shape, x, 1e-5)), 1 + 1e-6) << k.name;
    }
  }
}

TEST(MarchingTetrahedra, ClosedOutwardAndOnTheZeroLevel) {
  std::vector<Known> shapes = known_shapes();
  const Organ bean = kidney({});
  shapes.push_back({"bean", bean.shape, bean.box, integrate(bean.shape, bean.box, 7, 2).volume_mm3});
  for (const Known& k : shapes) {
    const TriangleSoup soup = contour(k.shape, k.box, norm(k.box.max - k.box.min) / 60, 2);
    EXPECT_TRUE(is_closed(soup)) << k.name;
    EXPECT_NEAR(enclosed_mm3(soup) / k.volume_mm3, 1, 0.01) << k.name;  // chords cut at 60 cells along the diagonal
    double worst = 0;
    for (const Vec3& p : soup.points) worst = std::max(worst, std::abs(k.shape(p)));
    EXPECT_LE(worst, 1e-6) << k.name;
  }
}

TEST(MarchingTetrahedra, SphereHasItsArea) {
  const TriangleSoup soup = contour(ball({0.1, 0.2, 0.3}, 10), {{-10, -10, -10}, {10.5, 10.5, 10.5}}, 0.5, 1);
  EXPECT_NEAR(area_mm2(soup) / (4 * pi * 100), 1, 2e-3);
}

TEST(PhantomOrgans, KidneyIsABeanOfItsSize) {
  for (const KidneyShape& k : {KidneyShape{}, KidneyShape{.length_mm = 60, .width_mm = 35, .thickness_mm = 25, .cortex_mm = 4, .hilum_depth_mm = 4}}) {
    EXPECT_EQ(defect_of(k), "");
    const Organ organ = kidney(k);
    const TriangleSoup soup = contour(organ.shape, organ.box, k.length_mm / 60, 2);
    Box box{soup.points[0], soup.points[0]};
    for (const Vec3& p : soup.points)
      for (int i = 0; i < 3; ++i) {
        box.min[i] = std::min(box.min[i], p[i]);
        box.max[i] = std::max(box.max[i], p[i]);
      }
    for (int i = 0; i < 3; ++i) {  // lattice points need not meet the very tip: 0.3 mm
      EXPECT_NEAR(box.min[i], organ.box.min[i], 0.3);
      EXPECT_NEAR(box.max[i], organ.box.max[i], 0.3);
    }
    EXPECT_GT(organ.shape({-k.width_mm / 2 + 1, 0, 0}), 0) << "the hilum is open";
    EXPECT_LT(organ.shape(organ.seed), -3);
    std::set<int> found;
    for (const OrganPart& part : organ.parts)
      if (integrate(part_alone(organ, int(&part - organ.parts.data())), organ.box, 6, 2).volume_mm3 > 0.01 * enclosed_mm3(soup)) found.insert(part.label);
    EXPECT_EQ(found, (std::set<int>{1, 2, 3}));
  }
}

TEST(PhantomOrgans, ColonHasAWallOfItsThickness) {
  const ColonShape c;
  EXPECT_EQ(defect_of(c), "");
  const Organ organ = colon(c);
  for (const auto& x : {Vec3{-45, 0, -40}, Vec3{-38, 0, 32}, Vec3{38, 4, 0}}) EXPECT_EQ(organ.parts[part_at(organ, x)].name, "lumen");
  const TriangleSoup lumen = contour(organ.parts[0].shape, organ.box, 2.5, 2);
  for (const Vec3& p : lumen.points) EXPECT_NEAR(organ.shape(p), -c.wall_mm, 1e-6);
}

TEST(PhantomOrgans, UterusIsAPearOfItsSizeWithATubeOverAnOvary) {
  const UterusShape u;
  EXPECT_EQ(defect_of(u), "");
  UterusShape bare = u;
  bare.tube_length_mm = bare.ovary_length_mm = 0;
  const Organ pear = uterus(bare), all = uterus(u);
  // The hull of two balls, flattened: its volume as in known_shapes, its box by its dimensions.
  const double a = bare.width_mm / 2, b = bare.cervix_mm / 2, h = bare.length_mm - a - b, s = (a - b) / h, c2 = 1 - s * s;
  const auto cap = [](double r, double height) { return pi * height * height * (3 * r - height) / 3; };
  const double cone = pi * (h - a * s + b * s) * c2 * (a * a + a * b + b * b) / 3 + cap(a, a + a * s) + cap(b, b - b * s);
  EXPECT_NEAR(integrate(pear.shape, pear.box, 7, 2).volume_mm3 / (cone * bare.thickness_mm / bare.width_mm), 1, 1e-3);
  EXPECT_EQ(pear.parts.size(), 1u);
  const TriangleSoup soup = contour(pear.shape, pear.box, 1, 2);
  Vec3 high = soup.points[0];
  for (const Vec3& p : soup.points)
    for (int i = 0; i < 3; ++i) high[i] = std::max(high[i], p[i]);
  EXPECT_NEAR(high[0], u.width_mm / 2, 0.1);
  EXPECT_NEAR(high[1], u.thickness_mm / 2, 0.1);
  EXPECT_NEAR(high[2], u.length_mm / 2, 0.1);
  // Ovary: an ellipsoid, and 1.8 mm of its ligament (some 60 mm³). Tube: a circle along its length and a round end, but for its slanted root.
  const double ellipsoid = pi / 6 * u.ovary_length_mm * u.ovary_width_mm * u.ovary_thickness_mm, r = u.tube_mm / 2;
  const auto volume = [&](int part) { return integrate(part_alone(all, part), all.box, 8, 2).volume_mm3; };
  ASSERT_EQ(all.parts.size(), 3u);
  EXPECT_EQ(all.parts[0].name, "ovary");
  EXPECT_NEAR((volume(0) - 60) / ellipsoid, 1, 5e-3);
  EXPECT_EQ(all.parts[1].name, "tube");
  EXPECT_NEAR(volume(1) / (pi * r * r * u.tube_length_mm + 2 * pi / 3 * r * r * r), 1, 0.03);
  EXPECT_NEAR((volume(0) + volume(1) + volume(2)) / integrate(all.shape, all.box, 8, 2).volume_mm3, 1, 1e-3);
  EXPECT_EQ(all.parts[2].name, "uterus");
}

TEST(PhantomOrgans, TubeAndOvaryDoNotTouch) {
  const UterusShape u;
  const Organ organ = uterus(u);
  EXPECT_EQ(defect_of({.tube_length_mm = 30}).substr(0, 24), "the tube is too short to");
  double gap = 1e9;  // from points of the ovary's ellipsoid to the tube, outside of both
  const TriangleSoup egg = contour(offset(organ.parts[0].shape, -1), organ.box, 2, 2);  // the parts reach 1 mm further
  for (const Vec3& p : egg.points) gap = std::min(gap, organ.parts[1].shape(p) + 1);
  EXPECT_GE(gap, 0.6 * u.gap_mm);
  const TriangleSoup soup = contour(organ.shape, organ.box, 1.5, 2);
  std::set<std::pair<int, int>> edges;
  for (const auto& t : soup.triangles)
    for (int i = 0; i < 3; ++i) edges.insert(std::minmax(t[i], t[(i + 1) % 3]));
  EXPECT_EQ(soup.points.size() + soup.triangles.size() - edges.size(), 2u) << "Euler: one piece without a handle";
}
