// Temporary names carry the writer's process id, so that leftovers of dead writers can be told from work in progress.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <palpate/outputs.hpp>

#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>

#include <palpate/card.hpp>
#include <palpate/errors.hpp>

namespace palpate {
namespace fs = std::filesystem;
namespace {

const std::string prefix = ".partial-";

fs::path parent_of(const fs::path& target) { return target.has_parent_path() ? target.parent_path() : fs::path("."); }

fs::path temporary_of(const fs::path& target) {
  return parent_of(target) / (prefix + std::to_string(getpid()) + "-" + target.filename().string());
}

/// The process id in `.partial-<pid>-<name>`; 0 for any other name.
int writer_of(const std::string& file, const std::string& name) {
  if (!file.starts_with(prefix)) return 0;
  int pid = 0;
  const auto [end, error] = std::from_chars(file.data() + prefix.size(), file.data() + file.size(), pid);
  return error == std::errc{} && std::string(end) == "-" + name ? pid : 0;
}

/// A process that has ended but is not yet buried by its parent writes no more: state Z in /proc/<pid>/stat, after the name in brackets.
bool is_alive(int pid) {
  if (kill(pid, 0) != 0 && errno == ESRCH) return false;
  std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
  std::string line;
  if (!std::getline(file, line)) return true;
  const auto bracket = line.rfind(") ");
  return bracket == std::string::npos || bracket + 2 >= line.size() || (line[bracket + 2] != 'Z' && line[bracket + 2] != 'X');
}

void flush_to_disk(const fs::path& path) {
  const int descriptor = open(path.c_str(), O_RDONLY);
  const bool flushed = descriptor >= 0 && fsync(descriptor) == 0;
  const int reason = errno;
  if (descriptor >= 0) close(descriptor);
  if (!flushed)
    throw Failure(ExitCode::unreadable, std::string("cannot write the output: ") + std::strerror(reason), path.string(),
                  "check free space (df -h) and permissions");
}

void refuse_to_overwrite(const fs::path& target, PendingOutput::Kind kind, bool force) {
  if (!fs::exists(target)) return;
  if (!fs::is_regular_file(target) && !fs::is_directory(target))
    throw Failure(ExitCode::misuse, "the output is neither a file nor a folder", target.string(), "another name");
  if (!force) throw Failure(ExitCode::misuse, "the output exists", target.string(), "another name, or --force to replace it");
  const bool is_folder = fs::is_directory(target);
  if (is_folder != (kind == PendingOutput::Kind::folder))
    throw Failure(ExitCode::misuse,
                  is_folder ? "the output is a folder, a file is written" : "the output is a file, a folder is written",
                  target.string(), "another name");
  if (is_folder && !fs::is_empty(target) && !fs::exists(card_path(target)))
    throw Failure(ExitCode::misuse, "refusing to replace a folder that this program did not make (no card beside it)",
                  target.string(), "another name, or remove the folder yourself");
}

/// The newest folder of a dead writer gets the name of this one.
void take_on_leftovers(const fs::path& target, const fs::path& temporary) {
  fs::path newest;
  fs::file_time_type time;
  for (const auto& entry : fs::directory_iterator(parent_of(target))) {
    const int pid = writer_of(entry.path().filename().string(), target.filename().string());
    if (pid <= 0 || (pid != getpid() && is_alive(pid)) || !entry.is_directory()) continue;
    if (!newest.empty() && entry.last_write_time() <= time) continue;
    newest = entry.path();
    time = entry.last_write_time();
  }
  if (newest.empty() || newest == temporary) return;
  fs::remove_all(temporary);
  std::error_code another_was_faster;
  fs::rename(newest, temporary, another_was_faster);
}

}  // namespace

void remove_leftovers(const fs::path& target) {
  for (const auto& entry : fs::directory_iterator(parent_of(target)))
    for (const fs::path& name : {target.filename(), card_path(target).filename()}) {
      const int pid = writer_of(entry.path().filename().string(), name.string());
      if (pid > 0 && !is_alive(pid)) fs::remove_all(entry.path());
    }
}

PendingOutput::PendingOutput(fs::path target, Kind kind, bool force, Leftovers leftovers) : target_(std::move(target)), kind_(kind) {
  if (!target_.has_filename()) target_ = target_.parent_path();  // "dicom/" is "dicom"
  if (!fs::is_directory(parent_of(target_)))
    throw Failure(ExitCode::misuse, "the output's folder does not exist", parent_of(target_).string(), "mkdir -p it first");
  refuse_to_overwrite(target_, kind, force);
  if (access(parent_of(target_).c_str(), W_OK | X_OK) != 0)
    throw Failure(ExitCode::unreadable, std::string("cannot write into the output's folder: ") + std::strerror(errno),
                  parent_of(target_).string(), "another folder, or its permissions");
  temporary_ = temporary_of(target_);
  if (leftovers == Leftovers::handed_over) take_on_leftovers(target_, temporary_);
  else fs::remove_all(temporary_);  // of a killed process that had the number this one has now
  remove_leftovers(target_);
  if (kind == Kind::folder) fs::create_directory(temporary_);
}

PendingOutput::PendingOutput(PendingOutput&& other) noexcept
    : target_(std::move(other.target_)), temporary_(std::move(other.temporary_)), kind_(other.kind_) {
  other.temporary_.clear();
}

PendingOutput::~PendingOutput() {
  std::error_code ignored;
  if (!temporary_.empty()) fs::remove_all(temporary_, ignored);
}

void PendingOutput::flush() const {
  if (kind_ == Kind::file) return flush_to_disk(temporary_);
  for (const auto& entry : fs::recursive_directory_iterator(temporary_))
    if (entry.is_regular_file()) flush_to_disk(entry.path());
}

void PendingOutput::commit() {
  if (kind_ == Kind::folder && fs::exists(target_)) {
    // Exchanged in one step; the destructor removes the old folder under the temporary name.
    if (renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE) == 0) return;
    fs::remove_all(target_);
  }
  fs::rename(temporary_, target_);
  temporary_.clear();
}

}  // namespace palpate
