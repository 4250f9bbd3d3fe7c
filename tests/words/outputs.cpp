// Outputs appear whole or not at all.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <palpate/outputs.hpp>

#include <sys/stat.h>
#include <sys/wait.h>

#include <palpate/card.hpp>
#include <palpate/errors.hpp>
#include <palpate/text_file.hpp>

#include <tests/words/temporary_folder.hpp>

using namespace palpate;
namespace fs = std::filesystem;
using Kind = PendingOutput::Kind;

class Outputs : public InFolder {};

namespace {
std::size_t files_in(const fs::path& folder) {
  return std::distance(fs::recursive_directory_iterator(folder), fs::recursive_directory_iterator());
}

/// The id of a process that is gone.
pid_t dead_process() {
  const pid_t child = fork();
  if (child == 0) _exit(0);
  waitpid(child, nullptr, 0);
  return child;
}
}  // namespace

TEST_F(Outputs, NothingStaysWithoutCommit) {
  {
    const PendingOutput file(folder / "a.txt", Kind::file, false), made(folder / "f", Kind::folder, false);
    write_text(file.temporary(), "x");
    write_text(made.temporary() / "y", "y");
  }
  EXPECT_EQ(files_in(folder), 0);
}

TEST_F(Outputs, CommitReplacesFileAndFolder) {
  write_text(folder / "a.txt", "old");
  fs::create_directory(folder / "f");
  write_text(folder / "f" / "old", "old");
  write_text(card_path(folder / "f"), "{}");
  {
    PendingOutput file(folder / "a.txt", Kind::file, true), made(folder / "f/", Kind::folder, true);
    write_text(file.temporary(), "new");
    write_text(made.temporary() / "new", "new");
    for (auto* output : {&file, &made}) {
      output->flush();
      output->commit();
    }
  }
  EXPECT_EQ(read_text(folder / "a.txt"), "new");
  EXPECT_TRUE(fs::exists(folder / "f" / "new"));
  EXPECT_FALSE(fs::exists(folder / "f" / "old"));
  EXPECT_EQ(files_in(folder), 4);  // a.txt, f, f/new, the card
}

TEST_F(Outputs, RefusesToReplace) {
  write_text(folder / "a.txt", "old");
  fs::create_directory(folder / "f");
  write_text(folder / "f" / "photos", "not ours");
  EXPECT_THROW(PendingOutput(folder / "a.txt", Kind::file, false), Failure);
  EXPECT_THROW(PendingOutput(folder / "a.txt", Kind::folder, true), Failure);
  EXPECT_THROW(PendingOutput(folder / "f", Kind::file, true), Failure);
  EXPECT_THROW(PendingOutput(folder / "f", Kind::folder, true), Failure);  // no card says it is ours
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_THROW(PendingOutput(folder / "pipe", Kind::file, true), Failure);  // neither a file nor a folder
  EXPECT_THROW(PendingOutput(folder / "missing" / "a.txt", Kind::file, true), Failure);
  EXPECT_EQ(read_text(folder / "a.txt"), "old");
}

TEST_F(Outputs, LeftoversOfTheDeadGoAndWorkOfTheLivingStays) {
  const std::string dead = ".partial-" + std::to_string(dead_process()) + "-",
                    alive = ".partial-" + std::to_string(getppid()) + "-";
  for (const auto& name : {dead + "a.txt", dead + "a.txt.card.json", dead + "b.txt", alive + "a.txt"})
    write_text(folder / name, "x");
  remove_leftovers(folder / "a.txt");
  EXPECT_FALSE(fs::exists(folder / (dead + "a.txt")));
  EXPECT_FALSE(fs::exists(folder / (dead + "a.txt.card.json")));
  EXPECT_TRUE(fs::exists(folder / (dead + "b.txt")));
  EXPECT_TRUE(fs::exists(folder / (alive + "a.txt")));
}

TEST_F(Outputs, AProcessThatEndedButIsNotBuriedIsDead) {  // as in a container whose first process buries nobody
  const pid_t child = fork();
  if (child == 0) _exit(0);
  siginfo_t ended;
  ASSERT_EQ(waitid(P_PID, child, &ended, WEXITED | WNOWAIT), 0);
  const auto leftover = folder / (".partial-" + std::to_string(child) + "-a.txt");
  write_text(leftover, "x");
  remove_leftovers(folder / "a.txt");
  EXPECT_FALSE(fs::exists(leftover));
  waitpid(child, nullptr, 0);
}

TEST_F(Outputs, ALeftoverUnderOurOwnNumberDoesNotMixWithNewWork) {
  const fs::path own = folder / (".partial-" + std::to_string(getpid()) + "-f");
  fs::create_directory(own);
  write_text(own / "stale", "x");
  const PendingOutput output(folder / "f", Kind::folder, false);
  EXPECT_EQ(files_in(output.temporary()), 0);
}

TEST_F(Outputs, TheNewestWorkOfTheDeadIsHandedOver) {
  const fs::path old = folder / (".partial-" + std::to_string(dead_process()) + "-f"), newer = folder / (".partial-" + std::to_string(dead_process()) + "-f"),
                 alive = folder / (".partial-" + std::to_string(getppid()) + "-f");
  for (const fs::path& name : {old, newer, alive}) {
    fs::create_directory(name);
    write_text(name / "work", name.string());
  }
  fs::last_write_time(old, fs::last_write_time(newer) - std::chrono::hours(1));
  const PendingOutput output(folder / "f", Kind::folder, false, PendingOutput::Leftovers::handed_over);
  EXPECT_EQ(read_text(output.temporary() / "work"), newer.string());
  EXPECT_FALSE(fs::exists(old));
  EXPECT_FALSE(fs::exists(newer));
  EXPECT_TRUE(fs::exists(alive));
}

TEST_F(Outputs, FullDiskIsTold) { EXPECT_THROW(write_text("/dev/full", std::string(1 << 20, 'x')), Failure); }
