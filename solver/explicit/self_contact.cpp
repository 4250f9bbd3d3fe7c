// Grid search, the nearest point of a triangle, forces shared by its corners.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/explicit/self_contact.hpp>

#include <algorithm>
#include <array>
#include <string>

#include <palpate/errors.hpp>
#include <solver/explicit/block_triangle.hpp>

namespace palpate::explicit_shell {
namespace {

constexpr double nearly_all = 0.95;  ///< of the contact distance: mid-surfaces meet

Lanes at(const std::vector<Lanes>& x, const std::array<int, 3>& t, const std::array<double, 3>& w) {
  return w[0] * x[t[0]] + w[1] * x[t[1]] + w[2] * x[t[2]];
}

/// Cells of a cube's side over a box, with what lies in them.
struct Grid {
  Lanes low{};
  double cell = 1;
  std::array<int, 3> size{1, 1, 1};
  std::vector<int> start, members;

  int along(double v, int axis) const { return std::clamp(static_cast<int>((v - low[axis]) / cell), 0, size[axis] - 1); }
  int number(int i, int j, int k) const { return (k * size[1] + j) * size[0] + i; }

  template <class Visit>
  void visit(const Lanes& from, const Lanes& to, const Visit& f) const {
    for (int k = along(from[2], 2); k <= along(to[2], 2); ++k)
      for (int j = along(from[1], 1); j <= along(to[1], 1); ++j)
        for (int i = along(from[0], 0); i <= along(to[0], 0); ++i) f(number(i, j, k));
  }
};

Grid grid_of(const std::vector<Lanes>& points, double cell) {
  Grid g;
  Lanes high = g.low = points.front();
  for (const Lanes& p : points)
    for (int c = 0; c < 3; ++c) g.low[c] = std::min(g.low[c], p[c]), high[c] = std::max(high[c], p[c]);
  g.cell = cell;
  if (!(length3(high - g.low) < 1e3 * cell))
    throw Failure(ExitCode::not_converged, "the wall flies apart: it reaches over " + std::to_string(length3(high - g.low)) + " mm", "", "a smaller [steps] safety or speed_mm_s, a larger gap_mm, or a finer mesh");
  for (int c = 0; c < 3; ++c) g.size[c] = std::max(1, static_cast<int>((high[c] - g.low[c]) / cell) + 1);
  g.start.assign(static_cast<std::size_t>(g.size[0]) * g.size[1] * g.size[2] + 1, 0);
  std::vector<int> cells;
  for (const Lanes& p : points) {
    cells.push_back(g.number(g.along(p[0], 0), g.along(p[1], 1), g.along(p[2], 2)));
    ++g.start[cells.back() + 1];
  }
  for (std::size_t i = 1; i < g.start.size(); ++i) g.start[i] += g.start[i - 1];
  g.members.resize(points.size());
  std::vector<int> next(g.start.begin(), g.start.end() - 1);
  for (int i = 0; i < points.size(); ++i) g.members[next[cells[i]]++] = i;
  return g;
}

void box_of(const std::vector<Lanes>& x, const std::array<int, 3>& t, double margin, Lanes& low, Lanes& high) {
  low = high = x[t[0]];
  for (int i : t)
    for (int c = 0; c < 3; ++c) low[c] = std::min(low[c], x[i][c]), high[c] = std::max(high[c], x[i][c]);
  low -= margin, high += margin;
}

bool has(const std::array<int, 3>& t, int i) { return t[0] == i || t[1] == i || t[2] == i; }

/// Does the edge p–q pass through the triangle?
bool pierces(const Lanes& p, const Lanes& q, const Lanes& a, const Lanes& b, const Lanes& c) {
  const Lanes n = cross3(b - a, c - a);
  const double hp = dot3(p - a, n), hq = dot3(q - a, n);
  if ((hp > 0) == (hq > 0)) return false;
  const Lanes x = p + hp / (hp - hq) * (q - p);
  return dot3(cross3(b - a, x - a), n) >= 0 && dot3(cross3(c - b, x - b), n) >= 0 && dot3(cross3(a - c, x - c), n) >= 0;
}

}  // namespace

SelfContact::SelfContact(const Wall& wall, int threads) : wall_(wall), found_(threads), pushes_(threads) {
  node_area_ = node_areas(wall);
  for (double t : wall.thickness) reach_ = std::max(reach_, t);
  skin_ = reach_ / 2;
}

bool SelfContact::is_out_of_date(const WallState& state, double strayed) const {
  if (searched_at_.empty()) return true;
  if (strayed < 0) strayed = farthest(state.x, searched_at_, 0, static_cast<int>(state.x.size()));
  return strayed > skin_ * skin_ / 4;
}

void SelfContact::search(const Motion& motion) {
  search(motion.state, [&](const auto& work) { motion.shared(work); });
}

void SelfContact::search(const WallState& state, const std::function<void(const std::function<void(const Motion::Share&)>&)>& share_out) {
  ++searches_;
  searched_at_ = state.x;
  const double margin = reach_ + skin_;
  const Grid grid = grid_of(state.x, std::max(2 * margin, 1e-6));
  share_out([&](const Motion::Share& share) {
    auto& found = found_[share.thread];
    found.clear();
    for (int t = share.triangle; t < share.last_triangle; ++t) {
      const auto& corners = wall_.triangles[t];
      Lanes low, high;
      box_of(state.x, corners, margin, low, high);
      grid.visit(low, high, [&](int cell) {
        for (int m = grid.start[cell]; m < grid.start[cell + 1]; ++m) {
          const int i = grid.members[m];
          const Lanes& p = state.x[i];
          if (p[0] < low[0] || p[1] < low[1] || p[2] < low[2] || p[0] > high[0] || p[1] > high[1] || p[2] > high[2]) continue;
          if (has(corners, i)) continue;
          // what is this near at rest is the wall's own neighbourhood: its bending keeps it apart
          const Lanes& r = wall_.rest[i];
          const auto w0 = nearest(r, wall_.rest[corners[0]], wall_.rest[corners[1]], wall_.rest[corners[2]]);
          if (length3(r - at(wall_.rest, corners, w0)) < 1.5 * reach_) continue;
          const auto w = nearest(p, state.x[corners[0]], state.x[corners[1]], state.x[corners[2]]);
          if (length3(p - at(state.x, corners, w)) < margin) found.push_back({i, t});
        }
      });
    }
  });
  pairs_.clear();
  for (const auto& found : found_) pairs_.insert(pairs_.end(), found.begin(), found.end());
  std::stable_sort(pairs_.begin(), pairs_.end(), [](const Pair& a, const Pair& b) { return a.node < b.node; });
}

void SelfContact::touch(const WallState& state, const Penalty& penalty, FewForces& force) {
  const Motion::Share all{0, 0, static_cast<int>(wall_.rest.size()), 0, static_cast<int>(wall_.triangles.size())};
  if (is_out_of_date(state, -1)) search(state, [&](const auto& work) { work(all); });
  touch_nodes(all, state, penalty);
  gather(force);
}

void SelfContact::touch_nodes(const Motion::Share& share, const WallState& state, const Penalty& penalty) {
  auto& pushes = pushes_[share.thread];
  pushes.clear();
  auto pair = std::lower_bound(pairs_.begin(), pairs_.end(), share.node, [](const Pair& p, int node) { return p.node < node; });
  while (pair != pairs_.end() && pair->node < share.last_node) {
    Near near{};
    for (const int node = pair->node; pair != pairs_.end() && pair->node == node; ++pair) consider(state, *pair, near);
    if (near.depth > 0) pushes.push_back({near, force_of(state, near, penalty)});
  }
}

/// In the order of nodes, however many threads found them.
void SelfContact::gather(FewForces& force) {
  active_ = 0, area_ = 0, through_ = -1;
  for (const auto& pushes : pushes_)
    for (const auto& [near, f] : pushes) {
      const auto& t = wall_.triangles[near.pair.triangle];
      const int node = near.pair.node;
      force.add(node, f);
      for (int k = 0; k < 3; ++k) force.add(t[k], -near.weights[k] * f);
      if (near.depth > nearly_all * near.wanted) through_ = node;
      ++active_;
      area_ += node_area_[node];
      deepest_ = std::max(deepest_, near.depth);
    }
}

/// Of the triangles about a node the one it is deepest in: one force per node, however fine the mesh is against the wall.
void SelfContact::consider(const WallState& state, const Pair& pair, Near& near) const {
  const auto& t = wall_.triangles[pair.triangle];
  const Lanes& p = state.x[pair.node];
  const auto w = nearest(p, state.x[t[0]], state.x[t[1]], state.x[t[2]]);
  const Lanes apart = p - at(state.x, t, w);
  const double distance = length3(apart);
  const double wanted = (wall_.thickness[pair.node] + w[0] * wall_.thickness[t[0]] + w[1] * wall_.thickness[t[1]] + w[2] * wall_.thickness[t[2]]) / 2;
  if (distance > 0 && wanted - distance > near.depth) near = {pair, w, apart / distance, wanted - distance, wanted};
}

Lanes SelfContact::force_of(const WallState& state, const Near& near, const Penalty& penalty) const {
  const auto& t = wall_.triangles[near.pair.triangle];
  const int node = near.pair.node;
  double softness = 1 / wall_.mass[node];
  for (int k = 0; k < 3; ++k) softness += near.weights[k] * near.weights[k] / wall_.mass[t[k]];
  const Lanes v = state.v[node] - at(state.v, t, near.weights);
  const double normal = std::max(penalty.stiffness * near.depth - 2 * penalty.damping * std::sqrt(penalty.stiffness) * dot3(v, near.normal), 0.0) / softness;
  Lanes f = normal * near.normal;
  if (penalty.friction > 0) {
    const Lanes slip = v - dot3(v, near.normal) * near.normal;
    f -= penalty.friction * normal / std::max(length3(slip), 1.0) * slip;
  }
  return f;
}

int crossings(const Wall& wall, const std::vector<Lanes>& x) {
  double longest = 0;
  for (const auto& [a, b] : wall.edges) longest = std::max(longest, length3(x[b] - x[a]));
  std::vector<Lanes> centres;
  for (const auto& t : wall.triangles) centres.push_back((x[t[0]] + x[t[1]] + x[t[2]]) / 3.0);
  const Grid grid = grid_of(centres, longest);
  int count = 0;
  for (int t = 0; t < wall.triangles.size(); ++t) {
    Lanes low, high;
    box_of(x, wall.triangles[t], longest, low, high);
    grid.visit(low, high, [&](int cell) {
      for (int m = grid.start[cell]; m < grid.start[cell + 1]; ++m) {
        const int s = grid.members[m];
        const auto &A = wall.triangles[t], &B = wall.triangles[s];
        if (s <= t || has(A, B[0]) || has(A, B[1]) || has(A, B[2])) continue;
        bool crossed = false;
        for (int k = 0; k < 3 && !crossed; ++k)
          crossed = pierces(x[A[k]], x[A[(k + 1) % 3]], x[B[0]], x[B[1]], x[B[2]]) || pierces(x[B[k]], x[B[(k + 1) % 3]], x[A[0]], x[A[1]], x[A[2]]);
        count += crossed;
      }
    });
  }
  return count;
}

}  // namespace palpate::explicit_shell
