// Adapted surfaces: edge lengths as wanted, still closed, volume kept, untouched where they should be; the size field and its estimate.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include <palpate/errors.hpp>
#include <pipeline/mesh/adapt_surface.hpp>
#include <pipeline/mesh/components.hpp>
#include <pipeline/mesh/nearest_point.hpp>
#include <tests/mesh/shapes.hpp>

using namespace palpate;

namespace {
const Surface bean = shapes::bean({30, 17, 12.5}, 8, 3);
SizeField uniform(double edge) {
  SizeField sizes;
  sizes.edge = sizes.focus_edge = edge;
  return sizes;
}
SizeField focused() {
  SizeField sizes = uniform(3.5);
  sizes.focus = {{0, 0, 12.5}};
  sizes.focus_edge = 1;
  sizes.focus_radius = 4;
  sizes.grading = 10;
  return sizes;
}
constexpr auto everywhere = [](const Vec3&) { return true; };
}  // namespace

TEST(SizeField, GrowsLinearlyAndIsUniformWithoutFocus) {
  const SizeField sizes = focused();
  EXPECT_EQ(sizes.at({0, 0, 12.5}), 1);
  EXPECT_EQ(sizes.at({4, 0, 12.5}), 1);
  EXPECT_NEAR(sizes.at({9, 0, 12.5}), 2.25, 1e-12);
  EXPECT_EQ(sizes.at({30, 0, 12.5}), 3.5);
  EXPECT_EQ(uniform(2).at({1, 2, 3}), 2);
}

TEST(SizeField, AbsurdWishesAreRefused) {
  const double volume = enclosed_volume(bean);
  EXPECT_NO_THROW(refuse_absurd(focused(), bean, volume, 2e7));
  EXPECT_THROW(refuse_absurd(uniform(50), bean, volume, 2e7), Failure);
  EXPECT_THROW(refuse_absurd(uniform(0.01), bean, volume, 2e7), Failure);
  SizeField far = focused();
  far.focus = {{0, 0, 40}};
  EXPECT_THROW(refuse_absurd(far, bean, volume, 2e7), Failure);
}

TEST(AdaptSurface, EdgesHaveTheWantedLengthAndVolumeIsKept) {
  for (double edge : {1.5, 5.0}) {
    const Surface adapted = adapt_surface(bean, uniform(edge), everywhere);
    EXPECT_EQ(closed_shells(adapted).size(), 1);
    EXPECT_NEAR(mean_edge(adapted), edge, 0.1 * edge);  // engineering: splits and collapses leave 4/5 … 4/3
    EXPECT_NEAR(enclosed_volume(adapted), enclosed_volume(bean), 1e-3 * enclosed_volume(bean));
  }
}

TEST(AdaptSurface, IsFineAtTheFocusAndUntouchedFarAway) {
  const SizeField sizes = focused();
  const Surface adapted = adapt_surface(bean, sizes, [&](const Vec3& x) { return sizes.at(x) < sizes.edge; });
  int fine = 0;
  for (const auto& t : adapted.triangles)
    for (int k = 0; k < 3; ++k) {
      const Vec3 a = adapted.points[t[k]], b = adapted.points[t[(k + 1) % 3]];
      if (norm(0.5 * (a + b) - sizes.focus[0]) > sizes.focus_radius) continue;
      ++fine;
      EXPECT_LE(norm(a - b), 1.5 * sizes.focus_edge);  // engineering: 4/3, and what smoothing adds
    }
  EXPECT_GT(fine, 100);
  for (const Vec3& p : bean.points)
    EXPECT_TRUE(norm(p - sizes.focus[0]) <= 20 || std::find(adapted.points.begin(), adapted.points.end(), p) != adapted.points.end());
}

TEST(AdaptSurface, CubeKeepsItsCorners) {
  Surface cube;
  for (int i = 0; i < 8; ++i) cube.points.push_back({10.0 * (i & 1), 10.0 * (i >> 1 & 1), 10.0 * (i >> 2)});
  cube.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  cube.triangle_region.assign(12, 1);
  const Surface adapted = adapt_surface(cube, uniform(2), everywhere);
  EXPECT_NEAR(enclosed_volume(adapted), 1000, 1e-6);
  for (const Vec3& corner : cube.points) EXPECT_NE(std::find(adapted.points.begin(), adapted.points.end(), corner), adapted.points.end());
}

TEST(NearestPoint, AgreesWithLookingAtEveryTriangle) {
  const SurfaceIndex index(bean);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-60, 60);
  for (int i = 0; i < 200; ++i) {
    const Vec3 x = {coordinate(random), coordinate(random), coordinate(random)};
    double nearest = 1e9;
    for (const auto& t : bean.triangles) nearest = std::min(nearest, norm(x - nearest_on_triangle(x, bean.points[t[0]], bean.points[t[1]], bean.points[t[2]])));
    EXPECT_EQ(index.nearest(x).distance, nearest);
  }
}
