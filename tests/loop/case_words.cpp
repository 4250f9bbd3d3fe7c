// Which cases have one force at each depth.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <palpate/text_file.hpp>
#include <loop/forward/case_words.hpp>

using namespace palpate;

namespace {

bool remembers(const std::string& rest, const std::string& tool = "") {
  const auto file = std::filesystem::temp_directory_path() / (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".toml");  // tests run beside each other
  write_text(file, "schema = \"palpate-case/1\"\nmesh = \"mesh.vtu\"\n[material]\nlaw = \"neo_hookean\"\nmu = 0.01\n[tool]\nkind = \"ball\"\nradius_mm = 5\ndepth_mm = 2\n" + tool + rest);
  const bool answer = loop::remembers(file);
  std::filesystem::remove(file);
  return answer;
}

}  // namespace

TEST(CaseWords, WhatIsElasticDoesNotRemember) {
  EXPECT_FALSE(remembers(""));
  EXPECT_FALSE(remembers("[[effect]]\nname = \"capsule\"\nE_h = 0.1\n[[effect]]\nname = \"thickness\"\nexcess = 0.1\n[[effect]]\nname = \"support\"\nstiffness = 0.1\n"));
}

TEST(CaseWords, WhatRelaxesRubsOrMovesDoes) {
  for (const char* effect : {"prony", "rate", "mullins", "permanent_set", "friction", "adhesion"})
    EXPECT_TRUE(remembers(std::string("[[effect]]\nname = \"capsule\"\n[[effect]]\nname = \"") + effect + "\"\n")) << effect;
  for (const char* tool : {"friction = 0.3\n", "control = \"force\"\n"}) EXPECT_TRUE(remembers("", tool)) << tool;
  EXPECT_TRUE(remembers("[[effect]]\nname = \"support\"\nstiffness = 0.1\nfriction = 0.4\n"));
  EXPECT_TRUE(remembers("[[contact]]\nself = \"organ\"\nfriction = 0.2\n"));
  EXPECT_TRUE(remembers("[[pressure]]\nlabel = \"vessel\"\n"));
}
