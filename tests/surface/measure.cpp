// Measures, faults and repair on surfaces whose answers are known.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/surface/measure.hpp>

#include <gtest/gtest.h>

#include <palpate/errors.hpp>
#include <pipeline/surface/checks.hpp>
#include <pipeline/surface/contour.hpp>
#include <pipeline/surface/distance.hpp>
#include <pipeline/surface/remesh.hpp>
#include <pipeline/surface/repair.hpp>
#include <pipeline/surface/smooth.hpp>

namespace palpate {
namespace {

/// A ball from the field r − |x|, far from the origin.
Surface ball(double radius, const Vec3& centre) {
  Scan field;
  field.grid.size = {24, 24, 24};
  field.grid.lps_from_voxel.origin = centre - Vec3{11.5, 11.5, 11.5};
  for (int k = 0; k < 24; ++k)
    for (int j = 0; j < 24; ++j)
      for (int i = 0; i < 24; ++i)
        field.voxels.push_back(float(radius - norm(field.grid.lps_from_voxel({double(i), double(j), double(k)}) - centre)));
  return contour(field, 0);
}

Surface both(const Surface& a, const Surface& b) {
  Surface sum = a;
  const int n = int(a.points.size());
  sum.points.insert(sum.points.end(), b.points.begin(), b.points.end());
  for (const auto& t : b.triangles) sum.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
  sum.triangle_region.resize(sum.triangles.size(), 0);
  return sum;
}

const Check& named(const std::vector<Check>& checks, const std::string& name) {
  for (const Check& check : checks)
    if (check.name == name) return check;
  throw std::logic_error("no check named " + name);
}

SurfaceLimits volume_of(const Surface& surface) {
  SurfaceLimits limits;
  limits.volume_mm3 = volume_mm3(surface);
  limits.min_angle_deg = 0;
  return limits;
}

TEST(Measure, a_contour_is_closed_manifold_and_outward) {
  const Surface s = ball(8, {300, -200, 1000});
  for (const Check& check : surface_checks(s, volume_of(s))) EXPECT_TRUE(check.pass) << check.name;
  EXPECT_NEAR(volume_mm3(s) / (4.0 / 3 * M_PI * 512), 1, 0.01);  // engineering: chords of a ball eight steps wide
  ASSERT_EQ(shells(s).size(), 1u);
  EXPECT_EQ(shells(s)[0].genus, 0);
}

TEST(Measure, planted_faults_are_found_where_they_are) {
  const Surface good = ball(8, {0, 0, 0});
  Surface open = good;
  open.triangles.pop_back();
  open.triangle_region.pop_back();
  EXPECT_EQ(faults(open).open_edges, 3);
  Surface twisted = good;
  std::swap(twisted.triangles[7][0], twisted.triangles[7][1]);
  EXPECT_EQ(faults(twisted).twisted_edges, 3);
  Surface pinched = both(good, ball(8, {40, 0, 0}));
  for (auto& t : pinched.triangles)
    for (int& p : t)
      if (p == int(good.points.size())) p = 0;
  EXPECT_EQ(faults(pinched).pinched_points, 1);
  Surface inside_out = good;
  for (auto& t : inside_out.triangles) std::swap(t[0], t[1]);
  EXPECT_FALSE(named(surface_checks(inside_out, volume_of(good)), "outward").pass);
  const Check crossing = named(surface_checks(both(good, ball(8, {10, 0, 0})), volume_of(good)), "self-intersections");
  EXPECT_FALSE(crossing.pass);
  EXPECT_NE(crossing.where.find("at (5."), std::string::npos) << crossing.where;  // two balls meet half way
}

TEST(Measure, volume_is_kept_or_the_check_fails) {
  Surface s = ball(8, {0, 0, 0});
  SurfaceLimits limits = volume_of(s);
  taubin_smooth(s, 10);
  EXPECT_GT(restore_volume(s, 1.1 * limits.volume_mm3), 0);
  EXPECT_NEAR(volume_mm3(s) / limits.volume_mm3, 1.1, 1e-6);
  EXPECT_FALSE(named(surface_checks(s, limits), "volume change").pass);
  restore_volume(s, limits.volume_mm3);
  EXPECT_TRUE(named(surface_checks(s, limits), "volume change").pass);
}

TEST(Repair, a_small_hole_is_closed_and_a_large_one_refused_with_its_place) {
  const Surface good = ball(8, {0, 0, 0});
  std::vector<bool> kept(good.triangles.size(), true);
  for (std::size_t t = 0; t < kept.size(); ++t)
    for (int p : good.triangles[t]) kept[t] = kept[t] && good.points[p][2] < 7.3;
  const Surface open = part_of(good, kept);
  RepairLedger ledger;
  const Surface closed = repair(open, 10, ledger);
  ASSERT_EQ(ledger.holes.size(), 1u);
  EXPECT_EQ(faults(closed).open_edges, 0);
  EXPECT_NEAR(volume_mm3(closed) / volume_mm3(good), 1, 0.03);
  EXPECT_LT(distance(good, closed).largest_mm, 1.5);
  try {
    repair(open, 2, ledger);
    FAIL() << "closed a hole that is too large";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::check_failed);
    EXPECT_NE(std::string(failure.what()).find("hole around"), std::string::npos);
  }
}

TEST(Repair, doubled_and_turned_triangles_are_mended) {
  Surface soup = ball(8, {0, 0, 0});
  const double volume = volume_mm3(soup);
  soup.triangles.push_back(soup.triangles[5]);
  for (std::size_t t = 0; t < soup.triangles.size(); t += 3) std::swap(soup.triangles[t][0], soup.triangles[t][2]);
  soup.triangle_region.assign(soup.triangles.size(), 4);
  RepairLedger ledger;
  const Surface mended = repair(soup, 1, ledger);
  EXPECT_NEAR(volume_mm3(mended) / volume, 1, 1e-9);
  EXPECT_EQ(faults(mended).twisted_edges, 0);
  EXPECT_EQ(mended.triangle_region[0], 4);
}

}  // namespace
}  // namespace palpate
