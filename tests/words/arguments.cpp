// Command lines: what is taken, and how the rest is refused.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <palpate/arguments.hpp>

#include <gtest/gtest.h>

#include <palpate/errors.hpp>

using namespace palpate;

namespace {

Usage press() {
  Usage u;
  u.name = "press";
  u.sentence = "Presses & releases <everything>.";
  u.input("scan", "scan.nii.gz", "what is pressed");
  u.output("labels", "labels.nii.gz", "where it was pressed");
  u.real("depth", 2.0, "mm", {0, 10}, "how deep");
  u.integer("steps", std::nullopt, {1, 1e15}, "how many steps; by depth when not given");
  u.choice("law", "hooke", {"hooke", "neo_hookean"}, "which law");
  u.points("at", "where");
  u.flag("twice", "press twice");
  u.file("mask", "only here");
  return u;
}

std::string refusal(const std::vector<std::string>& words) {
  try {
    parse_arguments(press(), words);
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::misuse);
    return failure.what();
  }
  return "";
}

}  // namespace

TEST(Arguments, TakesFilesOptionsAndDefaults) {
  const Arguments a = parse_arguments(
      press(), {"a folder/s.nii.gz", "--depth", "3.5", "--at", "-1,2.5,-3e1", "l.nii", "--at=4,5,6", "--twice", "--steps=7"});
  EXPECT_EQ(a.inputs.at("scan"), "a folder/s.nii.gz");
  EXPECT_EQ(a.outputs.at("labels"), "l.nii");
  EXPECT_EQ(a.options.at("depth"), 3.5);
  EXPECT_EQ(a.options.at("steps"), 7);
  EXPECT_EQ(a.options.at("law"), "hooke");
  EXPECT_EQ(a.options.at("at"), Json::parse("[[-1.0,2.5,-30.0],[4.0,5.0,6.0]]"));
  EXPECT_EQ(a.options.at("twice"), true);
  EXPECT_EQ(a.options.at("force"), false);
  EXPECT_TRUE(a.options.at("mask").is_null());
  EXPECT_TRUE(parse_arguments(press(), {"s", "l.nii"}).options.at("steps").is_null());
}

TEST(Arguments, TakesNegativeNumbers) {
  Usage u = press();
  u.real("offset", 0.0, "mm", {}, "shift");
  EXPECT_EQ(parse_arguments(u, {"s", "--offset", "-2.5", "l.nii"}).options.at("offset"), -2.5);
}

TEST(Arguments, RefusesWithTheNearestName) {
  EXPECT_NE(refusal({"s", "l.nii", "--dept", "3"}).find("did you mean --depth?"), std::string::npos);
  EXPECT_NE(refusal({"s", "l.nii", "--dept=3"}).find("did you mean --depth?"), std::string::npos);
  EXPECT_NE(refusal({"s", "l.nii", "--law", "neo_hokean"}).find("did you mean neo_hookean?"), std::string::npos);
}

TEST(Arguments, RefusesWhatIsNoValue) {
  for (const char* bad : {"10.5", "-1", "nan", "inf", "1e400", "3mm", "", "--law"})
    EXPECT_NE(refusal({"s", "l.nii", "--depth", bad}), "") << bad;
  for (const char* bad : {"0", "1.5", "1e300", "x"}) EXPECT_NE(refusal({"s", "l.nii", "--steps", bad}), "") << bad;
  for (const char* bad : {"1,2", "1,2,3,4", "1,2,", "1,2,x", "1,2,nan", "1 2 3"})
    EXPECT_NE(refusal({"s", "l.nii", "--at", bad}), "") << bad;
  EXPECT_NE(refusal({"s", "l.nii", "--depth"}), "");
  EXPECT_NE(refusal({"s", "l.nii", "--depth", "1", "--depth", "2"}), "");
}

TEST(Arguments, RefusesTooFewAndTooManyFiles) {
  EXPECT_NE(refusal({"s"}).find("missing: labels"), std::string::npos);
  EXPECT_NE(refusal({}).find("missing: scan"), std::string::npos);
  EXPECT_NE(refusal({"s", "l.nii", "extra"}).find("one file too many: extra"), std::string::npos);
  EXPECT_NE(refusal({"s", ""}).find("missing: labels"), std::string::npos);
}

TEST(Arguments, TakesSeveralOfAnInput) {
  Usage u;
  u.name = "compare";
  u.several_inputs("results", "result", "what is compared", ArgumentKind::folder);
  u.output("comparison", "compare", "where it is compared", ArgumentKind::folder);
  const Arguments a = parse_arguments(u, {"a/", "b", "--quiet", "c", "out"});
  EXPECT_EQ(a.several.at("results"), (std::vector<std::filesystem::path>{"a", "b", "c"}));
  EXPECT_EQ(a.inputs.at("results"), "a");
  EXPECT_EQ(a.outputs.at("comparison"), "out");
  EXPECT_EQ(parse_arguments(u, {"a", "out"}).several.at("results").size(), 1u);
  EXPECT_THROW(parse_arguments(u, {"a"}), Failure);
  EXPECT_EQ(describe(u).at("inputs").at(0).at("several"), true);
}

TEST(Arguments, RefusesAnOutputOfAnotherFormat) {
  EXPECT_NE(refusal({"s", "labels.vtu"}).find(".nii.gz or .nii"), std::string::npos);
  EXPECT_EQ(refusal({"s", "labels.nii"}), "");
}

TEST(Arguments, FoldersLoseTheirLastSlash) {
  Usage u;
  u.name = "make";
  u.output("dicom", "dicom", "slices", ArgumentKind::folder);
  EXPECT_EQ(parse_arguments(u, {"a/dicom/"}).outputs.at("dicom"), "a/dicom");
  EXPECT_EQ(parse_arguments(u, {"/"}).outputs.at("dicom"), "/");
}

TEST(Usage, DescribesEveryOption) {
  const Json json = describe(press());
  EXPECT_EQ(json.at("name"), "palpate-press");
  EXPECT_EQ(json.at("options").at(0), Json::parse(R"({"name":"depth","kind":"real","unit":"mm","default":2.0,"meaning":"how deep",
                                                      "min":0.0,"max":10.0})"));
  EXPECT_TRUE(json.at("options").at(1).at("default").is_null());
  EXPECT_EQ(json.at("common_options").size(), common_options().size());
}

TEST(Usage, XmlEscapesAndNamesVariables) {
  Usage u = press();
  u.real("edge-length", 1.0, "mm", {0.1, 5}, "length");
  const std::string xml = slicer_xml(u);
  EXPECT_NE(xml.find("<description>Presses &amp; releases &lt;everything&gt;.</description>"), std::string::npos);
  EXPECT_NE(xml.find("<name>edge_length</name>"), std::string::npos);
  EXPECT_NE(xml.find("<longflag>--edge-length</longflag>"), std::string::npos);
  EXPECT_NE(xml.find("<maximum>1000000000000000</maximum>"), std::string::npos);  // of --steps: a whole number stays one
}

TEST(Usage, HelpTellsUnitRangeAndDefault) {
  const std::string help = help_text(press());
  EXPECT_NE(help.find("how deep [from 0 to 10] (default 2.0)"), std::string::npos) << help;
}
