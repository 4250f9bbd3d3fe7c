// Central differences: velocities at half steps, directors turned by their spin and carried with their edges; the energy ledger.
// (Belytschko, Liu, Moran 2000, Nonlinear Finite Elements, box 6.1.)
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <memory>

#include <solver/explicit/tissue.hpp>
#include <solver/explicit/wall_forces.hpp>

namespace palpate::explicit_shell {

/// What a node may do.
enum class Hold { free, along, across, fixed };  ///< `along`: only along the direction; `across`: only at right angles to it

struct Holds {
  std::vector<Hold> hold;        ///< one per node
  std::vector<Lanes> direction;  ///< unit
  std::vector<char> edge_fixed;  ///< directors that do not turn: clamped, or on a plane of symmetry
};
Holds no_holds(const Wall& wall);

/// Energies and works since the start, N mm.
struct Ledger {
  double kinetic = 0, internal = 0;
  double contact = 0;   ///< stored in penalties and lost in friction: what tools put in and the wall did not get
  double damping = 0;
  double external = 0;  ///< by loads and by tools
  double imbalance() const { return external - kinetic - internal - contact - damping; }
  void keep(Archive& archive) { archive(kinetic, internal, contact, damping, external); }
};

/// Forces from outside at the present place: on nodes (N), on directors (N mm), and the power tools put in (N mm/s).
struct Outside {
  std::vector<Lanes> load, contact;
  std::vector<double> moment;
};

/// Largest square of the distance between nodes of two shapes.
double farthest(const std::vector<Lanes>& x, const std::vector<Lanes>& from, int first, int last);

struct Team;

class Motion {
 public:
  /// `threads` share the triangles. Forces at the start are found at once. `tissue`: or null.
  Motion(const Wall& wall, Holds holds, int threads, TissueForces* tissue = nullptr);
  ~Motion();

  WallState state;
  Outside outside;      ///< filled by the caller before step(); kept until changed
  double damping = 0;   ///< 1/s, of all velocities

  /// One step of length dt (s). With `from`: the square of the farthest that a node is then from there; else negative.
  double step(double dt, const std::vector<Lanes>* from = nullptr);
  /// Stops everything where it is; what it had counts as damping.
  void halt();
  /// What a thread moves itself, and so has in its cache: nodes and triangles by number.
  struct Share {
    int thread = 0, node = 0, last_node = 0, triangle = 0, last_triangle = 0;
  };
  /// Each thread does its share; what it writes must be its own, and it must not throw.
  void shared(const std::function<void(const Share&)>& work) const;
  /// Inside of it: waits until all have come here.
  void meet() const;
  /// Adds what tools put in during the last step.
  void add_tool_work(double work) { tool_work_ += work; }

  double time() const { return time_; }
  /// Now: velocities and works are carried on by half a step with the present forces, `outside` included.
  Ledger ledger() const;
  const Slots& slots() const { return slots_; }
  double kinetic() const;   ///< half a step ago, N mm
  double internal() const;  ///< N mm
  /// Smallest of all triangles' stable steps, and whose it is.
  std::pair<double, int> stable() const;
  /// For a run that is continued: all that the next step needs.
  void keep(Archive& archive);
  /// Forces of the wall and of what is outside on the nodes; what a rest would make zero away from holds.
  std::vector<Lanes> residual() const;

 private:
  Lanes inner_force(int node) const;    ///< derivative of the energy by its place
  double inner_moment(int edge) const;  ///< by its director's angle
  void move_nodes(int from, int to, double dt, double dt_mid);
  void turn_edges(int from, int to, double dt, double dt_mid);

  void find_forces(int from, int to, double dt);
  double sum_of(const std::function<double(double part, double next)>& sum) const;

  const Wall& wall_;
  Holds holds_;
  TissueForces* tissue_;
  Slots slots_;
  std::vector<Lanes> tangent_;  ///< of the edges, unit
  std::vector<double> work_;    ///< per node: load, contact, damping
  std::vector<double> edge_work_;
  double time_ = 0, dt_before_ = 0, tool_work_ = 0;
  Ledger halted_;  ///< of motions that were stopped between two steps
  std::unique_ptr<Team> team_;  ///< none: one thread
};

}  // namespace palpate::explicit_shell
