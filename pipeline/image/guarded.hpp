// Work that a library may end with abort() on damaged input, done in a child process: Debian's GDCM is built with its assertions.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <functional>
#include <memory>
#include <string>

namespace palpate {

/// `count` bytes, zero, that a child process and its parent both see. Throws std::bad_alloc.
std::shared_ptr<void> shared_bytes(std::size_t count);

/// Tells which file is being read: the one to blame when the process ends.
using NowReading = std::function<void(const std::string& path)>;

/// Runs `work` in a child process; memory it writes is lost, except that of shared_bytes(). A Failure it throws is thrown here.
/// Throws Failure(unreadable) naming the last file read when the child ends by a signal or hangs (60 s of processor time). Call it before any thread is started.
void run_guarded(const std::function<void(const NowReading&)>& work);

}  // namespace palpate
