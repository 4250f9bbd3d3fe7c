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

/// To four places.
PALPATE_INLINE void put(const elements::Vector<Lanes>& v, const std::array<double*, 4>& to) {
  using Order = long long __attribute__((vector_size(32)));
  const Lanes zero{};
  const Lanes a = __builtin_shuffle(v.x, v.y, Order{0, 4, 2, 6}), b = __builtin_shuffle(v.x, v.y, Order{1, 5, 3, 7});
  const Lanes c = __builtin_shuffle(v.z, zero, Order{0, 4, 2, 6}), d = __builtin_shuffle(v.z, zero, Order{1, 5, 3, 7});
  write(__builtin_shuffle(a, c, Order{0, 1, 4, 5}), to[0]);
  write(__builtin_shuffle(b, d, Order{0, 1, 4, 5}), to[1]);
  write(__builtin_shuffle(a, c, Order{2, 3, 6, 7}), to[2]);
  write(__builtin_shuffle(b, d, Order{2, 3, 6, 7}), to[3]);
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
      double* const first = force + 4 * (12 * p + k);
      put(out.force[k], {first, first + 12, first + 24, first + 36});
      for (int l = 0; l < 4; ++l) slots.moment[12 * p + 3 * l + k] = out.moment[k][l];
    }
    for (int l = 0; l < 4; ++l) slots.energy[4 * p + l] = out.energy[l];
  }
}

/// Four edges at a time; the last four repeat the last edge, to the same numbers.
PALPATE_INLINE void edge_loop(const Wall& wall, WallState& state, std::vector<Lanes>& tangent, double dt, int from, int to) {
  const auto* const x = reinterpret_cast<const double*>(state.x.data());
  auto* const director = reinterpret_cast<double*>(state.director.data());
  auto* const before = reinterpret_cast<double*>(tangent.data());
  for (int first = from; first < to; first += 4) {
    int e[4];
    Lanes along[4], angle;
    std::array<double*, 4> d_at, t_at;
    for (int l = 0; l < 4; ++l) {
      e[l] = first + l < to ? first + l : to - 1;
      along[l] = read(x + 4 * wall.edges[e[l]][1]) - read(x + 4 * wall.edges[e[l]][0]);
      angle[l] = state.spin[e[l]] * dt;
      d_at[l] = director + 4 * e[l], t_at[l] = before + 4 * e[l];
    }
    const auto edge = transposed(along[0], along[1], along[2], along[3]);
    const auto t0 = transposed(read(t_at[0]), read(t_at[1]), read(t_at[2]), read(t_at[3]));
    auto d = transposed(read(d_at[0]), read(d_at[1]), read(d_at[2]), read(d_at[3]));
    const auto t = (1.0 / elements::root(dot(edge, edge))) * edge;
    d = d - (dot(d, t) / (1.0 + dot(t0, t))) * (t0 + t);                     // the smallest turn that takes t0 to t
    const Lanes half = 0.5 * angle * (1.0 + angle * angle * (1.0 / 12));     // tan(angle/2), fifth order
    d = (1.0 - half * half) * d + (2.0 * half) * cross(t, d);                // times 1 + half²; made a unit again below
    d = d - dot(d, t) * t;
    put((1.0 / elements::root(dot(d, d))) * d, d_at);
    put(t, t_at);
  }
}

}  // namespace palpate::explicit_shell
