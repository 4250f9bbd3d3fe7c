// A program run to its end, its output in files.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace palpate::loop {

/// Exit code of `program`, with stdout and stderr in `log`; it is ended when this process ends. Throws Failure(unreadable) when it cannot run.
int run_logged(const std::filesystem::path& program, const std::vector<std::string>& arguments, const std::filesystem::path& log);

/// One process, and one thread of it, at a time: others wait. Ends with the object, or with the process however it ends (flock(2)).
class FolderLock {
 public:
  /// `folder` exists. Throws Failure(unreadable) when it cannot be written.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;

 private:
  int file_;
};

/// The program of that name beside the running one; empty when there is none.
std::filesystem::path beside(const std::string& name);

}  // namespace palpate::loop
