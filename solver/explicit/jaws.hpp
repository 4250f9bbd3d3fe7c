// A pair of rigid jaws that close on a tube: the lower one rests, the upper one moves along its axis, by a motion or by a pressure on its mass.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <optional>

#include <solver/archive.hpp>
#include <solver/effects/effect.hpp>
#include <solver/explicit/few_forces.hpp>
#include <solver/explicit/motion.hpp>

namespace palpate::explicit_shell {

/// What a person says of the clamp. Lengths in mm.
struct Clamp {
  Eigen::Vector3d centre, axis;  ///< a point between the jaws; where the upper jaw goes
  Eigen::Vector3d along;         ///< the tube's direction
  double width = 40, length = 10, height = 10, edge_radius = 1;  ///< across the tube, along it, along the axis
  double gap = 2;                ///< between the faces when the jaw is stopped
  std::optional<double> open;    ///< between the faces at the start; by default both touch the wall
  std::vector<effects::Active> tractions;  ///< between jaws and wall, besides the pressure: friction, adhesion
  double friction() const;       ///< the coefficient of what holds on among them, for the summary
  double speed = 50;             ///< mm/s, of the motion: mean over the closing
  double hold = 0;               ///< s at the gap, before the jaw opens again
  bool opens = false;            ///< it goes back as it came
  double angle = 0;              ///< radians between the faces, turned about the tube's direction; the gap is that of their middles
  std::optional<double> pressure;  ///< MPa on the upper jaw instead of a motion
  double mass = 3e-5;            ///< tonne
  double jaw_damping = 0;        ///< N s/mm against the jaw's velocity
};

class Jaws {
 public:
  /// Places the jaws. Throws Failure(misuse): they start inside the wall, miss it, or are to stop farther apart than they start.
  Jaws(const Clamp& clamp, const Wall& wall, int threads = 1);

  double start_gap() const { return start_gap_; }
  double gap() const { return start_gap_ - travel_; }
  double travel() const { return travel_; }
  /// The share of the closing that is done, counted from where the wall is met: 0 before, 1 at the stop.
  double closed() const { return met_gap_ > clamp_.gap ? std::max(0.0, (met_gap_ - gap()) / (met_gap_ - clamp_.gap)) : 0; }
  double closing_time() const;  ///< s, of a prescribed motion
  double motion_time() const;   ///< s, with what follows: the hold, the opening
  double kinetic() const;       ///< of the upper jaw, N mm; not part of the wall's ledger

  /// Whether what it found is still all that may touch, so far as the jaws move.
  bool has_looked() const { return std::abs(travel_ - looked_at_) < margin_ / 4; }
  /// Finds the nodes and triangles that may touch before the wall has moved by its longest edge.
  void look(const Wall& wall, const WallState& state);
  /// Adds forces on the wall's nodes within half a thickness of a face, and on those of triangles that would cut a jaw between them;
  /// `stiffness` per mass, 1/s²; `damping` of critical, never pulling.
  void touch(const Wall& wall, const WallState& state, double stiffness, double damping, FewForces& force);
  /// The same in pieces: each thread its nodes, then, when all have, its triangles, and the sums.
  void touch_nodes(const Motion::Share& share, const Wall& wall, const WallState& state, double stiffness, double damping);
  void touch_triangles(const Motion::Share& share, const Wall& wall, double stiffness);
  void gather(const Wall& wall, FewForces& force);
  /// What was slid at the last touch() is where friction goes on; once a step.
  void remember();
  /// Moves the upper jaw by dt; a prescribed motion goes on from `clock` by `pace` (s).
  void move(double clock, double pace, double dt);
  /// Work of the upper jaw, on the wall and on what is stored between them, from the touch() before the last move() to the last touch();
  /// once (N mm).
  double take_work();

  Eigen::Vector3d force_on_wall() const { return forces_[0]; }         ///< by the upper jaw, at the last touch(), N
  double closing_force() const { return forces_[0].dot(clamp_.axis); }
  const std::vector<int>& touched() const { return touched_; }         ///< nodes on the upper jaw at the last touch()
  double deepest() const { return deepest_; }                          ///< penetration of half a thickness at a node so far, mm
  int through() const { return through_; }                             ///< a node whose mid-surface lay in a jaw at the last touch(), or −1
  bool stopped() const { return gap() <= clamp_.gap * (1 + 1e-9); }

  void keep(Archive& archive);

  /// Corners of the two blocks for a picture: eight each, the upper first.
  std::vector<Eigen::Vector3d> corners() const;

 private:
  struct Jaw {
    Eigen::Vector3d face;    ///< the middle of its face
    Eigen::Matrix3d frame;   ///< columns: across, along, back into the block
  };
  /// By a jaw: of a node, or of a triangle between its nodes.
  struct Push {
    Eigen::Vector3d force;
    std::array<int, 3> nodes;   ///< of a node: itself, −1, −1
    std::array<double, 3> weights;
    double depth;               ///< of a node
  };
  Lanes local(const Jaw& jaw, const Lanes& x) const;  ///< seen from the middle of the block
  Eigen::Vector3d tractions_on(int jaw, int node, const tools::Distance& distance, double normal_force, double stiffness, const Wall& wall, const WallState& state);
  void touch_between(int jaw, int triangle, const Wall& wall, double stiffness, std::vector<Push>& pushes) const;
  tools::Distance distance(const Jaw& jaw, const Eigen::Vector3d& x) const;

  Clamp clamp_;
  tools::Shape block_;
  std::vector<double> parameters_;
  std::array<Jaw, 2> jaws_;
  std::vector<double> node_area_;
  std::vector<Lanes> node_normal_;  ///< at rest
  double reach_ = 0;                ///< of the tractions, mm
  std::array<std::vector<contact::Slip>, 2> slips_, slips_now_;  ///< of nodes that touch what holds on
  std::array<Eigen::Vector3d, 2> forces_;
  std::vector<int> touched_;
  std::array<std::vector<int>, 2> near_nodes_, near_triangles_;
  std::vector<char> is_near_;
  std::array<std::vector<Lanes>, 2> local_;  ///< of nodes near a jaw, seen from it
  std::vector<std::array<std::array<std::vector<Push>, 2>, 2>> pushes_;  ///< of each thread: of each jaw: on nodes, on triangles
  double margin_ = 0;         ///< how near that is: twice the longest edge, mm
  int through_ = -1;
  double looked_at_ = -1e30;  ///< travel when they were found
  double start_gap_ = 0, met_gap_ = 0, travel_ = 0, velocity_ = 0, deepest_ = 0, moved_ = 0, force_before_ = 0;
};

}  // namespace palpate::explicit_shell
