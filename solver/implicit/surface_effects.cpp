// Effects of the sockets `layer` and `force` in the equations.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/implicit/assembly.hpp>

#include <algorithm>
#include <cmath>

#include <solver/elements/membrane_triangle.hpp>

namespace palpate::implicit {
namespace {

using Eigen::Vector3d;

/// What a point may do in a run beside: what it does in the run.
effects::Branch branch(const Neighbourhood* beside, std::size_t point) {
  if (!beside || beside->slides.empty()) return effects::Branch::by_bound;
  return beside->slides[point] ? effects::Branch::slides : effects::Branch::sticks;
}

/// Calls `visit` with every region force, its point, and where the point's memory begins.
template <class Visit>
void for_each_point(const Model& model, std::size_t first, const Visit& visit) {
  for (const auto& bed : model.region_forces)
    for (const auto& point : bed.points) {
      visit(bed, point, first);
      first += bed.memory();
    }
}

}  // namespace

void Assembly::add_layers(const State& state, Equations& equations, BlockMatrix& tangent) const {
  const double grown = grown_part(state.time);
  for (const auto& layer : model_.layers)
    for (int f : layer.faces) {
      const auto& nodes = model_.faces[f];
      const auto system = elements::membrane_triangle(layer, {model_.points[nodes[0]], model_.points[nodes[1]], model_.points[nodes[2]]}, corners_now(model_, state, f));
      equations.stored.grown_layers += system.energy;
      equations.internal_force = std::hypot(equations.internal_force, grown * system.internal_force);
      for (int a = 0; a < 3; ++a) {
        equations.residual.segment<3>(4 * nodes[a]) += grown * system.residual.segment<3>(3 * a);
        for (int b = 0; b < 3; ++b) {
          if (nodes[b] > nodes[a]) continue;
          Block block = Block::Zero();
          block.topLeftCorner<3, 3>() = grown * system.tangent.block<3, 3>(3 * a, 3 * b);
          tangent.add(nodes[a], nodes[b], block);
        }
      }
    }
  equations.stored.layers = grown * equations.stored.grown_layers;
}

void Assembly::learn_region_forces(const State& state, Neighbourhood& known) const {
  known.slides.clear();
  for_each_point(model_, memory_starts_.back(), [&](const RegionForce& bed, const RegionForce::Point& point, std::size_t first) {
    known.slides.push_back(bed.effect.force.respond({state.displacement(point.node), point.normal}, {state.memory.data() + first, static_cast<std::size_t>(bed.memory())}, bed.parameters).slides);
  });
}

void Assembly::add_region_forces(const State& state, Equations& equations, BlockMatrix& tangent, const Neighbourhood* beside) const {
  std::size_t at = 0;
  for_each_point(model_, memory_starts_.back(), [&](const RegionForce& bed, const RegionForce::Point& point, std::size_t first) {
    const auto push = bed.effect.force.respond({state.displacement(point.node), point.normal, branch(beside, at++)}, {state.memory.data() + first, static_cast<std::size_t>(bed.memory())}, bed.parameters);
    equations.residual.segment<3>(4 * point.node) -= point.area * push.traction;
    Block block = Block::Zero();
    block.topLeftCorner<3, 3>() = -point.area * push.by_displacement;
    tangent.add_both(point.node, point.node, block, block);
  });
}

Vector3d Assembly::region_forces_on_organs(const State& state) const {
  Vector3d sum = Vector3d::Zero();
  for_each_point(model_, memory_starts_.back(), [&](const RegionForce& bed, const RegionForce::Point& point, std::size_t first) {
    sum += point.area * bed.effect.force.respond({state.displacement(point.node), point.normal}, {state.memory.data() + first, static_cast<std::size_t>(bed.memory())}, bed.parameters).traction;
  });
  return sum;
}

void Assembly::remember_region_forces(const State& state, std::vector<double>& memory, const Neighbourhood* beside) const {
  std::size_t at = 0;
  for_each_point(model_, memory_starts_.back(), [&](const RegionForce& bed, const RegionForce::Point& point, std::size_t first) {
    bed.effect.force.remember({state.displacement(point.node), point.normal, branch(beside, at++)}, {memory.data() + first, static_cast<std::size_t>(bed.memory())}, bed.parameters);
  });
}

}  // namespace palpate::implicit
