// Magnitude noise of MR:  M = √((A + σ n₁)² + (σ n₂)²),  n₁, n₂ standard normal (Gudbjartsson and Patz 1995, eq. 1).
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cmath>
#include <cstdint>
#include <numbers>

namespace palpate {

/// 64 well-mixed bits of a counter (splitmix64; Steele, Lea and Flood 2014).
inline std::uint64_t mixed_bits(std::uint64_t counter) {
  std::uint64_t z = counter + 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

/// The magnitude of signal `a` with noise `sigma` in each channel. The same (seed, index) gives the same noise, in any order of calls.
inline double rician(double a, double sigma, std::uint64_t seed, std::uint64_t index) {
  const std::uint64_t stream = mixed_bits(seed);
  const double u = (static_cast<double>(mixed_bits(stream ^ (2 * index)) >> 11) + 0.5) * 0x1p-53;
  const double v = static_cast<double>(mixed_bits(stream ^ (2 * index + 1)) >> 11) * 0x1p-53;
  const double length = sigma * std::sqrt(-2 * std::log(u)), angle = 2 * std::numbers::pi * v;  // Box and Muller 1958
  return std::hypot(a + length * std::cos(angle), length * std::sin(angle));
}

}  // namespace palpate
