// Outputs that appear whole or not at all: written under a temporary name beside the real one, then renamed.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>

namespace palpate {

/// Removes what killed writers of `target` and of its card left beside it; work of living processes stays.
void remove_leftovers(const std::filesystem::path& target);

/// One output on its way. Destroyed without commit(), it leaves nothing behind; leftovers of a killed run are removed by the
/// next, or taken on by it.
class PendingOutput {
 public:
  enum class Kind { file, folder };
  /// What becomes of the folder that a killed writer left: removed, or handed over as it is (the newest one).
  enum class Leftovers { removed, handed_over };
  /// Throws Failure(misuse) when `target` exists and `force` is false, when its parent is missing, when it is neither file nor
  /// folder (a device), or when forcing would replace a folder that no card says is ours; Failure(unreadable) when its folder is
  /// not writable.
  PendingOutput(std::filesystem::path target, Kind kind, bool force, Leftovers leftovers = Leftovers::removed);
  ~PendingOutput();
  PendingOutput(PendingOutput&&) noexcept;
  PendingOutput(const PendingOutput&) = delete;

  PendingOutput& operator=(PendingOutput&&) = delete;

  const std::filesystem::path& target() const { return target_; }
  const std::filesystem::path& temporary() const { return temporary_; }
  /// Every byte to the disk. Throws Failure(unreadable) when it is full.
  void flush() const;
  /// Renames over the target; flush() first.
  void commit();

 private:
  std::filesystem::path target_, temporary_;
  Kind kind_;
};

}  // namespace palpate
