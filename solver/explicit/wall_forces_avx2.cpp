// The element loop with AVX2 and FMA (cmake gives this one file the flags).
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/explicit/wall_forces_loop.hpp>

namespace palpate::explicit_shell {

void wall_forces_avx2(const Wall& wall, const WallState& state, int from, int to, Slots& slots) {
  std::visit([&](const auto& law) { element_loop(wall, state, from, to, slots, law); }, wall.law);
}

void turn_directors_avx2(const Wall& wall, WallState& state, std::vector<Lanes>& tangent, double dt, int from, int to) {
  edge_loop(wall, state, tangent, dt, from, to);
}

}  // namespace palpate::explicit_shell
