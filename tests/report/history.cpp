// Histories: what is read, and what is refused with its line.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include <palpate/errors.hpp>
#include <palpate/text_file.hpp>
#include <pipeline/report/study.hpp>

using namespace palpate;
namespace fs = std::filesystem;

namespace {

class Histories : public testing::Test {
 protected:
  fs::path file = fs::temp_directory_path() / ("palpate-history-" + std::to_string(getpid()) + ".csv");
  void TearDown() override { fs::remove(file); }

  History read(const std::string& text) {
    write_text(file, text);
    return read_history(file);
  }
  std::string refusal(const std::string& text) {
    try {
      read(text);
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.code(), ExitCode::unreadable);
      return failure.what();
    }
    return "";
  }
};

}  // namespace

TEST_F(Histories, ReadsColumnsByName) {
  const History history = read("t[s],depth[mm],F[N]\n0,0,0\n1,0.5,-2e-3\n");
  EXPECT_EQ(history.column("F[N]"), (std::vector<double>{0, -2e-3}));
  EXPECT_TRUE(history.column("contact_area[mm2]").empty());
}

TEST_F(Histories, RefusesWithTheLine) {
  const std::string head = "t[s],depth[mm],F[N]\n0,0,0\n";
  for (const char* line : {"1,2,nan\n", "1,2,inf\n", "1,2\n", "1,2,3,4\n", "1,2,3x\n", "1,2,\n"})
    EXPECT_NE(refusal(head + line).find("line 3"), std::string::npos) << line;
  EXPECT_NE(refusal(""), "");
  EXPECT_NE(refusal("t[s],depth[mm],F[N]\n"), "");
  EXPECT_NE(refusal("t[s],depth[mm]\n0,0\n").find("F[N]"), std::string::npos);
}

TEST_F(Histories, DeepestFrameIsThatOfTheGreatestDepth) {
  Solve solve{"s", "s", read("t[s],depth[mm],F[N]\n0,0,0\n1,4,1\n2,1,0\n"), {}, {{"a", 0}, {"b", 1.01}, {"c", 2}}};
  EXPECT_EQ(deepest_frame(solve)->file, "b");
  solve.frames.clear();
  EXPECT_EQ(deepest_frame(solve), nullptr);
}
