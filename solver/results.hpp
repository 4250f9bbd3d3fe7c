// The result folder of a solve: history.csv, frames.pvd with frames/*.vtu, summary.json.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include <palpate/json.hpp>
#include <solver/archive.hpp>
#include <solver/case.hpp>
#include <solver/implicit/energy_balance.hpp>

namespace palpate {

/// What the history follows: the first tool, or else the first patch that is moved.
struct Driven {
  double depth = 0;                                  ///< mm
  double force = 0;                                  ///< along the motion, N, positive when the organ resists
  double area = 0;                                   ///< of contact, mm²
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();  ///< force on the organ, N
};
Driven driven(const Case& c, const implicit::Step& step);

/// How well volume is kept: of |J − 1| the value that 99 of 100 nodes do not exceed, J being the volume of the tetrahedra around a node over that
/// at rest. Single tetrahedra keep theirs less: the pressure is linear.
double patch_volume_change(const implicit::Model& model, const implicit::State& state);

/// Unit direction of the motion that the history follows.
Eigen::Vector3d driven_direction(const Case& c);

/// Writes step by step; finish() writes what needs all of them. Throws Failure(unreadable) when the disk is full.
class ResultFolder {
 public:
  ResultFolder(std::filesystem::path folder, const Case& the_case, const implicit::Assembly& assembly);

  void make_folders() const;
  /// From now on steps are of this case and assembly.
  void follow(const Case& the_case, const implicit::Assembly& assembly);
  /// The last step's state is another now, of another mesh: `facts` of how that came.
  void remeshed(Json facts, const implicit::Step& step);
  /// Every sub-step, for the balance of energy.
  void accepted(const implicit::Accepted& found);
  /// Counts a step that has no row: gravity's.
  void settled(const implicit::Step& step);
  /// A row of the history; a frame too when it is time for one, or when `last`.
  void add(const implicit::Step& step, bool last);
  /// Writes history, frames' index and summary; returns the summary.
  Json finish(double time_reached);

  /// What has been counted and written so far.
  void keep(Archive& archive);
  /// Frames written so far, from the folder.
  const std::vector<std::string>& files() const { return files_; }

  double worst_force_imbalance() const { return worst_imbalance_; }
  double worst_penetration() const { return worst_penetration_; }
  double depth() const { return depth_; }
  double force() const { return force_; }
  double smallest_J() const { return smallest_J_; }

 private:
  void write_frame(const implicit::Step& step);

  std::filesystem::path folder_;
  const Case* case_;
  const implicit::Assembly* assembly_;
  std::string history_, frames_;
  std::vector<std::string> files_;
  int frame_count_ = 0, iterations_ = 0, cuts_ = 0, drags_ = 0, steps_ = 0;
  double peak_force_ = 0, contact_area_ = 0, force_ = 0, depth_ = 0;
  std::vector<implicit::OrganSums> organs_;  ///< at the last step
  double largest_force_ = 0, worst_imbalance_ = 0, worst_penetration_ = 0, smallest_J_ = 1, patch_change_ = 0;
  implicit::EnergyBalance energy_;
  std::vector<std::string> remeshings_;  ///< facts of each, JSON
};

}  // namespace palpate
