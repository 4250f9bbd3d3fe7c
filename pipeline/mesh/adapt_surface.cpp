// Botsch & Kobbelt, "A remeshing approach to multiresolution modeling" (2004), with a length that varies in space.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/mesh/adapt_surface.hpp>

#include <algorithm>
#include <numbers>

#include <pipeline/mesh/components.hpp>
#include <pipeline/mesh/nearest_point.hpp>
#include <pipeline/mesh/tri_complex.hpp>

namespace palpate {
namespace {

constexpr double cos_sharp = std::numbers::sqrt2 / 2;  ///< normals that differ by more than 45° meet at a sharp edge
constexpr double too_long = 4.0 / 3, too_short = 4.0 / 5;
constexpr int rounds = 10;

/// The input as a curved surface: the nearest point of its triangles, lifted by Phong tessellation.
class CurvedSurface {
 public:
  explicit CurvedSurface(const Surface& surface) : index_(surface), normals_(surface.points.size(), Vec3{0, 0, 0}) {
    for (const auto& t : surface.triangles) {
      const Vec3 n = cross(surface.points[t[1]] - surface.points[t[0]], surface.points[t[2]] - surface.points[t[0]]);
      for (int i : t) normals_[i] = normals_[i] + n;
    }
    for (Vec3& n : normals_)
      if (norm(n) > 0) n = unit(n);
  }

  Vec3 place(const Vec3& x) const {
    const NearestPoint nearest = index_.nearest(x);
    const auto& t = index_.surface().triangles[nearest.triangle];
    const Vec3 p[3] = {index_.surface().points[t[0]], index_.surface().points[t[1]], index_.surface().points[t[2]]};
    const Vec3 n = cross(p[1] - p[0], p[2] - p[0]);
    if (!(norm(n) > 0)) return nearest.point;
    Vec3 lifted{0, 0, 0};
    for (int k = 0; k < 3; ++k) {
      if (dot(normals_[t[k]], unit(n)) < cos_sharp) return nearest.point;
      const double weight = dot(cross(p[(k + 1) % 3] - nearest.point, p[(k + 2) % 3] - nearest.point), n) / dot(n, n);
      lifted = lifted + weight * (nearest.point - dot(nearest.point - p[k], normals_[t[k]]) * normals_[t[k]]);
    }
    return 0.25 * nearest.point + 0.75 * lifted;
  }

 private:
  SurfaceIndex index_;
  std::vector<Vec3> normals_;
};

class Adaptation {
 public:
  Adaptation(const Surface& surface, const SizeField& sizes, const AdaptWhere& where) : curved_(surface), tri_(surface), sizes_(sizes), where_(where), origin_(surface.points.front()) {}

  void round() {
    split_long();
    mark_sharp();
    collapse_short();
    mark_sharp();
    for (int i = 0; i < 2; ++i) flip_to_delaunay();
    relax();
  }
  Surface result(const RegionNames& names) const { return tri_.surface(names); }

  /// Chords cut corners: moves the adapted part along its normals by (V − V_now)/A, until `volume_mm3` is enclosed.
  void restore_volume(double volume_mm3) {
    for (int i = 0; i < 3; ++i) {
      std::vector<Vec3> normals(tri_.node_count(), Vec3{0, 0, 0});
      double area = 0, volume = 0;
      for (int t = 0; t < tri_.size(); ++t) {
        if (!tri_.alive(t)) continue;
        const Vec3 n = tri_.normal(tri_.triangle(t));
        for (int k : tri_.triangle(t)) {
          normals[k] = normals[k] + n;
          if (where_(tri_.point(k))) area += norm(n) / 6;
        }
        volume += dot(tri_.point(tri_.triangle(t)[0]) - origin_, n) / 6;
      }
      const double missing = volume_mm3 - volume;
      if (!(area > 0) || std::abs(missing) <= 1e-9 * std::abs(volume_mm3)) return;
      for (int k = 0; k < tri_.node_count(); ++k)
        if (norm(normals[k]) > 0 && where_(tri_.point(k))) tri_.move(k, tri_.point(k) + missing / area * unit(normals[k]));
    }
  }

 private:
  Vec3 middle(const TriEdge& e) const { return 0.5 * (tri_.point(e.a) + tri_.point(e.b)); }
  double wanted(const TriEdge& e) const { return sizes_.at(middle(e)); }
  bool is_sharp_edge(const TriEdge& e) const {
    const Vec3 n = tri_.normal(tri_.triangle(e.left)), m = tri_.normal(tri_.triangle(e.right));
    return dot(n, m) < cos_sharp * norm(n) * norm(m);
  }

  void mark_sharp() {
    sharp_.assign(tri_.node_count(), false);
    for (const TriEdge& e : tri_.edges())
      if (is_sharp_edge(e)) sharp_[e.a] = sharp_[e.b] = true;
  }

  void split_long() {
    for (bool any = true; any;) {
      any = false;
      std::vector<TriEdge> edges;
      for (const TriEdge& e : tri_.edges())
        if (where_(middle(e)) && tri_.length(e.a, e.b) > too_long * wanted(e)) edges.push_back(e);
      std::stable_sort(edges.begin(), edges.end(), [&](const TriEdge& x, const TriEdge& y) { return tri_.length(x.a, x.b) > tri_.length(y.a, y.b); });
      for (const TriEdge& old : edges) {
        const TriEdge e = tri_.find_edge(old.a, old.b);
        tri_.split(e, is_sharp_edge(e) ? middle(e) : curved_.place(middle(e)));
        any = true;
      }
    }
  }

  void collapse_short() {
    std::vector<TriEdge> edges;
    for (const TriEdge& e : tri_.edges())
      if (where_(middle(e)) && tri_.length(e.a, e.b) < too_short * wanted(e)) edges.push_back(e);
    std::stable_sort(edges.begin(), edges.end(), [&](const TriEdge& x, const TriEdge& y) { return tri_.length(x.a, x.b) < tri_.length(y.a, y.b); });
    for (const TriEdge& old : edges) {
      TriEdge e = tri_.find_edge(old.a, old.b);
      if (e.left < 0 || !(tri_.length(e.a, e.b) < too_short * wanted(e))) continue;
      if (sharp_[e.a] && sharp_[e.b]) continue;
      if (sharp_[e.b]) e = tri_.find_edge(old.b, old.a);
      const Vec3 x = sharp_[e.a] ? tri_.point(e.a) : curved_.place(middle(e));
      if (tri_.can_collapse(e) && keeps_shape(e, x)) tri_.collapse(e, x);
    }
  }

  /// After a collapse to x no edge is too long, and no triangle turns by more than 45° or degenerates.
  bool keeps_shape(const TriEdge& e, const Vec3& x) const {
    for (int node : {e.a, e.b})
      for (int t : tri_.star(node)) {
        if (t == e.left || t == e.right) continue;
        const Vec3 before = tri_.normal(tri_.triangle(t)), after = tri_.normal_with(t, node, x);
        if (!(dot(before, after) > cos_sharp * norm(before) * norm(after))) return false;
        for (int i : tri_.triangle(t))
          if (i != node && norm(tri_.point(i) - x) > too_long * sizes_.at(0.5 * (tri_.point(i) + x))) return false;
      }
    return true;
  }

  /// Flips where the opposite angles sum to more than 180° and both new triangles face like the old.
  void flip_to_delaunay() {
    for (const TriEdge& old : tri_.edges()) {
      const TriEdge e = tri_.find_edge(old.a, old.b);
      if (e.left < 0 || !where_(middle(e)) || is_sharp_edge(e) || !(cosine(e.a, e.c, e.b) + cosine(e.a, e.d, e.b) < -1e-9)) continue;
      const Vec3 mean = tri_.normal(tri_.triangle(e.left)) + tri_.normal(tri_.triangle(e.right));
      const Vec3 one = tri_.normal({e.c, e.a, e.d}), two = tri_.normal({e.d, e.b, e.c});
      const bool faces_on = dot(one, mean) > cos_sharp * norm(one) * norm(mean) && dot(two, mean) > cos_sharp * norm(two) * norm(mean);
      if (faces_on && tri_.can_flip(e)) tri_.flip(e);
    }
  }

  /// Cosine of the angle at `apex`; the sum of two is negative when the angles sum to more than 180°.
  double cosine(int a, int apex, int b) const {
    const Vec3 p = tri_.point(a) - tri_.point(apex), q = tri_.point(b) - tri_.point(apex);
    return dot(p, q) / (norm(p) * norm(q));
  }

  /// Each node goes to the area-weighted mean of its triangles' centres, back onto the surface, unless a triangle would turn.
  void relax() {
    for (int i = 0; i < tri_.node_count(); ++i) {
      if (tri_.star(i).empty() || sharp_[i] || !where_(tri_.point(i))) continue;
      Vec3 sum{0, 0, 0};
      double weights = 0;
      for (int t : tri_.star(i)) {
        const auto& [a, b, c] = tri_.triangle(t);
        const Vec3 centre = 1.0 / 3 * (tri_.point(a) + tri_.point(b) + tri_.point(c));
        const double weight = norm(tri_.normal(tri_.triangle(t))) / std::pow(sizes_.at(centre), 2);
        sum = sum + weight * centre;
        weights += weight;
      }
      if (!(weights > 0)) continue;
      const Vec3 x = curved_.place((1 / weights) * sum);
      const bool turns = std::any_of(tri_.star(i).begin(), tri_.star(i).end(), [&](int t) {
        const Vec3 before = tri_.normal(tri_.triangle(t)), after = tri_.normal_with(t, i, x);
        return !(dot(before, after) > cos_sharp * norm(before) * norm(after));
      });
      if (!turns) tri_.move(i, x);
    }
  }

  CurvedSurface curved_;
  TriComplex tri_;
  const SizeField& sizes_;
  const AdaptWhere& where_;
  Vec3 origin_;  ///< near, so that digits are not lost
  std::vector<bool> sharp_;
};

}  // namespace

Surface adapt_surface(const Surface& surface, const SizeField& sizes, const AdaptWhere& where) {
  Adaptation adaptation(surface, sizes, where);
  for (int i = 0; i < rounds; ++i) adaptation.round();
  adaptation.restore_volume(enclosed_volume(surface));
  return adaptation.result(surface.region_names);
}

}  // namespace palpate
