// Regions by nodes: each with its third of the triangles around.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/explicit/beds.hpp>

#include <map>

namespace palpate::explicit_shell {
namespace {

using Eigen::Vector3d;

Vector3d vector(const Lanes& a) { return {a[0], a[1], a[2]}; }

int numbers(const Bed& bed) { return bed.active.effect.force.memory(bed.active.parameters); }

effects::Held held(const Bed::Point& p, const Wall& wall, const WallState& state) { return {vector(state.x[p.node] - wall.rest[p.node]), p.normal}; }

}  // namespace

Bed make_bed(const effects::Active& active, const Wall& wall, const std::vector<int>& triangles) {
  std::map<int, Vector3d> areas;
  for (int t : triangles) {
    const auto& [a, b, c] = wall.triangles[t];
    const Vector3d sixth = vector(cross3(wall.rest[b] - wall.rest[a], wall.rest[c] - wall.rest[a])) / 6;
    for (int node : wall.triangles[t]) areas.try_emplace(node, Vector3d::Zero()).first->second += sixth;
  }
  Bed bed{active, {}};
  for (const auto& [node, area] : areas) bed.points.push_back({node, area.norm(), area.normalized()});
  bed.memory.assign(bed.points.size() * numbers(bed), 0);
  return bed;
}

double stiffness_per_mass(const std::vector<Bed>& beds, const Wall& wall) {
  std::vector<double> sum(wall.rest.size(), 0);
  for (const auto& bed : beds) {
    const std::vector<double> rest(numbers(bed), 0);
    for (const auto& p : bed.points)
      sum[p.node] += p.area / wall.mass[p.node] * bed.active.effect.force.respond({Vector3d::Zero(), p.normal}, rest, bed.active.parameters).by_displacement.operatorNorm();
  }
  return *std::max_element(sum.begin(), sum.end());
}

void press(const std::vector<Bed>& beds, const Wall& wall, const WallState& state, std::vector<Lanes>& load) {
  for (const auto& bed : beds) {
    const std::size_t size = numbers(bed);
    for (std::size_t i = 0; i < bed.points.size(); ++i) {
      const auto& p = bed.points[i];
      const Vector3d f = p.area * bed.active.effect.force.respond(held(p, wall, state), {bed.memory.data() + i * size, size}, bed.active.parameters).traction;
      load[p.node] += Lanes{f[0], f[1], f[2], 0};
    }
  }
}

void remember(std::vector<Bed>& beds, const Wall& wall, const WallState& state) {
  for (auto& bed : beds) {
    const std::size_t size = numbers(bed);
    if (size > 0)
      for (std::size_t i = 0; i < bed.points.size(); ++i)
        bed.active.effect.force.remember(held(bed.points[i], wall, state), {bed.memory.data() + i * size, size}, bed.active.parameters);
  }
}

}  // namespace palpate::explicit_shell
