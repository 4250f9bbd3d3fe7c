// What is written into a DICOM file besides its pixels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/dicom_write.hpp>

#include <gtest/gtest.h>

#include <cstdlib>

using namespace palpate;

TEST(DicomWrite, DecimalStringsFitAndKeepTheirValue) {
  for (double x : {0.0, 1.0, -0.1, 1.0 / 3, -2.0 / 3, 123456.789012345, -1e-7, 1.23456789e-9, -0.70710678118654752, 1e15}) {
    const std::string text = decimal_string(x);
    EXPECT_LE(text.size(), 16u) << text;
    EXPECT_NEAR(std::atof(text.c_str()), x, 1e-9 * std::max(1.0, std::abs(x))) << text;
  }
}

TEST(DicomWrite, UidsFollowFromTheText) {
  EXPECT_EQ(uid_of("a"), uid_of("a"));
  EXPECT_NE(uid_of("a"), uid_of("b"));
  for (int i = 0; i < 1000; ++i) {
    const std::string uid = uid_of(std::to_string(i));
    EXPECT_LE(uid.size(), 64u);
    EXPECT_TRUE(uid.starts_with("2.25."));
    EXPECT_NE(uid[5], '0');
  }
}
