// Outputs that appear whole or not at all: written under a temporary name beside the real one, then renamed.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>

namespace palpate {

/// One output on its way. Destroyed without commit(), it leaves nothing behind; leftovers of a killed run are removed by the next.
class PendingOutput {
 public:
  enum class Kind { file, folder };
  /// Throws Failure(misuse) when `target` exists and `force` is false, when its parent is missing, or when forcing would replace
  /// a folder that no card says is ours.
  PendingOutput(std::filesystem::path target, Kind kind, bool force);
  ~PendingOutput();
  PendingOutput(PendingOutput&&) noexcept;
  PendingOutput(const PendingOutput&) = delete;

  const std::filesystem::path& target() const { return target_; }
  const std::filesystem::path& temporary() const { return temporary_; }
  /// Flushes to disk and renames over the target. Throws Failure(unreadable) when the disk is full.
  void commit();

 private:
  std::filesystem::path target_, temporary_;
  Kind kind_;
};

}  // namespace palpate
