// What a case adds to the law of a wall: effects on the stress at the five points of the thickness, what is so from the start, layers on a face.
// All is a correction to the law's own S, conjugate to ½ δC of the plane: ΔS = S_plane(with) − S_plane(law), S_plane = S − S33 C33 C⁻¹, which is
// how the pressure that makes σ33 = 0 goes. So amplitude 0 corrects by exactly nothing, and a wall without effects does not come here.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <numeric>
#include <vector>

#include <solver/archive.hpp>
#include <solver/elements/material.hpp>
#include <solver/explicit/wall_forces.hpp>

namespace palpate::explicit_shell {

/// A layer of no thickness on the wall.
struct WallLayer {
  effects::Active active;
  double place = 0;              ///< −1: inner face, 0: mid-surface, 1: outer face
  std::vector<char> on;          ///< triangles
};

/// `material`: the wall's law in three dimensions, with the effects on the stress around it. They work in the triangle's own axes, which is all
/// the same to isotropic laws.
struct Tissue {
  elements::Material material;
  std::vector<effects::Start> starts;  ///< of each triangle; empty: nothing is so from the start
  std::vector<WallLayer> layers;
  bool plain() const { return material.effects.empty() && starts.empty() && layers.empty(); }
};

/// How many times stiffer than its law each triangle may be, for the stable step.
std::vector<double> stiffening(const Tissue& tissue, const Wall& wall);

/// S in the plane (MPa) of a stress P in three dimensions, where F of the plane has the thickness 1/√det C: C = FᵀF, F upper triangular.
materials::InPlane<double> plane_stress(const materials::Mat3& F, const materials::Mat3& P);
materials::Mat3 upper_root(const materials::InPlane<double>& C);

/// A tissue at work on a wall, with what its points remember.
class TissueForces {
 public:
  TissueForces(const Tissue& tissue, const Wall& wall);

  /// Adds to the slots of packs `from` … `to` − 1, and remembers: a step of dt has led to `state` at `time`.
  void add(const WallState& state, double time, double dt, int from, int to, Slots& slots);
  /// What is added to the law's S at a point of the thickness, at the moment of the last add().
  materials::InPlane<double> correction(int triangle, int layer, const materials::InPlane<double>& C) const;

  /// Of what is added, so far, N mm.
  double work() const { return std::accumulate(work_.begin(), work_.end(), 0.0); }

  double tension_rise = 1;  ///< part of the layers that acts

  void keep(Archive& archive) { archive(memory_, before_, work_, time_, tension_rise); }

 private:
  materials::InPlane<double> changed(int triangle, const materials::InPlane<double>& C, double* memory, double time, double dt, bool remember) const;
  elements::ShellStress<double> through_thickness(int triangle, const elements::ShellStrain<double>& s, double time, double dt);

  const Tissue& tissue_;
  const Wall& wall_;
  std::vector<double> memory_;  ///< per triangle and point of the thickness
  std::vector<std::array<double, 12>> before_;  ///< per triangle: N, M, a, K after the last step
  std::vector<double> work_;    ///< of what is added, per triangle, N mm
  double time_ = 0;
};

}  // namespace palpate::explicit_shell
