// Text made safe, numbers made readable, bytes made text.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include <pipeline/report/html.hpp>

using namespace palpate;

TEST(Html, EscapesWhatWouldBeMarkup) { EXPECT_EQ(escaped("<a href=\"x\">&'"), "&lt;a href=&quot;x&quot;&gt;&amp;&#39;"); }

TEST(Html, ReadsNumbers) {
  EXPECT_EQ(readable(0.031249), "0.03125");
  EXPECT_EQ(readable(9999), "9999");
  EXPECT_EQ(readable(1234567), "1\u202f234\u202f567");
  EXPECT_EQ(readable(-12345), "-12\u202f345");
  EXPECT_EQ(readable(std::nan("")), "–");
}

TEST(Html, EncodesBase64) {  // RFC 4648, section 10
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

TEST(Html, ScriptCannotBeEndedByData) {
  const std::string text = script_json({{"name", "</script><b>"}});
  EXPECT_EQ(text.find("</"), std::string::npos);
  EXPECT_EQ(Json::parse(text)["name"], "</script><b>");
}

TEST(Html, NamesUnitsOfKeys) {
  EXPECT_NE(json_table({{"volume_mm3", 2.5}}).find("volume (mm³)"), std::string::npos);
  EXPECT_NE(json_table({{"<b>", "<i>"}}).find("&lt;b&gt;</th><td>&lt;i&gt;"), std::string::npos);
}
