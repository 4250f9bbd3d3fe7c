// TOML: every key is asked for, or told.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <palpate/settings.hpp>

#include <palpate/errors.hpp>
#include <palpate/text_file.hpp>

#include <tests/words/temporary_folder.hpp>

using namespace palpate;

class SettingsFile : public InFolder {
 protected:
  Settings read(const std::string& text) {
    write_text(folder / "case.toml", text);
    return Settings::read(folder / "case.toml");
  }
};

namespace {
template <class Action>
std::string refusal(const Action& action) {
  try {
    action();
  } catch (const Failure& failure) {
    return failure.what();
  }
  return "";
}
}  // namespace

TEST_F(SettingsFile, ReadsValues) {
  const Settings s =
      read("depth = 2\naxis = [0, 0.5, -1]\nname = \"ball\"\n[tool]\nradius_mm = 2.5\n[[solve]]\nx = 1\n[[solve]]\nx = 2\n");
  EXPECT_EQ(s.real("depth"), 2);
  EXPECT_EQ(s.vec3("axis"), (Vec3{0, 0.5, -1}));
  EXPECT_EQ(s.text("name"), "ball");
  EXPECT_EQ(s.table("tool").real("radius_mm"), 2.5);
  ASSERT_EQ(s.tables("solve").size(), 2);
  EXPECT_EQ(s.tables("solve")[1].integer("x", 0), 2);
  EXPECT_EQ(s.real("missing", 7), 7);
  EXPECT_NE(refusal([&] { s.expect_all_read(); }), "");  // the first [[solve]] has a key nobody asked for
  s.tables("solve")[0].integer("x", 0);
  s.expect_all_read();
}

TEST_F(SettingsFile, NamesTheMisspeltKeyWithItsLine) {
  const Settings s = read("[tool]\nradius_m = 2.5\n");
  const Settings tool = s.table("tool");
  EXPECT_FALSE(tool.has("radius_mm"));
  const std::string message = refusal([&] { s.expect_all_read(); });
  EXPECT_NE(message.find("unknown key: tool.radius_m"), std::string::npos) << message;
  EXPECT_NE(message.find("did you mean radius_mm?"), std::string::npos) << message;
  EXPECT_NE(message.find("case.toml:2"), std::string::npos) << message;
}

TEST_F(SettingsFile, RefusesWhatDoesNotFit) {
  const Settings s = read("depth = nan\nn = 1.5\nlaw = \"hoke\"\nlist = [1, \"x\"]\nflag = 1\n");
  EXPECT_NE(refusal([&] { s.real("depth"); }), "");
  EXPECT_NE(refusal([&] { s.integer("n", 0); }), "");
  EXPECT_NE(refusal([&] { s.real("n", {2, 3}); }), "");
  EXPECT_NE(refusal([&] { s.choice("law", {"hooke"}); }).find("did you mean hooke?"), std::string::npos);
  EXPECT_NE(refusal([&] { s.reals("list"); }), "");
  EXPECT_NE(refusal([&] { s.flag("flag", true); }), "");
  EXPECT_NE(refusal([&] { s.table("tool"); }), "");
  EXPECT_NE(refusal([&] { read("a = = 1\n"); }).find("case.toml:1"), std::string::npos);
}
