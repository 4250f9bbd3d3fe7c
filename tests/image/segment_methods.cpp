// Otsu against brute force; region growing into a leak and what opening does to it; pieces and holes counted; places in mm.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <palpate/errors.hpp>
#include <pipeline/image/cleaning.hpp>
#include <pipeline/image/components.hpp>
#include <pipeline/image/histogram.hpp>
#include <pipeline/image/places.hpp>
#include <pipeline/image/segmentation.hpp>
#include <pipeline/image/smoothing.hpp>

namespace palpate {
namespace {

Grid cube(int n) {
  Grid grid;
  grid.size = {n, n, n};
  return grid;
}

template <class Inside>
Mask mask_where(const Grid& grid, Inside&& inside) {
  Mask mask{grid, std::vector<std::uint8_t>(grid.count())};
  for (int k = 0; k < grid.size[2]; ++k)
    for (int j = 0; j < grid.size[1]; ++j)
      for (int i = 0; i < grid.size[0]; ++i) mask(i, j, k) = inside(i, j, k);
  return mask;
}

auto ball(double x, double y, double z, double radius) {
  return [=](double i, double j, double k) { return std::hypot(i - x, j - y, k - z) <= radius; };
}

Scan scan_of(const Mask& mask, float inside, float outside) {
  Scan scan{mask.grid, std::vector<float>(mask.voxels.size())};
  for (std::size_t p = 0; p < scan.voxels.size(); ++p) scan.voxels[p] = mask.voxels[p] ? inside : outside;
  return scan;
}

TEST(Otsu, equals_brute_force_over_all_cuts) {
  constexpr int bins = 64;
  std::mt19937 random(3);
  std::normal_distribution<float> dark(40, 9), bright(90, 12);
  std::vector<float> values;
  for (int n = 0; n < 3000; ++n) values.push_back(n % 3 ? dark(random) : bright(random));
  const Histogram h = histogram_of(values, bins);
  double best = -1, best_cut = 0;
  for (int cut = 1; cut < bins; ++cut) {
    double count[2] = {0, 0}, sum[2] = {0, 0};
    for (float v : values) {
      const int bin = std::min(bins - 1, static_cast<int>((v - h.min) * (bins / (h.max - h.min))));
      count[bin >= cut] += 1;
      sum[bin >= cut] += bin + 0.5;
    }
    const double between = count[0] * count[1] * std::pow(sum[1] / count[1] - sum[0] / count[0], 2);
    if (between > best) best = between, best_cut = h.min + cut * h.bin_width();
  }
  ASSERT_TRUE(otsu_threshold(h));
  EXPECT_NEAR(*otsu_threshold(h), best_cut, 1e-9 * best_cut);  // round-off
}

TEST(Otsu, cuts_two_values_in_the_middle) {
  const Histogram h = histogram_of({1, 1, 1, 5, 5}, 400);
  EXPECT_NEAR(*otsu_threshold(h), 3, h.bin_width());
}

TEST(Otsu, refuses_a_constant_scan) {
  const Mask domain = mask_where(cube(4), [](int, int, int) { return true; });
  const Scan scan = scan_of(domain, 7, 7);
  try {
    segmentation::by_name("otsu").choose({scan, domain, {}, {}, {}});
    FAIL();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::refused);
    EXPECT_NE(std::string(failure.what()).find("intensity 7"), std::string::npos);
  }
}

/// Two balls joined by a bridge one voxel thick: the organ, a leak, and the neighbour it leaks into.
struct Leak {
  Mask organ = mask_where(cube(40), ball(12, 20, 20, 9)), neighbour = mask_where(cube(40), ball(32, 20, 20, 6));
  Mask all = organ;
  Leak() {
    for (std::size_t p = 0; p < all.voxels.size(); ++p) all.voxels[p] |= neighbour.voxels[p];
    for (int i = 12; i < 32; ++i) all(i, 20, 20) = 1;
  }
};

TEST(RegionGrowing, leaks_through_a_bridge_and_opening_cuts_it) {
  const Leak leak;
  const Scan scan = scan_of(leak.all, 100, 20);
  const Mask domain = mask_where(scan.grid, [](int, int, int) { return true; });
  const auto choice = segmentation::by_name("region_growing").choose({scan, domain, 80.0, 120.0, {{12, 20, 20}}});
  EXPECT_EQ(choice.mask.voxels, leak.all.voxels);
  std::vector<CleaningStep> steps;
  const Mask clean = cleaned(choice.mask, {.opening_mm = 1.5, .islands = Islands::seeded, .seeds = {{12, 20, 20}}}, steps);
  for (std::size_t p = 0; p < clean.voxels.size(); ++p) EXPECT_LE(clean.voxels[p], leak.organ.voxels[p]);
  EXPECT_GT(count_inside(clean), 0.97 * count_inside(leak.organ));  // engineering: opening rounds the digital ball's spikes
}

TEST(RegionGrowing, takes_its_interval_from_around_the_seed) {
  const Leak leak;
  Scan scan = scan_of(leak.organ, 100, 20);
  std::mt19937 random(5);
  std::normal_distribution<float> noise(0, 3);
  for (auto& v : scan.voxels) v += noise(random);
  const Mask domain = mask_where(scan.grid, [](int, int, int) { return true; });
  segmentation::Task task{scan, domain, {}, {}, {{12, 20, 20}}};
  task.neighbourhood_mm = 4;
  task.interval_sd = 4;
  const auto choice = segmentation::by_name("region_growing").choose(task);
  EXPECT_NEAR(0.5 * (choice.lower + choice.upper), 100, 1);
  EXPECT_NEAR(choice.upper - choice.lower, 24, 3);
  for (std::size_t p = 0; p < scan.voxels.size(); ++p) EXPECT_LE(choice.mask.voxels[p], leak.organ.voxels[p]);
  EXPECT_GT(count_inside(choice.mask), 0.99 * count_inside(leak.organ));
}

TEST(RegionGrowing, refuses_a_seed_outside_the_interval) {
  const Leak leak;
  const Scan scan = scan_of(leak.all, 100, 20);
  const Mask domain = mask_where(scan.grid, [](int, int, int) { return true; });
  EXPECT_THROW(segmentation::by_name("region_growing").choose({scan, domain, 80.0, 120.0, {{1, 1, 1}}}), Failure);
}

TEST(Components, are_counted_by_faces) {
  Mask mask = mask_where(cube(12), ball(3, 3, 3, 2));
  mask(8, 8, 8) = mask(9, 9, 9) = 1;  // share a corner only
  const Components found = components_of(mask);
  ASSERT_EQ(found.voxels.size(), 3);
  EXPECT_EQ(found.voxels[1], 1);
  EXPECT_EQ(found.voxels[2], 1);
  EXPECT_EQ(count_inside(largest_piece(mask)), found.voxels[0]);
  EXPECT_EQ(count_inside(pieces_of_at_least(mask, 2)), found.voxels[0]);
  EXPECT_EQ(count_inside(pieces_with(mask, {{9, 9, 9}, {0, 0, 0}})), 1);
}

TEST(Holes, are_filled_unless_they_reach_the_border) {
  const auto whole = ball(10, 10, 10, 7), hole = ball(10, 10, 10, 3);
  const auto shell = [&](int i, int j, int k) { return whole(i, j, k) && !hole(i, j, k); };
  EXPECT_EQ(holes_filled(mask_where(cube(21), shell)).voxels, mask_where(cube(21), whole).voxels);
  const auto tunnel = [&](int i, int j, int k) { return shell(i, j, k) && !(j == 10 && k == 10 && i > 10); };
  EXPECT_EQ(holes_filled(mask_where(cube(21), tunnel)).voxels, mask_where(cube(21), tunnel).voxels);
}

TEST(Places, a_seed_outside_is_named_with_the_scans_box) {
  Grid grid = cube(10);
  grid.lps_from_voxel.origin = {-20, 0, 100};
  EXPECT_EQ(voxels_at(grid, {{-20.4, 9.4, 105}})[0], (VoxelIndex{0, 9, 5}));
  try {
    voxels_at(grid, {{-15, 5, 105}, {5, 5, 105}});
    FAIL();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::misuse);
    const std::string text = failure.what();
    EXPECT_NE(text.find("seed 2"), std::string::npos) << text;
    EXPECT_NE(text.find("x -20.50 to -10.50"), std::string::npos) << text;
  }
}

TEST(Places, a_box_takes_voxels_by_their_centres) {
  const Mask box = box_mask(cube(10), {{2, 8, 3}, {4, 1, 3}});
  EXPECT_EQ(count_inside(box), 3 * 8 * 1);
  EXPECT_THROW(box_mask(cube(10), {{20, 20, 20}, {30, 30, 30}}), Failure);
  EXPECT_THROW(box_mask(cube(10), {{1, 1, 1}}), Failure);
}

TEST(Smoothing, gaussian_has_its_width_in_mm_along_every_axis) {
  Grid grid = cube(41);
  grid.lps_from_voxel.columns = {Vec3{0.5, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 0.8}};
  Scan scan{grid, std::vector<float>(grid.count(), 0)};
  scan(20, 20, 20) = 1000;
  const Scan smooth = smoothing::by_name("gaussian").apply(scan, {1.5, {}});
  double total = 0;
  Vec3 moment{0, 0, 0};
  for (int k = 0; k < 41; ++k)
    for (int j = 0; j < 41; ++j)
      for (int i = 0; i < 41; ++i) {
        const double w = smooth(i, j, k);
        total += w;
        moment = moment + w * Vec3{std::pow((i - 20) * 0.5, 2), std::pow((j - 20) * 1.0, 2), std::pow((k - 20) * 0.8, 2)};
      }
  EXPECT_NEAR(total, 1000, 0.01);  // round-off of floats
  for (int a = 0; a < 3; ++a)
    EXPECT_NEAR(std::sqrt(moment[a] / total), 1.5, 0.02) << a;  // engineering: the kernel ends at 3.5 sigma
}

TEST(Smoothing, knows_the_noise) {
  Scan scan{cube(48), std::vector<float>(48 * 48 * 48)};
  std::mt19937 random(9);
  std::normal_distribution<float> noise(100, 5);
  for (auto& v : scan.voxels) v = noise(random);
  EXPECT_NEAR(smoothing::noise_sd(scan), 5, 0.1);  // engineering: an estimate from 1e5 voxels
}

TEST(Smoothing, every_filter_keeps_a_constant_scan_and_calms_noise) {
  std::mt19937 random(11);
  std::normal_distribution<float> noise(50, 4);
  Scan flat{cube(24), std::vector<float>(24 * 24 * 24, 50)}, noisy = flat;
  for (auto& v : noisy.voxels) v = noise(random);
  for (const auto& filter : smoothing::all()) {
    for (float v : filter.apply(flat, {1, {}}).voxels) ASSERT_NEAR(v, 50, 1e-4) << filter.about.name;
    const double left = statistics_of(filter.apply(noisy, {1, {}}).voxels).sd;
    if (filter.about.name == "none") continue;
    EXPECT_LT(left, 0.6 * statistics_of(noisy.voxels).sd) << filter.about.name;
  }
}

}  // namespace
}  // namespace palpate
