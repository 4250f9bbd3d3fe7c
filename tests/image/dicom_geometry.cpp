// Frames to a lattice: order, pitch, tilt, and what is refused.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/dicom_geometry.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include <palpate/errors.hpp>

using namespace palpate;

namespace {

/// n slices of 8 × 6 pixels in an oblique plane, `pitch` mm apart, each also moved by `drift` along the columns.
std::vector<DicomFrame> frames(int n, double pitch, double drift = 0) {
  const double c = std::cos(0.3), s = std::sin(0.3);
  const Vec3 row{c, s, 0}, column{0, 0, -1}, normal = cross(row, column);
  std::vector<DicomFrame> list;
  for (int k = 0; k < n; ++k) {
    DicomFrame f;
    f.file = "slice" + std::to_string(k);
    f.columns = 8;
    f.rows = 6;
    f.thickness_mm = 9;  // never to be used
    f.plane = FramePlane{Vec3{10, -20, 30} + (k * pitch) * normal + (k * drift) * column, row, column, 0.7, 1.3};
    list.push_back(f);
  }
  return list;
}

std::string refusal(std::vector<DicomFrame> list) {
  try {
    stack_slices(std::move(list));
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::check_failed);
    return failure.what();
  }
  return "";
}

bool has(const std::string& text, const std::string& word) { return text.find(word) != std::string::npos; }

}  // namespace

TEST(DicomGeometry, OrdersByPositionAndKeepsEveryPlace) {
  auto list = frames(7, 2.5);
  const auto ordered = list;
  std::rotate(list.begin(), list.begin() + 3, list.end());
  std::swap(list[1], list[5]);
  const SliceStack stack = stack_slices(list);
  EXPECT_EQ(stack.grid.size, (std::array<int, 3>{8, 6, 7}));
  EXPECT_NEAR(stack.pitch_mm, 2.5, 1e-12);
  EXPECT_NEAR(stack.tilt_deg, 0, 1e-5);
  EXPECT_GT(stack.grid.lps_from_voxel.determinant(), 0);
  for (int k = 0; k < 7; ++k) {
    const FramePlane& p = *ordered[k].plane;
    EXPECT_EQ(stack.frames[k].file, ordered[k].file);
    const Vec3 corner = p.position + (7 * 0.7) * p.row + (5 * 1.3) * p.column;
    EXPECT_LE(norm(stack.grid.lps_from_voxel({7, 5, double(k)}) - corner), 1e-9);
  }
}

TEST(DicomGeometry, TiltIsKeptAsAShear) {
  const SliceStack stack = stack_slices(frames(5, 3, 3 * std::tan(0.2)));
  EXPECT_NEAR(stack.pitch_mm, 3, 1e-9);
  EXPECT_NEAR(stack.tilt_deg, 0.2 * 180 / std::numbers::pi, 1e-6);
  EXPECT_NEAR(stack.grid.voxel_mm3(), 0.7 * 1.3 * 3, 1e-9);
}

TEST(DicomGeometry, AMissingSliceIsNamed) {
  auto list = frames(9, 2);
  list.erase(list.begin() + 4);
  const std::string text = refusal(list);
  EXPECT_TRUE(has(text, "a gap of 4.000 mm") && has(text, "1 slice(s) missing") && has(text, "slice3") && has(text, "slice5")) << text;
}

TEST(DicomGeometry, WhatIsNotOneStackIsRefused) {
  auto twice = frames(4, 2);
  twice.push_back(twice[2]);
  EXPECT_TRUE(has(refusal(twice), "one position"));
  auto sizes = frames(4, 2);
  sizes[3].rows = 7;
  EXPECT_TRUE(has(refusal(sizes), "different size"));
  auto spacing = frames(4, 2);
  spacing[1].plane->row_step_mm = 1.31;
  EXPECT_TRUE(has(refusal(spacing), "pixel spacing"));
  auto turned = frames(4, 2);
  turned[2].plane->column = {0, 0, 1};
  EXPECT_TRUE(has(refusal(turned), "orientation"));
  auto nowhere = frames(4, 2);
  nowhere[0].plane.reset();
  EXPECT_TRUE(has(refusal(nowhere), "without place"));
  auto aside = frames(5, 2);
  aside[2].plane->position = aside[2].plane->position + 3.0 * aside[2].plane->row;
  EXPECT_TRUE(has(refusal(aside), "off the line"));
  auto uneven = frames(5, 2);
  uneven[4].plane->position = uneven[4].plane->position + 0.1 * cross(uneven[4].plane->row, uneven[4].plane->column);
  EXPECT_TRUE(has(refusal(uneven), "not evenly spaced"));
}

TEST(DicomGeometry, ScoutsAmongSlicesAreLeftOut) {
  auto list = frames(4, 2);
  DicomFrame scout = list[0];
  scout.localizer = true;
  scout.rows = 512;
  list.insert(list.begin(), scout);
  const SliceStack stack = stack_slices(list);
  EXPECT_EQ(stack.frames.size(), 4u);
  EXPECT_EQ(stack.warnings.size(), 1u);
}

TEST(DicomGeometry, ASingleSliceTakesItsThicknessFromTheHeader) {
  EXPECT_NEAR(stack_slices(frames(1, 2)).pitch_mm, 9, 1e-12);
}
