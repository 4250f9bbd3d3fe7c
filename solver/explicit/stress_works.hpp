// What the stresses of an earlier moment of a closing would press with in the shape of a later one: F(j, k) = ∫ ½ S(k) : ∂C/∂d (j) dV, d the jaws' travel. F(j, j) is the elastic
// force. Where the shape over d does not ask how the tissue relaxes, any relaxation follows: F(t) = ∫ G(t − s) ∂F(j(t), k(s))/∂s ds.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include <solver/archive.hpp>
#include <solver/explicit/wall_forces.hpp>

namespace palpate::explicit_shell {

class StressWorks {
 public:
  /// About `count` moments, a `count`-th of `farthest` mm apart, as rows allow; 0: none are kept.
  StressWorks(int count, double farthest) : count_(count), farthest_(farthest) {}
  /// Keeps the wall's stresses and strains when the next moment has come.
  void look(const Wall& wall, const WallState& state, double travel);
  /// depth[mm],F0[N],F1[N],…: a row per moment j, columns k; F(j, k) of k > j as well.
  std::string csv() const;
  int moments() const { return static_cast<int>(travel_.size()); }
  void keep(Archive& archive) { archive(travel_, stress_, strain_); }

 private:
  int count_;
  double farthest_;
  std::vector<double> travel_;
  std::vector<std::vector<float>> stress_, strain_;  ///< per moment: xx, yy, 2 xy at each point of the thickness of each triangle
};

}  // namespace palpate::explicit_shell
