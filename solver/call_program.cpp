// fork and exec; PR_SET_PDEATHSIG ties the child's life to ours (prctl(2)).
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/call_program.hpp>

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>

#include <palpate/errors.hpp>

namespace palpate {

int call_program(const std::string& name, const std::vector<std::string>& arguments) {
  const std::string program = (std::filesystem::read_symlink("/proc/self/exe").parent_path() / ("palpate-" + name)).string();
  if (access(program.c_str(), X_OK) != 0)
    throw Failure(ExitCode::unreadable, "cannot run the program", program, "build all of Palpate's programs into one folder");
  std::vector<std::string> words = {program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const pid_t parent = getpid(), child = fork();
  if (child < 0) throw Failure(ExitCode::unreadable, "cannot start the program", program);
  if (child == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(1);  // the parent died before prctl
    dup2(open("/dev/null", O_WRONLY), STDOUT_FILENO);
    execv(program.c_str(), pointers.data());
    _exit(127);
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {}
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace palpate
