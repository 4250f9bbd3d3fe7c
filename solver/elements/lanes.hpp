// Four numbers side by side: an element formula written once for double runs on four elements at a time (GCC's vector types).
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cmath>

namespace palpate::elements {

using Lanes = double __attribute__((vector_size(32)));

#define PALPATE_INLINE [[gnu::always_inline]] inline

PALPATE_INLINE double root(double x) { return __builtin_sqrt(x); }
PALPATE_INLINE Lanes root(const Lanes& x) {
  return Lanes{__builtin_sqrt(x[0]), __builtin_sqrt(x[1]), __builtin_sqrt(x[2]), __builtin_sqrt(x[3])};
}

/// f of each lane.
template <class Function>
PALPATE_INLINE double each(double x, const Function& f) {
  return f(x);
}
template <class Function>
PALPATE_INLINE Lanes each(const Lanes& x, const Function& f) {
  return Lanes{f(x[0]), f(x[1]), f(x[2]), f(x[3])};
}

PALPATE_INLINE double at_least(double x, double low) { return x > low ? x : low; }
PALPATE_INLINE Lanes at_least(const Lanes& x, const Lanes& low) { return x > low ? x : low; }

template <class T>
struct Vector {
  T x, y, z;
};
template <class T>
PALPATE_INLINE Vector<T> operator+(const Vector<T>& a, const Vector<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
PALPATE_INLINE Vector<T> operator-(const Vector<T>& a, const Vector<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
PALPATE_INLINE Vector<T> operator*(const T& s, const Vector<T>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class T>
PALPATE_INLINE T dot(const Vector<T>& a, const Vector<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
PALPATE_INLINE Vector<T> cross(const Vector<T>& a, const Vector<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace palpate::elements
