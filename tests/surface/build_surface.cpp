// Labels of known shapes become surfaces of the right volume, place and smoothness.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/surface/build_surface.hpp>

#include <gtest/gtest.h>

#include <numbers>

#include <palpate/errors.hpp>
#include <pipeline/surface/checks.hpp>
#include <pipeline/surface/measure.hpp>
#include <tests/surface/shapes/shapes.hpp>

namespace palpate {
namespace {

using test::ball, test::labels_of, test::torus;

constexpr double pi = std::numbers::pi;

struct Built {
  Surface surface;
  SurfaceLedger ledger;
};

Built build(const Labels& labels, const SurfaceOptions& options = {}) {
  Built built;
  built.surface = build_surface(labels, options, built.ledger, [](const std::string&) {});
  return built;
}

void expect_sound(const Built& built) {
  SurfaceLimits limits;
  limits.volume_mm3 = built.ledger.voxels_mm3;
  for (const Check& check : surface_checks(built.surface, limits))
    EXPECT_TRUE(check.pass) << check.name << " " << check.value << " " << check.where;
}

/// How far a surface is from a ball of radius R about the origin: in place, and in direction (a staircase is near in place, not
/// in direction).
struct BallError {
  double worst_mm = 0, mean_mm = 0, worst_deg = 0, mean_deg = 0;
};
BallError ball_error(const Surface& s, double radius) {
  BallError error;
  for (const Vec3& p : s.points) {
    error.worst_mm = std::max(error.worst_mm, std::abs(norm(p) - radius));
    error.mean_mm += std::abs(norm(p) - radius) / s.points.size();
  }
  for (const auto& t : s.triangles) {
    const Vec3 &a = s.points[t[0]], &b = s.points[t[1]], &c = s.points[t[2]];
    const double deg = 180 / pi * std::acos(std::min(1.0, dot(unit(cross(b - a, c - a)), unit(a + b + c))));
    error.worst_deg = std::max(error.worst_deg, deg);
    error.mean_deg += deg / s.triangles.size();
  }
  return error;
}

struct BallCase {
  Vec3 spacing;
  bool left_handed;
  double volume_tolerance;  ///< relative; engineering: how well voxels of this spacing can count the ball
};
class Ball : public testing::TestWithParam<BallCase> {};

constexpr double radius = 20.3;

TEST_P(Ball, has_its_volume_its_place_and_no_stairs) {
  const auto [spacing, left_handed, volume_tolerance] = GetParam();
  const Built built = build(labels_of({26, 26, 26}, spacing, ball(radius), left_handed));
  expect_sound(built);
  EXPECT_NEAR(volume_mm3(built.surface) / (4 * pi / 3 * radius * radius * radius), 1, volume_tolerance);
  EXPECT_NEAR(area_mm2(built.surface) / (4 * pi * radius * radius), 1, 0.005);
  const BallError error = ball_error(built.surface, radius);
  EXPECT_LE(error.worst_mm, 0.25 * std::max(spacing[0], spacing[2]));  // engineering: a quarter of a slice
  EXPECT_LE(error.mean_mm, 0.06);
  EXPECT_LE(error.worst_deg, 9.0);  // engineering: flat triangles of a tenth of the radius are 1 to 3 deg off by themselves
  EXPECT_LE(error.mean_deg, 1.6);
}

INSTANTIATE_TEST_SUITE_P(spacings, Ball,
                         testing::Values(BallCase{{1, 1, 1}, false, 0.005}, BallCase{{1, 1, 1}, true, 0.005},
                                         BallCase{{0.8, 0.8, 4}, false, 0.005}, BallCase{{5, 0.8, 0.8}, true, 0.01}));

TEST(BuildSurface, the_test_for_stairs_sees_them_without_smoothing) {
  SurfaceOptions rough;
  rough.smooth_mm = 0.5;
  const Built built = build(labels_of({26, 26, 26}, {0.8, 0.8, 4}, ball(radius)), rough);
  EXPECT_GT(ball_error(built.surface, radius).worst_deg, 20);
}

TEST(BuildSurface, a_ring_has_genus_one) {
  const Built built = build(labels_of({24, 24, 8}, {1, 1, 1}, torus(15, 5)));
  expect_sound(built);
  const auto all = shells(built.surface);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].genus, 1);
  EXPECT_NEAR(volume_mm3(built.surface) / (2 * pi * pi * 15 * 25), 1, 0.01);  // engineering: sampling of the labels
}

}  // namespace
}  // namespace palpate
