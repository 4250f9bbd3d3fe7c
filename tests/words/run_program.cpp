// The life of a program: cards, --skip-current, --force, exit codes, nothing left behind by a failure.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <palpate/command.hpp>

#include <cmath>

#include <palpate/text_file.hpp>

#include <tests/words/temporary_folder.hpp>

using namespace palpate;
namespace fs = std::filesystem;

namespace {

void copy_usage(Usage& u) {
  u.name = "copy";
  u.sentence = "Copies a text.";
  u.input("text", "a.txt", "what is copied");
  u.output("copy", "b.txt", "the copy");
  u.side_output("length", "copy", ".length.txt", "its length");
  u.integer("times", 1, {0, 9}, "how often");
  u.text("fail", std::nullopt, "how to fail");
  u.file("more", "appended");
}

int runs = 0;

void copy(Command& c) {
  ++runs;
  std::string text;
  for (long i = 0; i < c.integer("times"); ++i) text += read_text(c.input("text"));
  if (c.has("more")) text += read_text(c.file("more"));
  write_text(c.output("copy"), text);
  write_text(c.output("length"), std::to_string(text.size()));
  c.note("length", text.size());
  const std::string fail = c.has("fail") ? c.text("fail") : "";
  if (fail == "check") c.check(check_at_most("length", std::nan(""), 3));
  if (fail == "refuse") throw Failure(ExitCode::refused, "the data cannot tell");
  if (fail == "defect") throw std::out_of_range("map::at");
  if (fail == "odd") throw 3;
  if (fail == "forget") fs::remove(c.output("copy"));
  c.check(check_at_least("length", double(text.size()), 1));
}

class Program : public InFolder {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    write_text(folder / "a.txt", "abc");
  }
  int call(std::vector<std::string> words) {
    std::vector<char*> argv;
    words.insert(words.begin(), "palpate-copy");
    for (auto& word : words) argv.push_back(word.data());
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const int code = run_program(argv.size(), argv.data(), copy_usage, copy);
    stdout_ = testing::internal::GetCapturedStdout();
    stderr_ = testing::internal::GetCapturedStderr();
    return code;
  }
  std::string a() const { return folder / "a.txt"; }
  std::string b() const { return folder / "b.txt"; }
  std::size_t files() const { return std::distance(fs::directory_iterator(folder), fs::directory_iterator()); }
  std::string stdout_, stderr_;
};

}  // namespace

TEST_F(Program, WritesOutputsAndCard) {
  EXPECT_EQ(call({a(), b(), "--times", "2"}), 0) << stderr_;
  EXPECT_EQ(read_text(b()), "abcabc");
  EXPECT_EQ(files(), 4);  // a.txt, b.txt, b.length.txt, the card
  const Json card = read_json(card_path(b()));
  EXPECT_EQ(card.at("tool"), "palpate-copy");
  EXPECT_EQ(card.at("options").at("times").at("value"), 2);
  EXPECT_EQ(card.at("inputs").at(0).at("path"), "a.txt");
  EXPECT_EQ(card.at("inputs").at(0).at("sha256"), sha256(a()));
  EXPECT_EQ(card.at("outputs").size(), 2);
  EXPECT_EQ(card.at("outputs").at(0).at("sha256"), sha256(b()));
  EXPECT_EQ(card.at("checks").at(0).at("pass"), true);
  EXPECT_EQ(card.at("notes").at("length"), 6);
}

TEST_F(Program, ReplacesOnlyWhenForced) {
  write_text(b(), "mine");
  EXPECT_EQ(call({a(), b()}), 2);
  EXPECT_EQ(read_text(b()), "mine");
  EXPECT_EQ(call({a(), b(), "--force"}), 0);
  EXPECT_EQ(read_text(b()), "abc");
}

TEST_F(Program, SkipsWhatIsCurrentAndNothingElse) {
  const auto ran = [&](std::vector<std::string> extra) {
    const int before = runs;
    std::vector<std::string> words = {a(), b(), "--force", "--skip-current"};
    words.insert(words.end(), extra.begin(), extra.end());
    EXPECT_EQ(call(words), 0) << stderr_;
    return runs > before;
  };
  EXPECT_TRUE(ran({}));
  EXPECT_FALSE(ran({}));
  EXPECT_EQ(stdout_, "current\n");
  EXPECT_FALSE(ran({"--threads", "2"}));
  EXPECT_TRUE(ran({"--times", "3"}));
  EXPECT_TRUE(ran({"--times", "3", "--seed", "5"}));
  EXPECT_TRUE(ran({}));
  write_text(a(), "abd");
  EXPECT_TRUE(ran({}));
  write_text(b(), "edited by hand");
  EXPECT_TRUE(ran({}));
  fs::remove(folder / "b.length.txt");
  EXPECT_TRUE(ran({}));
  write_text(card_path(b()), "{}");
  EXPECT_TRUE(ran({}));
  write_text(folder / "more.txt", "x");
  EXPECT_TRUE(ran({"--more", folder / "more.txt"}));
  EXPECT_FALSE(ran({"--more", folder / "more.txt"}));
  write_text(folder / "more.txt", "y");
  EXPECT_TRUE(ran({"--more", folder / "more.txt"}));
}

TEST_F(Program, AMovedFolderStaysCurrent) {
  fs::create_directory(folder / "study");
  fs::rename(a(), folder / "study" / "a.txt");
  EXPECT_EQ(call({folder / "study" / "a.txt", folder / "study" / "b.txt"}), 0) << stderr_;
  fs::rename(folder / "study", folder / "moved");
  EXPECT_EQ(call({folder / "moved" / "a.txt", folder / "moved" / "b.txt", "--skip-current"}), 0) << stderr_;
  EXPECT_EQ(stdout_, "current\n");
}

TEST_F(Program, ExitCodesAndNothingLeftBehind) {
  EXPECT_EQ(call({a(), b(), "--fail", "check"}), 4);
  EXPECT_NE(stderr_.find("length"), std::string::npos);
  EXPECT_EQ(call({a(), b(), "--fail", "refuse"}), 6);
  EXPECT_EQ(call({a(), b(), "--fail", "defect"}), 1);
  EXPECT_EQ(call({a(), b(), "--fail", "odd"}), 1);
  EXPECT_EQ(call({a(), b(), "--fail", "forget"}), 1);
  EXPECT_EQ(call({a(), b(), "--tims", "2"}), 2);
  EXPECT_EQ(call({folder / "none.txt", b()}), 3);
  EXPECT_EQ(call({a(), b(), "--more", folder / "none.txt"}), 3);
  EXPECT_EQ(call({folder, b()}), 2);
  EXPECT_EQ(files(), 1);
}

TEST_F(Program, RefusesToWriteOverWhatItReads) {
  EXPECT_EQ(call({a(), a(), "--force"}), 2);
  EXPECT_EQ(call({a(), folder / "." / "a.txt", "--force"}), 2);
  fs::create_symlink(a(), folder / "link.txt");
  EXPECT_EQ(call({a(), folder / "link.txt", "--force"}), 2);
  write_text(folder / "b.length.txt", "input");
  EXPECT_EQ(call({folder / "b.length.txt", b(), "--force"}), 2);
  EXPECT_EQ(call({a(), b(), "--more", folder / "b.length.txt", "--force"}), 2);
  EXPECT_EQ(read_text(a()), "abc");
  EXPECT_EQ(read_text(folder / "b.length.txt"), "input");
}

TEST_F(Program, AnswersQuestionsWithoutFiles) {
  for (const char* question : {"--help", "--version", "--describe", "--xml", "--catalogue"}) {
    EXPECT_EQ(call({question}), 0);
    EXPECT_NE(stdout_, "");
    EXPECT_EQ(stderr_, "");
  }
}

TEST_F(Program, AnotherNameInAnOpenFolderIsNews) {
  fs::create_directory(folder / "f");
  write_text(folder / "f" / "x", "1");
  const fs::path page = folder / "f" / "report.html";
  const std::string before = sha256_of_names(folder / "f", {page});
  write_text(page, "own");
  write_text(card_path(page), "own");
  write_text(folder / "f" / ".partial-12-z", "being written");
  EXPECT_EQ(sha256_of_names(folder / "f", {page}), before);
  write_text(folder / "f" / "y", "1");
  EXPECT_NE(sha256_of_names(folder / "f", {page}), before);
}
