// A solve on its way: gravity, then the tools, step by step into a result folder; it can be killed and goes on.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
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
  std::string bytes();
  void explain_stop() const;
  bool may_remesh() const;
  void judge(const implicit::Step& step);
  bool mend();
  bool remesh();
  void give_up_mesh(const std::string& name, const std::string& why);
  std::vector<std::string> files() const;
  std::string remark(const implicit::Step& step) const;

  Command& command_;
  Settings settings_;
  std::filesystem::path mesh_, folder_;  ///< mesh: instead of the case's, or empty
  std::unique_ptr<Case> case_;
  std::unique_ptr<implicit::Equilibrium> equilibrium_;
  implicit::State state_;
  ResultFolder results_;
  std::optional<Sensitivities> sensitivities_;
  implicit::Observer observe_;
  implicit::Stride settling_, pressing_;  ///< of gravity's steps, and of the others
  bool settled_ = false;
  double time_ = 0;  ///< that was reached, s
  implicit::Trouble trouble_;  ///< why no more
  std::optional<Restart> restart_;
  Marks marks_;                           ///< of the next remeshing
  std::vector<std::string> meshes_;       ///< of the remeshings, from the folder; the last one is the case's
  std::string snapshot_;                  ///< of the last reported step, to go back to; none without remeshing
  double marked_force_ = 0;               ///< before it, N
  int failed_remeshings_ = 0;  ///< no equilibrium on the finer mesh
  bool too_large_ = false;     ///< what the tools ask for would have too many nodes: asked no more; where a step stops it may still be made finer
};

}  // namespace palpate
