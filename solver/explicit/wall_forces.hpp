// Internal forces of a range of packs, by the fastest version this processor can run.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <solver/explicit/wall.hpp>

namespace palpate::explicit_shell {

/// What each triangle writes, gathered by nodes and edges afterwards: the same sums in the same order on any number of threads.
struct Slots {
  std::vector<Lanes> force;     ///< 3 · triangle + corner, N: derivative of the energy
  std::vector<double> moment;   ///< 3 · triangle + edge, N mm
  std::vector<double> energy;   ///< of a triangle, N mm
};
Slots make_slots(const Wall& wall);

/// Packs `from` … `to` − 1.
void wall_forces(const Wall& wall, const WallState& state, int from, int to, Slots& slots);

/// The two versions of it; the second needs a processor with AVX2 and FMA.
void wall_forces_plain(const Wall& wall, const WallState& state, int from, int to, Slots& slots);
void wall_forces_avx2(const Wall& wall, const WallState& state, int from, int to, Slots& slots);

/// Directors of edges `from` … `to` − 1, carried with their edges by the smallest turn from the old tangent to the new one, then turned about the new one
/// by spin · dt; `tangent` is renewed.
void turn_directors(const Wall& wall, WallState& state, std::vector<Lanes>& tangent, double dt, int from, int to);
void turn_directors_plain(const Wall& wall, WallState& state, std::vector<Lanes>& tangent, double dt, int from, int to);
void turn_directors_avx2(const Wall& wall, WallState& state, std::vector<Lanes>& tangent, double dt, int from, int to);

/// The forces on all nodes (resisting: −dW/dx) and directors, and the energy.
struct WallLoad {
  std::vector<Lanes> force;
  std::vector<double> moment;
  double energy = 0;
};
WallLoad gathered(const Wall& wall, const Slots& slots);

}  // namespace palpate::explicit_shell
