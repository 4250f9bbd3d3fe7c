// Derivatives of the reported forces by any number of the case: for every number a shadow of the run, whose case has that number moved a
// little, follows the steps of the run at the price of a back-substitution: with r(u_n, h_{n−1}, θ) = 0 and h_n = H(u_n, h_{n−1}, θ)
//   K u′_n = −(r_θ + r_h h′_{n−1}),   h′_n = H_u u′_n + H_h h′_{n−1} + H_θ,
// the right-hand sides as differences of r and H between shadow and run, the shadow being at u + u′ δ and h + h′ δ. (physics.md §1;
// Michaleris, Tortorelli, Vidal 1994, Int. J. Numer. Meth. Eng. 37:2471, direct differentiation of transient coupled problems.)
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <string>
#include <vector>

#include <solver/case.hpp>
#include <solver/implicit/carry.hpp>
#include <solver/implicit/steps.hpp>

namespace palpate {

/// The run with one number of its case moved by `change`.
struct Shadow {
  std::string path;  ///< of the number, "effect[0].g[1]"
  double change = 0;
  Case the_case;
  implicit::Assembly assembly;
  implicit::State state;
  implicit::LawShifts shifts;
  implicit::Equations equations;  ///< at the run's displacements
  std::vector<Eigen::Vector3d> force_rates;  ///< of the reported forces, by the number
  std::unique_ptr<implicit::Equilibrium> own;  ///< of a secant, which has a run of its own
  bool at_end = false;  ///< of the number's range
  int one_sided = 0;  ///< steps in which a point of contact slides in the shadow and sticks in the run, or the other way round
  double depth_rate = 0;                     ///< of the first tool's depth, when its force is given, mm per unit of the number

  Shadow(std::string number, double by, Case moved, int threads);
  Shadow(const Shadow&) = delete;  // the assembly refers to the case
};

class Sensitivities {
 public:
  /// `numbers`: paths as in Settings::shift. Throws Failure(misuse) for one that the case has not or that cannot be moved.
  Sensitivities(const Settings& settings, const std::filesystem::path& mesh_override, const std::vector<std::string>& numbers,
                implicit::Equilibrium& equilibrium, int threads);

  void take_tools_away();
  void bring_tools();
  /// The run goes on on another mesh of its rest shape, with this equilibrium: the shadows' states are carried there by the same weights (none
  /// given: they are about to be read from an archive).
  void use_mesh(const std::filesystem::path& mesh, implicit::Equilibrium& equilibrium, const implicit::Origins* origins);
  /// After every accepted sub-step of the run, and after it found equilibrium again on another mesh.
  void follow(const implicit::State& found);
  /// A row at a reported step.
  void add(const implicit::Step& step);
  /// What people should know of numbers without a derivative (friction where there is none: a secant stands in), or with one of one side: where their range ends.
  std::vector<std::string> remarks() const;
  /// Of the numbers whose derivatives were of one side in some step, and of steps in which all were; at the end of a run.
  std::vector<std::string> one_sided() const;
  /// What the shadows remember between two steps, and the table.
  void keep(Archive& archive);
  /// `t[s]`, then for every number the derivatives of the history's forces by it; and of the depth, when the first tool's force is given.
  const std::string& table() const { return table_; }

 private:
  void approach(Shadow& shadow, const implicit::State& found);
  std::vector<implicit::Increment> responses(const Eigen::MatrixXd& residual_changes, const Eigen::MatrixXd& prescribed_changes);
  void find_force_rates(const std::vector<implicit::Increment>& steps);
  void step_aside(Shadow& shadow, const implicit::Increment& step);
  void run_on(Shadow& shadow, const implicit::State& found);

  Settings settings_;
  int threads_;
  implicit::Equilibrium* equilibrium_;
  std::unique_ptr<Shadow> still_;  ///< nothing moved: what rounding does to the others, it does to this one too
  implicit::Neighbourhood known_;  ///< of where the run is
  implicit::BlockMatrix scratch_;
  std::vector<std::unique_ptr<Shadow>> shadows_;
  std::string table_;
  int weak_steps_ = 0;  ///< in which points were about to touch or to be let go
};

}  // namespace palpate
