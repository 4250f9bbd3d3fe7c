// fork and exec; PR_SET_PDEATHSIG ties the child's life to ours (prctl(2)).
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/process.hpp>

#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>

#include <palpate/errors.hpp>

namespace palpate::loop {

int run_logged(const std::filesystem::path& program, const std::vector<std::string>& arguments, const std::filesystem::path& log) {
  std::vector<std::string> words = {program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const pid_t child = fork();
  if (child < 0) throw Failure(ExitCode::unreadable, "cannot start the program", program.string());
  if (child == 0) {
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    dup2(file, STDOUT_FILENO);
    dup2(file, STDERR_FILENO);
    execv(program.c_str(), pointers.data());
    _exit(127);
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {}
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  if (code == 127) throw Failure(ExitCode::unreadable, "cannot run the program", program.string(), "build all of Palpate's programs into one folder");
  return code;
}

FolderLock::FolderLock(const std::filesystem::path& folder) : file_(open((folder / "lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644)) {
  if (file_ < 0) throw Failure(ExitCode::unreadable, "cannot be written", folder.string());
  while (flock(file_, LOCK_EX) < 0 && errno == EINTR) {}
}

FolderLock::~FolderLock() { close(file_); }

std::filesystem::path beside(const std::string& name) {
  const auto path = std::filesystem::read_symlink("/proc/self/exe").parent_path() / name;
  return access(path.c_str(), X_OK) == 0 ? path : "";
}

}  // namespace palpate::loop
