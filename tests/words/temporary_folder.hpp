// A folder of its own for every test, gone afterwards; its name has a space.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

class InFolder : public testing::Test {
 protected:
  std::filesystem::path folder = std::filesystem::temp_directory_path() / ("palpate words " + std::to_string(getpid()));
  void SetUp() override { std::filesystem::create_directories(folder); }
  void TearDown() override { std::filesystem::remove_all(folder); }
};
