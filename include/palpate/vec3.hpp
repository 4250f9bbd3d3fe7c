// Points and affine maps of space: x' = A x + b. Millimetres, patient LPS, unless a name says otherwise.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <cmath>

namespace palpate {

using Vec3 = std::array<double, 3>;

inline Vec3 operator+(const Vec3& a, const Vec3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Vec3 operator-(const Vec3& a, const Vec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Vec3 operator*(double s, const Vec3& a) { return {s * a[0], s * a[1], s * a[2]}; }
inline double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline double norm(const Vec3& a) { return std::sqrt(dot(a, a)); }
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Vec3 unit(const Vec3& a) { return (1.0 / norm(a)) * a; }

/// x' = A x + b: `columns[0..2]` are A's columns, `origin` is b.
struct Affine {
  std::array<Vec3, 3> columns{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  Vec3 origin{0, 0, 0};

  Vec3 linear(const Vec3& v) const { return v[0] * columns[0] + v[1] * columns[1] + v[2] * columns[2]; }
  Vec3 operator()(const Vec3& x) const { return origin + linear(x); }
  double determinant() const { return dot(columns[0], cross(columns[1], columns[2])); }

  /// The inverse map. Requires determinant() ≠ 0.
  Affine inverse() const {
    const double d = determinant();
    const Vec3 r0 = (1 / d) * cross(columns[1], columns[2]);
    const Vec3 r1 = (1 / d) * cross(columns[2], columns[0]);
    const Vec3 r2 = (1 / d) * cross(columns[0], columns[1]);
    Affine inv;
    for (int i = 0; i < 3; ++i) inv.columns[i] = {r0[i], r1[i], r2[i]};
    inv.origin = -1.0 * inv.linear(origin);
    return inv;
  }
};

}  // namespace palpate
