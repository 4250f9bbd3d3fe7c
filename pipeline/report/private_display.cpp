// Xvfb as a child: -displayfd tells the number it chose; PR_SET_PDEATHSIG ends it with us, and it removes its socket and lock.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/report/private_display.hpp>

#include <fcntl.h>
#include <signal.h>
#include <sys/poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

#include <palpate/errors.hpp>

namespace palpate {
namespace {

constexpr int start_milliseconds = 30000;  // 0.1 s is usual; a loaded machine may need more

/// In the child: becomes Xvfb, which writes its display number to `write_end`. Only calls that are safe after fork().
[[noreturn]] void become_server(int write_end, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(1);  // the parent went before prctl
  const int nowhere = open("/dev/null", O_RDWR);
  for (int standard : {0, 1, 2}) dup2(nowhere, standard);
  constexpr int number_fd = 3;
  if (write_end == number_fd)
    fcntl(write_end, F_SETFD, 0);
  else
    dup2(write_end, number_fd);
  execlp("Xvfb", "Xvfb", "-displayfd", "3", "-screen", "0", "64x64x24", "-nolisten", "tcp", "-noreset",
         static_cast<char*>(nullptr));
  _exit(127);
}

/// The line that -displayfd writes ("99"); empty when the server ended or said nothing in time.
std::string display_number(int read_end) {
  std::string text;
  pollfd waiting{read_end, POLLIN, 0};
  while (text.find('\n') == std::string::npos && poll(&waiting, 1, start_milliseconds) > 0) {
    char block[32];
    const ssize_t count = read(read_end, block, sizeof block);
    if (count <= 0) return "";
    text.append(block, count);
  }
  return text.substr(0, text.find('\n'));
}

void stop(pid_t server) {
  kill(server, SIGTERM);
  waitpid(server, nullptr, 0);
}

}  // namespace

PrivateDisplay::PrivateDisplay() {
  setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
  setenv("GALLIUM_DRIVER", "llvmpipe", 1);
  setenv("LP_NUM_THREADS", "0", 1);  // twice as fast as two threads on pictures of this size
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw Failure(ExitCode::unreadable, "cannot start the drawing server: no pipe");
  const pid_t parent = getpid();
  server_ = fork();
  if (server_ == 0) become_server(ends[1], parent);
  close(ends[1]);
  const std::string number = server_ > 0 ? display_number(ends[0]) : "";
  close(ends[0]);
  if (!number.empty()) {
    setenv("DISPLAY", (":" + number).c_str(), 1);
    return;
  }
  if (server_ > 0) stop(server_);
  server_ = -1;
  if (!std::getenv("DISPLAY"))
    throw Failure(ExitCode::unreadable, "cannot draw: Xvfb does not start and there is no DISPLAY", "",
                  "apt install xvfb libgl1-mesa-dri, or scripts/install-deps");
}

PrivateDisplay::~PrivateDisplay() {
  if (server_ > 0) stop(server_);
}

}  // namespace palpate
