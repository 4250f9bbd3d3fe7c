// Which version runs, and sums over what the triangles wrote.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/explicit/wall_forces.hpp>

namespace palpate::explicit_shell {

namespace {

bool has_avx2() {
  static const bool has = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  return has;
}

}  // namespace

Slots make_slots(const Wall& wall) {
  const std::size_t triangles = 4 * wall.packs.size();
  return {std::vector<Lanes>(3 * triangles, Lanes{}), std::vector<double>(3 * triangles, 0), std::vector<double>(triangles, 0)};
}

void wall_forces(const Wall& wall, const WallState& state, int from, int to, Slots& slots) {
  (has_avx2() ? wall_forces_avx2 : wall_forces_plain)(wall, state, from, to, slots);
}

void turn_directors(const Wall& wall, WallState& state, std::vector<Lanes>& tangent, double dt, int from, int to) {
  (has_avx2() ? turn_directors_avx2 : turn_directors_plain)(wall, state, tangent, dt, from, to);
}

WallLoad gathered(const Wall& wall, const Slots& slots) {
  WallLoad load{std::vector<Lanes>(wall.rest.size(), Lanes{}), std::vector<double>(wall.edges.size(), 0), 0};
  for (std::size_t i = 0; i < wall.rest.size(); ++i)
    for (int s = wall.node_slots.start[i]; s < wall.node_slots.start[i + 1]; ++s) load.force[i] -= slots.force[wall.node_slots.entries[s]];
  for (std::size_t e = 0; e < wall.edges.size(); ++e)
    for (int s = wall.edge_slots.start[e]; s < wall.edge_slots.start[e + 1]; ++s) load.moment[e] -= slots.moment[wall.edge_slots.entries[s]];
  for (std::size_t t = 0; t < wall.triangles.size(); ++t) load.energy += slots.energy[t];
  return load;
}

}  // namespace palpate::explicit_shell
