// The element loop over packs of four: compiled once per instruction set, in the .cpp files that include it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <solver/explicit/wall_forces.hpp>

namespace palpate::explicit_shell {

/// Files compiled without AVX align Lanes to 16 bytes only: single ones are read and written as if not aligned at all.
PALPATE_INLINE Lanes read(const double* from) {
  Lanes v;
  __builtin_memcpy(&v, from, sizeof v);
  return v;
}
PALPATE_INLINE void write(const Lanes& v, double* to) { __builtin_memcpy(to, &v, sizeof v); }

/// Four vectors in space to three lanes of coordinates, and back.
PALPATE_INLINE elements::Vector<Lanes> transposed(const Lanes& a, const Lanes& b, const Lanes& c, const Lanes& d) {
  using Order = long long __attribute__((vector_size(32)));
  const Lanes ab = __builtin_shuffle(a, b, Order{0, 4, 2, 6}), ab1 = __builtin_shuffle(a, b, Order{1, 5, 3, 7});
  const Lanes cd = __builtin_shuffle(c, d, Order{0, 4, 2, 6}), cd1 = __builtin_shuffle(c, d, Order{1, 5, 3, 7});
  return {__builtin_shuffle(ab, cd, Order{0, 1, 4, 5}), __builtin_shuffle(ab1, cd1, Order{0, 1, 4, 5}), __builtin_shuffle(ab, cd, Order{2, 3, 6, 7})};
}

PALPATE_INLINE void put(const elements::Vector<Lanes>& v, double* to) {  // every third vector
  using Order = long long __attribute__((vector_size(32)));
  const Lanes zero{};
  const Lanes a = __builtin_shuffle(v.x, v.y, Order{0, 4, 2, 6}), b = __builtin_shuffle(v.x, v.y, Order{1, 5, 3, 7});
  const Lanes c = __builtin_shuffle(v.z, zero, Order{0, 4, 2, 6}), d = __builtin_shuffle(v.z, zero, Order{1, 5, 3, 7});
  write(__builtin_shuffle(a, c, Order{0, 1, 4, 5}), to + 0);
  write(__builtin_shuffle(b, d, Order{0, 1, 4, 5}), to + 12);
  write(__builtin_shuffle(a, c, Order{2, 3, 6, 7}), to + 24);
  write(__builtin_shuffle(b, d, Order{2, 3, 6, 7}), to + 36);
}

template <class Law>
PALPATE_INLINE void element_loop(const Wall& wall, const WallState& state, int from, int to, Slots& slots, const Law& law) {
  const auto* const x = reinterpret_cast<const double*>(state.x.data());
  const auto* const d = reinterpret_cast<const double*>(state.director.data());
  auto* const force = reinterpret_cast<double*>(slots.force.data());
  for (int p = from; p < to; ++p) {
    const Pack& pack = wall.packs[p];
    elements::ShellNow<Lanes> now;
    for (int k = 0; k < 3; ++k) {
      const auto &n = pack.node[k], &e = pack.edge[k];
      now.x[k] = transposed(read(x + 4 * n[0]), read(x + 4 * n[1]), read(x + 4 * n[2]), read(x + 4 * n[3]));
      now.director[k] = transposed(read(d + 4 * e[0]), read(d + 4 * e[1]), read(d + 4 * e[2]), read(d + 4 * e[3]));
    }
    const auto strain = elements::shell_strain(pack.rest, now);
    const auto out = elements::shell_forces(pack.rest, now, strain, elements::shell_stress(pack.rest, strain, law));
    for (int k = 0; k < 3; ++k) {
      put(out.force[k], force + 4 * (12 * p + k));
      for (int l = 0; l < 4; ++l) slots.moment[12 * p + 3 * l + k] = out.moment[k][l];
    }
    for (int l = 0; l < 4; ++l) slots.energy[4 * p + l] = out.energy[l];
  }
}

}  // namespace palpate::explicit_shell
