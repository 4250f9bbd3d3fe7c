// The wall against itself: nodes against triangles, both faces half a thickness from the mid-surface, by penalties.
// Pairs come from a grid and are kept until a node has moved far enough to make new ones. (Hallquist, Goudreau, Benson 1985, Comput.
// Methods Appl. Mech. Eng. 51:107.)
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <solver/explicit/few_forces.hpp>
#include <solver/explicit/motion.hpp>

namespace palpate::explicit_shell {

class SelfContact {
 public:
  explicit SelfContact(const Wall& wall, int threads = 1);

  /// What a penalty is made of.
  struct Penalty {
    double stiffness = 0;  ///< per mass, 1/s²
    double damping = 0;    ///< of critical, never pulling
    double friction = 0;   ///< Coulomb's coefficient
  };
  /// Adds forces on nodes.
  void touch(const WallState& state, const Penalty& penalty, FewForces& force);
  /// The same in pieces. Whether pairs that may touch must be searched anew; `strayed`: square of the farthest that a node has gone from where they were at the last search, or negative: not known.
  bool is_out_of_date(const WallState& state, double strayed) const;
  /// Searches with the help of the motion's threads.
  void search(const Motion& motion);
  /// Each thread its nodes, and the sums.
  void touch_nodes(const Motion::Share& share, const WallState& state, const Penalty& penalty);
  void gather(FewForces& force);
  /// Where nodes were then.
  const std::vector<Lanes>& searched_at() const { return searched_at_; }

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
  /// Forces on a node and, against it, on a triangle's.
  struct Push {
    Near near;
    Lanes force;
  };
  void search(const WallState& state, const std::function<void(const std::function<void(const Motion::Share&)>&)>& share_out);
  void consider(const WallState& state, const Pair& pair, Near& near) const;
  Lanes force_of(const WallState& state, const Near& near, const Penalty& penalty) const;

  const Wall& wall_;
  std::vector<double> node_area_;
  std::vector<Lanes> searched_at_;
  std::vector<Pair> pairs_;
  std::vector<std::vector<Pair>> found_;   ///< by each thread
  std::vector<std::vector<Push>> pushes_;
  double skin_ = 0, reach_ = 0, area_ = 0, deepest_ = 0;
  int active_ = 0, through_ = -1;
  long searches_ = 0;
};

/// Pairs of triangles without a common node that cross. For checks: exact enough for a count, not fast.
int crossings(const Wall& wall, const std::vector<Lanes>& x);

}  // namespace palpate::explicit_shell
