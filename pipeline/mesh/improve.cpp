// The worst first, pass after pass; edge removal finds the best triangulation of the ring by Klincsek's recurrence (1980).
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/mesh/improve.hpp>

#include <algorithm>
#include <limits>
#include <numbers>

#include <pipeline/mesh/tet_complex.hpp>

namespace palpate {
namespace {

constexpr double gain = 1e-4;        ///< of the dihedral sine: what a change must bring
constexpr std::size_t longest_ring = 9;

struct Work {
  TetComplex& complex;
  int first_inner;
  const SurfaceIndex& surface;
  ImproveLog log;

  bool is_inner(int node) const { return node >= first_inner; }
};

double mean_edge_at(const TetComplex& complex, int node) {
  double sum = 0;
  for (int t : complex.star(node))
    for (int i : complex.tet(t)) sum += norm(complex.points()[i] - complex.points()[node]);
  return sum / (3.0 * complex.star(node).size());
}

/// Pattern search along 13 lines with a shrinking step for the place of `node` with the best worst tetrahedron; `allowed` maps a trial
/// to the place it may take.
template <class Allowed>
bool search_better_place(TetComplex& complex, int node, Allowed allowed) {
  const double before = complex.worst_of(complex.star(node));
  double best = before, step = 0.25 * mean_edge_at(complex, node);
  Vec3 place = complex.points()[node];
  for (int round = 0; round < 12; ++round) {
    const Vec3 centre = place;
    bool better = false;
    for (int code = 0; code < 27; ++code) {
      if (code == 13) continue;
      const Vec3 direction = {code % 3 - 1.0, code / 3 % 3 - 1.0, code / 9 - 1.0};
      const Vec3 trial = allowed(centre + (step / norm(direction)) * direction);
      const double worst = complex.worst_with(node, trial, best);
      if (worst > best) {
        best = worst;
        place = trial;
        better = true;
      }
    }
    if (!better) step *= 0.5;
  }
  if (!(best > before + gain)) return false;
  complex.move(node, place);
  return true;
}

bool smooth_inner(Work& w, int tet) {
  const Tet corners = w.complex.tet(tet);
  for (int node : corners)
    if (w.is_inner(node) && search_better_place(w.complex, node, [](const Vec3& x) { return x; })) return ++w.log.moved, true;
  return false;
}

/// Triangles (indices into the ring) that maximise the worst of the two tetrahedra each makes with a and b.
struct RingTriangulation {
  double worst = -1;
  std::vector<Tet> tets;
};

RingTriangulation best_triangulation(const TetComplex& complex, int a, int b, const std::vector<int>& ring, double floor) {
  const int n = static_cast<int>(ring.size());
  std::vector<std::vector<double>> best(n, std::vector<double>(n, std::numeric_limits<double>::infinity()));
  std::vector<std::vector<int>> choice(n, std::vector<int>(n, -1));
  for (int span = 2; span < n; ++span)
    for (int i = 0; i + span < n; ++i) {
      const int j = i + span;
      best[i][j] = -1;
      for (int k = i + 1; k < j; ++k) {
        double worst = std::min(best[i][k], best[k][j]);
        if (worst <= std::max(floor, best[i][j])) continue;
        worst = std::min({worst, complex.quality_of({a, ring[i], ring[k], ring[j]}), complex.quality_of({ring[i], ring[k], ring[j], b})});
        if (worst <= best[i][j]) continue;
        best[i][j] = worst;
        choice[i][j] = k;
      }
    }
  RingTriangulation result{best[0][n - 1], {}};
  std::vector<std::pair<int, int>> open = {{0, n - 1}};
  while (!open.empty() && result.worst > floor) {
    const auto [i, j] = open.back();
    open.pop_back();
    if (j - i < 2) continue;
    const int k = choice[i][j];
    result.tets.push_back({a, ring[i], ring[k], ring[j]});
    result.tets.push_back({ring[i], ring[k], ring[j], b});
    open.push_back({i, k});
    open.push_back({k, j});
  }
  return result;
}

bool remove_edge(Work& w, int tet) {
  const Tet corners = w.complex.tet(tet);
  for (int i = 0; i < 4; ++i)
    for (int j = i + 1; j < 4; ++j) {
      const auto around = w.complex.around_edge(corners[i], corners[j]);
      const auto ring = w.complex.ring(corners[i], corners[j], around);
      if (ring.size() < 3 || ring.size() > longest_ring) continue;
      const double before = w.complex.worst_of(around);
      const auto better = best_triangulation(w.complex, corners[i], corners[j], ring, before + gain);
      if (!(better.worst > before + gain)) continue;
      w.complex.replace(around, better.tets);
      return ++w.log.edges_removed, true;
    }
  return false;
}

/// 2 → 3: the face between two tetrahedra gives way to the edge between their apexes.
bool swap_face(Work& w, int tet) {
  for (int corner = 0; corner < 4; ++corner) {
    const int other = w.complex.neighbour(tet, corner);
    if (other < 0 || w.complex.region(other) != w.complex.region(tet)) continue;
    const auto [a, p, q, r] = with_apex(w.complex.tet(tet), corner);
    int b = -1;
    for (int node : w.complex.tet(other))
      if (node != p && node != q && node != r) b = node;
    const std::vector<Tet> fresh = {{a, b, p, q}, {a, b, q, r}, {a, b, r, p}};
    const std::vector<int> old = {tet, other};
    if (!(w.complex.worst_of(fresh) > w.complex.worst_of(old) + gain)) continue;
    w.complex.replace(old, fresh);
    return ++w.log.faces_swapped, true;
  }
  return false;
}

/// An inner node is drawn onto a neighbour.
bool contract(Work& w, int tet) {
  const Tet corners = w.complex.tet(tet);
  for (int from : corners)
    for (int to : corners) {
      if (from == to || !w.is_inner(from)) continue;
      const std::vector<int> old = w.complex.star(from);
      std::vector<Tet> fresh;
      for (int t : old) {
        Tet changed = w.complex.tet(t);
        if (std::count(changed.begin(), changed.end(), to)) continue;
        std::replace(changed.begin(), changed.end(), from, to);
        fresh.push_back(changed);
      }
      if (!(w.complex.worst_of(fresh) > w.complex.worst_of(old) + gain)) continue;
      w.complex.replace(old, fresh);
      return ++w.log.contracted, true;
    }
  return false;
}

/// A new node in the middle of an inner edge, then moved to its best place; taken back when that does not help.
bool split_edge(Work& w, int tet) {
  const Tet corners = w.complex.tet(tet);
  for (int i = 0; i < 4; ++i)
    for (int j = i + 1; j < 4; ++j) {
      const int a = corners[i], b = corners[j];
      const auto around = w.complex.around_edge(a, b);
      if (w.complex.ring(a, b, around).empty()) continue;
      const double before = w.complex.worst_of(around);
      std::vector<Tet> old, fresh;
      const int middle = w.complex.add_point(0.5 * (w.complex.points()[a] + w.complex.points()[b]));
      for (int t : around) {
        old.push_back(w.complex.tet(t));
        for (int end : {a, b}) {
          Tet half = w.complex.tet(t);
          std::replace(half.begin(), half.end(), end, middle);
          fresh.push_back(half);
        }
      }
      w.complex.replace(around, fresh);
      search_better_place(w.complex, middle, [](const Vec3& x) { return x; });
      const std::vector<int> made = w.complex.star(middle);
      if (w.complex.worst_of(made) > before + gain) return ++w.log.split, true;
      w.complex.replace(made, old);
    }
  return false;
}

/// Nodes of the surface slide along it.
bool slide_on_surface(Work& w, int tet) {
  const Tet corners = w.complex.tet(tet);
  for (int node : corners)
    if (!w.is_inner(node) && search_better_place(w.complex, node, [&](const Vec3& x) { return w.surface.nearest(x).point; }))
      return ++w.log.moved_on_surface, true;
  return false;
}

/// Living tetrahedra below the target, worst first.
std::vector<int> worst_tets(const TetComplex& complex, double target) {
  std::vector<int> list;
  for (int t = 0; t < complex.size(); ++t)
    if (complex.alive(t) && complex.quality(t) < target) list.push_back(t);
  std::stable_sort(list.begin(), list.end(), [&](int a, int b) { return complex.quality(a) < complex.quality(b); });
  return list;
}

}  // namespace

Json to_json(const ImproveLog& log) {
  return {{"nodes_moved", log.moved}, {"edges_removed", log.edges_removed}, {"faces_swapped", log.faces_swapped},
          {"nodes_contracted", log.contracted}, {"edges_split", log.split}, {"nodes_slid_on_surface", log.moved_on_surface}};
}

ImproveLog improve(TetMesh& mesh, int first_inner, const SurfaceIndex& surface, const ImproveSettings& settings) {
  TetComplex complex(mesh);
  Work work{complex, first_inner, surface, {}};
  const double target = std::sin(settings.target_deg * std::numbers::pi / 180);
  for (int pass = 0; pass < settings.passes; ++pass) {
    bool any = false;
    for (int tet : worst_tets(complex, target)) {
      if (!complex.alive(tet) || complex.quality(tet) >= target) continue;
      any |= smooth_inner(work, tet) || remove_edge(work, tet) || swap_face(work, tet) || contract(work, tet) || split_edge(work, tet) ||
             slide_on_surface(work, tet);
    }
    if (!any) break;
  }
  complex.write_to(mesh);
  return work.log;
}

}  // namespace palpate
