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
  bool suits(const implicit::Step& step);
  void report(const implicit::Step& step, Progress& progress);
  void report_on_a_finer_mesh(Progress& progress);
  bool mend();
  std::optional<implicit::Found> remesh();
  void give_up_mesh(const std::string& name, const std::string& why);
  std::vector<std::string> files() const;
  std::string remark(const implicit::Step& step) const;

  /// A step, but for its state, which is the run's.
  struct Coarse {
    int index = 0;
    implicit::Equations equations;
    int iterations = 0, cuts = 0, drags = 0;
  };

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
  std::optional<Coarse> coarse_;          ///< a step found on a mesh that does not suit it, not yet reported
  std::string snapshot_;                  ///< of the last reported step, to go back to; none without remeshing
  double marked_force_ = 0;               ///< before it, N
  int failed_remeshings_ = 0;  ///< no equilibrium on the finer mesh
  bool too_large_ = false;     ///< what the tools ask for would have too many nodes: asked no more; where a step stops it may still be made finer
};

}  // namespace palpate
