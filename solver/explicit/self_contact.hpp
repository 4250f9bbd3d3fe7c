// The wall against itself: nodes against triangles, both faces half a thickness from the mid-surface, by penalties.
// Pairs come from a grid and are kept until a node has moved far enough to make new ones. (Hallquist, Goudreau, Benson 1985, Comput.
// Methods Appl. Mech. Eng. 51:107.)
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <solver/explicit/motion.hpp>

namespace palpate::explicit_shell {

class SelfContact {
 public:
  explicit SelfContact(const Wall& wall);

  /// What a penalty is made of.
  struct Penalty {
    double stiffness = 0;  ///< per mass, 1/s²
    double damping = 0;    ///< of critical, never pulling
    double friction = 0;   ///< Coulomb's coefficient
  };
  /// Adds forces on nodes.
  void touch(const WallState& state, const Penalty& penalty, std::vector<Lanes>& force);

  bool touching() const { return active_ > 0; }
  double area() const { return area_; }         ///< of the nodes in contact at the last touch(), mm², at rest
  double deepest() const { return deepest_; }   ///< of the contact distance so far, mm
  /// A node whose mid-surface all but met another triangle's at the last touch(), or −1.
  int through() const { return through_; }
  long searches() const { return searches_; }
  void keep(Archive& archive) { archive(searched_at_, pairs_, area_, deepest_, active_, searches_); }

 private:
  struct Pair {
    int node, triangle;
    void keep(Archive& archive) { archive(node, triangle); }
  };
  /// How deep a node is in the wall around a triangle, and where.
  struct Near {
    Pair pair;
    std::array<double, 3> weights;
    Lanes normal;
    double depth, wanted;  ///< mm; and the distance at which it would be none
  };
  void search(const WallState& state);
  void consider(const WallState& state, const Pair& pair, Near& near) const;
  void push_apart(const WallState& state, const Near& near, const Penalty& penalty, std::vector<Lanes>& force);

  const Wall& wall_;
  std::vector<double> node_area_;
  std::vector<Lanes> searched_at_;
  std::vector<Pair> pairs_;
  double skin_ = 0, reach_ = 0, area_ = 0, deepest_ = 0;
  int active_ = 0, through_ = -1;
  long searches_ = 0;
};

/// Pairs of triangles without a common node that cross. For checks: exact enough for a count, not fast.
int crossings(const Wall& wall, const std::vector<Lanes>& x);

}  // namespace palpate::explicit_shell
