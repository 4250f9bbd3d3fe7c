// What this processor could do with the element loop of the explicit shells: operations and bytes per triangle and cycle, counted by running the
// element's own formulas on numbers that count, over what the processor does at most of each, measured on one core.
//   bench-shell-roofline [MEASURED million element-cycles per second]
// SPDX-License-Identifier: GPL-3.0-or-later
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <utility>
#include <vector>

namespace palpate::elements {

/// A double that counts what is done with it.
struct Counted {
  double v = 0;
  Counted() = default;
  Counted(double value) : v(value) {}
  inline static long sums = 0, products = 0, quotients = 0, roots = 0;
};
inline Counted operator+(Counted a, Counted b) { return ++Counted::sums, Counted(a.v + b.v); }
inline Counted operator-(Counted a, Counted b) { return ++Counted::sums, Counted(a.v - b.v); }
inline Counted operator-(Counted a) { return Counted(-a.v); }
inline Counted operator*(Counted a, Counted b) { return ++Counted::products, Counted(a.v * b.v); }
inline Counted operator/(Counted a, Counted b) { return ++Counted::quotients, Counted(a.v / b.v); }
inline Counted& operator+=(Counted& a, Counted b) { return a = a + b; }
inline Counted root(const Counted& a) { return ++Counted::roots, Counted(std::sqrt(a.v)); }

}  // namespace palpate::elements

#include <solver/explicit/wall.hpp>

using namespace palpate;
using elements::Counted;
using elements::Lanes;
using Clock = std::chrono::steady_clock;

namespace {

/// Of one triangle in one cycle, its forces only.
void count_element() {
  elements::ShellRest<Counted> rest{1.0, -0.5, 0.0, 1.1, 0.45, 1.4, {1.0, 1.0, 1.0}, {}, {0.01, 0.02, 0.0}, {1.0, 1.0, 1.0}};
  for (auto& P : rest.P) P = {0.7, 0.3, 0.1};
  elements::ShellNow<Counted> now;
  now.x = {{{0.0, 0.0, 0.0}, {1.1, 0.0, 0.1}, {0.5, 0.9, 0.0}}};
  now.director = {{{0.1, 0.0, 1.0}, {0.0, 0.1, 1.0}, {0.0, 0.0, 1.0}}};
  Counted::sums = Counted::products = Counted::quotients = Counted::roots = 0;
  const auto strain = elements::shell_strain(rest, now);
  elements::shell_forces(rest, now, strain, elements::shell_stress(rest, strain, materials::MooneyRivlinShell{0.083, 0.0565}));
}

/// Seconds of the fastest of five calls, per unit of work.
template <class Work>
double fastest(double units, const Work& work) {
  double best = 1e30;
  for (int i = 0; i < 5; ++i) {
    const auto start = Clock::now();
    work();
    best = std::min(best, std::chrono::duration<double>(Clock::now() - start).count());
  }
  return best / units;
}

constexpr int chains = 12, rounds = 2000000;
volatile double seen;

[[gnu::target("avx2,fma")]] void multiply_and_add() {
  Lanes x[chains];
  for (int c = 0; c < chains; ++c) x[c] = Lanes{1, 2, 3, 4} * (1.0 + c);
  const Lanes a{0.999, 0.998, 0.997, 0.996}, b{0.1, 0.2, 0.3, 0.4};
  for (int r = 0; r < rounds; ++r)
    for (int c = 0; c < chains; ++c) x[c] = x[c] * a + b;
  for (int c = 0; c < chains; ++c) seen = x[c][0];
}

[[gnu::target("avx2,fma")]] void divide() {
  Lanes x[chains];
  for (int c = 0; c < chains; ++c) x[c] = Lanes{1, 2, 3, 4} * (1.0 + c);
  const Lanes a{1.1, 1.2, 1.3, 1.4};
  for (int r = 0; r < rounds / 10; ++r)
    for (int c = 0; c < chains; ++c) x[c] = a / x[c];
  for (int c = 0; c < chains; ++c) seen = x[c][0];
}

[[gnu::target("avx2,fma")]] void take_roots() {
  Lanes x[chains];
  for (int c = 0; c < chains; ++c) x[c] = Lanes{1, 2, 3, 4} * (1.0 + c);
  for (int r = 0; r < rounds / 10; ++r)
    for (int c = 0; c < chains; ++c)
      x[c] = Lanes{__builtin_sqrt(x[c][0]), __builtin_sqrt(x[c][1]), __builtin_sqrt(x[c][2]), __builtin_sqrt(x[c][3])};
  for (int c = 0; c < chains; ++c) seen = x[c][0];
}

/// a = b + s c over 96 MB, or over 0.4 MB, which a core's own cache holds.
double bytes_per_second(std::size_t count) {
  std::vector<double> a(count, 1), b(count, 2), c(count, 3);
  const int again = static_cast<int>(4000000 / count) + 1;
  return 1 / fastest(24.0 * count * again, [&] {
    for (int r = 0; r < again; ++r) {
      for (std::size_t i = 0; i < count; ++i) a[i] = b[i] + 0.5 * c[i];
      seen = a[count / 2];
    }
  });
}

}  // namespace

int main(int argc, char** argv) {
  count_element();
  const double sums = Counted::sums, products = Counted::products, quotients = Counted::quotients, roots = Counted::roots;
  // a pack's quarter; three corners and directors read; three forces and moments and an energy written, forces read again by the nodes
  const double bytes = sizeof(explicit_shell::Pack) / 4.0 + 6 * sizeof(Lanes) + 2 * (3 * sizeof(Lanes) + 3 * sizeof(double)) + sizeof(double);
  const double fma = fastest(4.0 * chains * rounds, multiply_and_add), division = fastest(4.0 * chains * rounds / 10, divide), root = fastest(4.0 * chains * rounds / 10, take_roots);
  const double memory = bytes_per_second(4000000), cache = bytes_per_second(16000);
  const double asked = argc > 1 ? std::atof(argv[1]) : 0;
  std::printf("per triangle and cycle: %.0f sums, %.0f products, %.0f quotients, %.0f roots; %.0f bytes\n", sums, products, quotients, roots, bytes);
  std::printf("at most, one core: %.1f G products with a sum/s, %.2f G quotients/s, %.2f G roots/s; %.1f GB/s from memory, %.1f GB/s from the core's cache\n", 1e-9 / fma, 1e-9 / division,
              1e-9 / root, 1e-9 * memory, 1e-9 * cache);
  const double fused = std::max(sums, products) * fma, apart = (sums + products) * fma, slow = quotients * division + roots * root;
  std::printf("million element-cycles per second and core, at most: %.1f by arithmetic with every sum fused, %.1f with none, %.1f by quotients and roots alone; %.1f by memory, %.1f by cache\n",
              1e-6 / fused, 1e-6 / apart, 1e-6 / slow, 1e-6 * memory / bytes, 1e-6 * cache / bytes);
  if (asked > 0) std::printf("measured %.1f million: %.0f %% of what arithmetic without fusing, quotients and roots one after the other allow\n", asked, 100 * asked * 1e6 * (apart + slow));
}
