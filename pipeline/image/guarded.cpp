// fork, shared memory, and the child's last words.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/guarded.hpp>

#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <new>
#include <system_error>

#include <palpate/errors.hpp>

namespace palpate {
namespace {

/// What the child leaves behind.
struct LastWords {
  bool failed = false;       ///< threw a Failure
  bool defect = false;       ///< threw something else
  ExitCode code = ExitCode::done;
  char message[16384] = {};  ///< of the exception
  char file[4096] = {};      ///< being read
};

template <std::size_t size>
void keep(char (&target)[size], const std::string& text) {
  const std::size_t length = std::min(text.size(), size - 1);
  std::memcpy(target, text.data(), length);
  target[length] = '\0';
}

/// Ends this process when the next file takes it longer than that, in seconds of its processor.
void limit_time() {
  constexpr long seconds_per_file = 60;
  const itimerval timer{{0, 0}, {seconds_per_file, 0}};
  setitimer(ITIMER_PROF, &timer, nullptr);
}

void work_and_tell(const std::function<void(const NowReading&)>& work, LastWords& words) {
  try {
    work([&](const std::string& path) {
      keep(words.file, path);
      limit_time();
    });
  } catch (const Failure& failure) {
    words.failed = true;
    words.code = failure.code();
    keep(words.message, failure.what());
  } catch (const std::exception& error) {
    words.defect = true;
    keep(words.message, error.what());
  }
}

}  // namespace

std::shared_ptr<void> shared_bytes(std::size_t count) {
  const std::size_t size = std::max<std::size_t>(count, 1);
  void* memory = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  return {memory, [size](void* p) { munmap(p, size); }};
}

void run_guarded(const std::function<void(const NowReading&)>& work) {
  const auto memory = shared_bytes(sizeof(LastWords));
  LastWords& words = *new (memory.get()) LastWords;
  const pid_t child = fork();
  if (child < 0) throw std::system_error(errno, std::generic_category(), "cannot start a process");
  if (child == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // ends with its parent
    const rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    work_and_tell(work, words);
    _exit(0);
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw Failure(ExitCode::unreadable, "a file so damaged that its reader gives up", words.file, "copy it again from its source, or move it out of the folder");
  if (words.failed) throw Failure(words.code, words.message);
  if (words.defect) throw std::runtime_error(words.message);
}

}  // namespace palpate
