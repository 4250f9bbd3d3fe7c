// A pressure that follows its faces: r_a = p/6 (x₁ − x₀) × (x₂ − x₀) at each corner of a face, exact for flat faces.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/implicit/assembly.hpp>

namespace palpate::implicit {
namespace {

using Eigen::Vector3d;

/// Twice the face's area along its normal, mm².
Vector3d doubled_area(const std::array<Vector3d, 3>& c) { return (c[1] - c[0]).cross(c[2] - c[0]); }

Block cross_block(const Vector3d& v) {
  Block m = Block::Zero();
  m.topLeftCorner<3, 3>() << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

}  // namespace

void Assembly::add_pressures(const State& state, Equations& equations, BlockMatrix& tangent) const {
  for (const auto& pressure : model_.pressures) {
    const double amplitude = model_.amplitudes[pressure.amplitude].at(state.time);
    auto& forces = equations.pressure_forces.emplace_back(Eigen::VectorXd::Zero(state.nodal.size()));
    for (int f : pressure.faces) {
      const auto now = corners_now(model_, state, f);
      const auto& nodes = model_.faces[f];
      // d(doubled area)/dx_b = [x_{b+2} − x_{b+1}]×, the same at every corner a.
      std::array<Block, 3> by_corner;
      for (int b = 0; b < 3; ++b) by_corner[b] = amplitude * pressure.value / 6 * cross_block(now[(b + 2) % 3] - now[(b + 1) % 3]);
      for (int a = 0; a < 3; ++a) {
        forces.segment<3>(4 * nodes[a]) += pressure.value / 6 * doubled_area(now);
        for (int b = 0; b < 3; ++b)
          if (nodes[b] <= nodes[a]) tangent.add_both(nodes[a], nodes[b], by_corner[b], by_corner[a]);
      }
    }
    equations.residual += amplitude * forces;
  }
}

Vector3d Assembly::pressure_on_organs(const State& state) const {
  Vector3d sum = Vector3d::Zero();
  for (const auto& pressure : model_.pressures)
    for (int f : pressure.faces)
      sum -= model_.amplitudes[pressure.amplitude].at(state.time) * pressure.value / 2 * doubled_area(corners_now(model_, state, f));
  return sum;
}

}  // namespace palpate::implicit
