// fork, exec and a pipe; PR_SET_PDEATHSIG ties the child's life to ours (prctl(2)).
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/study/process.hpp>

#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include <palpate/errors.hpp>

namespace palpate {
namespace fs = std::filesystem;
namespace {

std::vector<char*> argument_pointers(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

[[noreturn]] void cannot(const std::string& what, const fs::path& program) {
  throw Failure(ExitCode::unreadable, "cannot " + what + ": " + std::strerror(errno), program.string(), "build all of Palpate's programs into one folder");
}

std::string read_all(int descriptor) {
  std::string text;
  char block[4096];
  for (ssize_t count; (count = read(descriptor, block, sizeof block)) != 0;)
    if (count > 0) text.append(block, count);
    else if (errno != EINTR) break;
  return text;
}

}  // namespace

ProcessResult run_process(const fs::path& program, const std::vector<std::string>& arguments) {
  if (access(program.c_str(), X_OK) != 0) cannot("run the program", program);
  std::vector<std::string> words = {program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const auto pointers = argument_pointers(words);
  int ends[2];
  if (pipe(ends) != 0) cannot("open a pipe to the program", program);
  const pid_t parent = getpid(), child = fork();
  if (child < 0) cannot("start the program", program);
  if (child == 0) {
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != parent) _exit(1);  // the parent died before prctl
    dup2(ends[1], STDOUT_FILENO);
    close(ends[0]);
    close(ends[1]);
    execv(program.c_str(), pointers.data());
    _exit(127);
  }
  close(ends[1]);
  ProcessResult result;
  result.output = read_all(ends[0]);
  close(ends[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {}
  result.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  result.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  return result;
}

void become_process(const fs::path& program, const std::vector<std::string>& arguments) {
  std::vector<std::string> words = {program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  execv(program.c_str(), argument_pointers(words).data());
  cannot("run the program", program);
}

fs::path own_folder() { return fs::read_symlink("/proc/self/exe").parent_path(); }

}  // namespace palpate
