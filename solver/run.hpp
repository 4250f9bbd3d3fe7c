// A solve on its way: gravity, then the tools, step by step into a result folder; it can be killed and goes on.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>

#include <palpate/command.hpp>
#include <solver/restart.hpp>
#include <solver/results.hpp>
#include <solver/sensitivities.hpp>

namespace palpate {

class Run {
 public:
  /// Reads the case of the command (input "case", options "mesh" and "sensitivities", output "result") and, if a killed run left one, its state.
  explicit Run(Command& c);

  /// To the end of the case's times. Throws Failure(not_converged), or warns where the case keeps what was reached.
  void go();
  /// Writes what needs all steps; returns the summary.
  Json finish();

  const ResultFolder& results() const { return results_; }

 private:
  void settle();
  void keep(Archive& archive);
  void save();
  void explain_stop() const;
  std::string remark(const implicit::Step& step) const;

  Command& command_;
  Settings settings_;
  std::filesystem::path mesh_, folder_;  ///< mesh: instead of the case's, or empty
  Case case_;
  implicit::Equilibrium equilibrium_;
  implicit::State state_;
  ResultFolder results_;
  std::optional<Sensitivities> sensitivities_;
  implicit::Observer observe_;
  implicit::Stride settling_, pressing_;  ///< of gravity's steps, and of the others
  bool settled_ = false;
  double time_ = 0;  ///< that was reached, s
  std::optional<Restart> restart_;
};

}  // namespace palpate
