// Edges, masses and packs of a wall.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/explicit/wall.hpp>

#include <algorithm>
#include <map>
#include <sstream>

#include <palpate/errors.hpp>

namespace palpate::explicit_shell {
namespace {

std::string place(const Wall& w, int t) {
  std::ostringstream out;
  const Lanes c = (w.rest[w.triangles[t][0]] + w.rest[w.triangles[t][1]] + w.rest[w.triangles[t][2]]) / 3.0;
  out << "triangle " << t << " at (" << c[0] << ", " << c[1] << ", " << c[2] << ") mm";
  return out.str();
}

void find_edges(Wall& w) {
  std::map<std::array<int, 2>, std::pair<int, int>> found;  // edge → number, sum of directions
  for (int t = 0; t < w.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const int a = w.triangles[t][(k + 1) % 3], b = w.triangles[t][(k + 2) % 3];
      const auto [entry, fresh] = found.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<int>(w.edges.size()), 0);
      if (fresh) w.edges.push_back(entry->first);
      auto& [number, direction] = entry->second;
      if (!fresh && direction != (a < b ? -1 : 1))
        throw Failure(ExitCode::unreadable, "more than two triangles at an edge, or neighbours that face opposite ways", place(w, t), "mesh it again");
      direction = fresh ? (a < b ? 1 : -1) : 0;
      w.triangle_edges[t][k] = number;
    }
}

/// In the plane of the triangle: x along its first edge.
elements::ShellRest<double> rest_of(const Wall& w, int t, const std::vector<Lanes>& directors) {
  const auto& [i, j, k] = w.triangles[t];
  const Lanes u = w.rest[j] - w.rest[i], v = w.rest[k] - w.rest[i], n = cross3(u, v);
  const double twice = length3(n), lu = length3(u);
  if (!(twice > 1e-12 * lu * lu)) throw Failure(ExitCode::unreadable, "a triangle without area", place(w, t), "mesh it again");
  const Lanes ex = u / lu, ey = cross3(n / twice, ex);
  const double x1 = lu, x2 = dot3(v, ex), y2 = dot3(v, ey);
  elements::ShellRest<double> r{};
  r.g1x = 1 / x1, r.g1y = -x2 / (x1 * y2), r.g2x = 0, r.g2y = 1 / y2;
  r.area = twice / 2;
  r.thickness = (w.thickness[i] + w.thickness[j] + w.thickness[k]) / 3;
  const double px[3] = {0, x1, x2}, py[3] = {0, 0, y2};
  elements::ShellNow<double> at_rest;
  for (int c = 0; c < 3; ++c) {
    const int a = (c + 1) % 3, b = (c + 2) % 3;
    const double dx = px[b] - px[a], dy = py[b] - py[a];
    r.length[c] = std::hypot(dx, dy);
    const double mx = dy / r.length[c], my = -dx / r.length[c], s = r.length[c] / r.area;
    r.P[c] = {s * mx * mx, s * my * my, s * mx * my};
    r.sign[c] = w.triangles[t][a] < w.triangles[t][b] ? 1 : -1;
    const Lanes &x = w.rest[w.triangles[t][c]], &d = directors[w.triangle_edges[t][c]];
    at_rest.x[c] = {x[0], x[1], x[2]};
    at_rest.director[c] = {d[0], d[1], d[2]};
  }
  r.b0 = {0, 0, 0};
  const auto curved = elements::shell_strain(r, at_rest).K;  // 2 h where b0 is not yet known
  r.b0 = {curved.xx / 2, curved.yy / 2, curved.xy / 2};
  return r;
}

void set_lane(elements::ShellRest<Lanes>& to, int l, const elements::ShellRest<double>& from) {
  to.g1x[l] = from.g1x, to.g1y[l] = from.g1y, to.g2x[l] = from.g2x, to.g2y[l] = from.g2y;
  to.area[l] = from.area, to.thickness[l] = from.thickness;
  to.b0.xx[l] = from.b0.xx, to.b0.yy[l] = from.b0.yy, to.b0.xy[l] = from.b0.xy;
  for (int k = 0; k < 3; ++k) {
    to.length[k][l] = from.length[k], to.sign[k][l] = from.sign[k];
    to.P[k].xx[l] = from.P[k].xx, to.P[k].yy[l] = from.P[k].yy, to.P[k].xy[l] = from.P[k].xy;
  }
}

Rows rows_of(std::size_t count, const std::vector<std::array<int, 3>>& triangles) {
  Rows rows;
  rows.start.assign(count + 1, 0);
  for (const auto& t : triangles)
    for (int i : t) ++rows.start[i + 1];
  for (std::size_t i = 0; i < count; ++i) rows.start[i + 1] += rows.start[i];
  rows.entries.resize(rows.start.back());
  std::vector<int> next(rows.start.begin(), rows.start.end() - 1);
  for (int t = 0; t < triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) rows.entries[next[triangles[t][k]]++] = 3 * t + k;
  return rows;
}

void add_directors(Wall& w) {
  w.directors.assign(w.edges.size(), Lanes{});
  for (int t = 0; t < w.triangles.size(); ++t) {
    const auto& [i, j, k] = w.triangles[t];
    const Lanes n = cross3(w.rest[j] - w.rest[i], w.rest[k] - w.rest[i]);
    for (int e : w.triangle_edges[t]) w.directors[e] += n / length3(n);
  }
  for (Lanes& d : w.directors) d /= length3(d);
}

}  // namespace

Wall make_wall(const ShellMesh& mesh, const ShellLaw& law, double density) {
  Wall w;
  w.law = law;
  w.density = density;
  for (const Vec3& p : mesh.points) w.rest.push_back(lanes(p));
  w.triangles = mesh.triangles;
  w.triangle_edges.resize(w.triangles.size());
  w.thickness = mesh.thickness_mm;
  find_edges(w);
  add_directors(w);
  w.mass.assign(w.rest.size(), 0);
  w.mass_factor.assign(w.triangles.size(), 1);
  w.inertia.assign(w.edges.size(), 0);
  const int count = static_cast<int>(w.triangles.size());
  for (int e = 0; e < count; e += 4) {
    w.packs.emplace_back();
    for (int l = 0; l < 4; ++l) {
      const int t = std::min(e + l, count - 1);  // the last pack repeats the last triangle; nobody gathers the copies
      const auto rest = rest_of(w, t, w.directors);
      set_lane(w.packs.back().rest, l, rest);
      for (int k = 0; k < 3; ++k) w.packs.back().node[k][l] = w.triangles[t][k], w.packs.back().edge[k][l] = w.triangle_edges[t][k];
      if (t != e + l) continue;
      const double third = density * rest.thickness * rest.area / 3;
      for (int k = 0; k < 3; ++k) {
        w.mass[w.triangles[t][k]] += third;
        w.inertia[w.triangle_edges[t][k]] += third * std::max(rest.thickness * rest.thickness / 12, rest.area / 8);
      }
    }
  }
  w.node_slots = rows_of(w.rest.size(), w.triangles);
  w.edge_slots = rows_of(w.edges.size(), w.triangle_edges);
  return w;
}

WallState rest_state(const Wall& wall) {
  const std::size_t nodes = wall.rest.size(), edges = wall.edges.size();
  return {wall.rest, std::vector<Lanes>(nodes, Lanes{}), wall.directors, std::vector<double>(edges, 0)};
}

std::vector<double> node_areas(const Wall& wall) {
  std::vector<double> area(wall.rest.size(), 0);
  for (int t = 0; t < wall.triangles.size(); ++t)
    for (int i : wall.triangles[t]) area[i] += wall.packs[t / 4].rest.area[t % 4] / 3;
  return area;
}

elements::ShellRest<double> lane(const elements::ShellRest<Lanes>& from, int l) {
  elements::ShellRest<double> r{};
  r.g1x = from.g1x[l], r.g1y = from.g1y[l], r.g2x = from.g2x[l], r.g2y = from.g2y[l];
  r.area = from.area[l], r.thickness = from.thickness[l];
  r.b0 = {from.b0.xx[l], from.b0.yy[l], from.b0.xy[l]};
  for (int k = 0; k < 3; ++k) {
    r.length[k] = from.length[k][l], r.sign[k] = from.sign[k][l];
    r.P[k] = {from.P[k].xx[l], from.P[k].yy[l], from.P[k].xy[l]};
  }
  return r;
}

elements::ShellNow<double> now(const Wall& wall, const WallState& state, int triangle) {
  elements::ShellNow<double> n;
  for (int k = 0; k < 3; ++k) {
    const Lanes &x = state.x[wall.triangles[triangle][k]], &d = state.director[wall.triangle_edges[triangle][k]];
    n.x[k] = {x[0], x[1], x[2]};
    n.director[k] = {d[0], d[1], d[2]};
  }
  return n;
}

}  // namespace palpate::explicit_shell
