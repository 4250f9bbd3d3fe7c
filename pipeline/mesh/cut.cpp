// Crossings of edges with triangles (Möller and Trumbore 1997), then corners of tetrahedra that stay joined, by union and find.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/mesh/cut.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include <palpate/errors.hpp>
#include <pipeline/mesh/nearest_point.hpp>

namespace palpate {
namespace {

using Face = std::array<int, 3>;
using Result = CarriedMesh::Result;

/// A crossing nearer to an end of its edge than this part of it goes through the node there; a node within the body that lies nearer than the
/// second part is moved there, if its tetrahedra keep the third part of their volumes.
constexpr double close_to_node = 0.1, movable = 0.3, kept = 0.3;

/// Outward faces of a tetrahedron, by local numbers.
constexpr int faces_of_tet[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

Face sorted(Face face) {
  std::sort(face.begin(), face.end());
  return face;
}

Face face_of(const TetMesh& mesh, int tet, int f) {
  const auto& t = mesh.tets[tet];
  return {t[faces_of_tet[f][0]], t[faces_of_tet[f][1]], t[faces_of_tet[f][2]]};
}

/// Part of the way from a to b at which a triangle is met; negative: it is not.
double crossing(const Vec3& a, const Vec3& b, const Vec3& p, const Vec3& q, const Vec3& r) {
  constexpr double rim = 1e-9;  // crossings of an edge that two triangles share must not fall between them
  const Vec3 way = b - a, u = q - p, v = r - p, h = cross(way, v);
  const double det = dot(u, h);
  if (det == 0) return -1;
  const Vec3 s = a - p, k = cross(s, u);
  const double x = dot(s, h) / det, y = dot(way, k) / det, t = dot(v, k) / det;
  return x >= -rim && y >= -rim && x + y <= 1 + rim && t >= 0 && t <= 1 ? t : -1;
}

/// The triangles, with boxes to leave most of them out.
class Knife {
 public:
  explicit Knife(const Surface& surface) : surface_(surface), index_(surface) {
    for (const auto& t : surface.triangles) {
      Vec3 low = surface.points[t[0]], high = low;
      for (int i : t)
        for (int k = 0; k < 3; ++k) {
          low[k] = std::min(low[k], surface.points[i][k]);
          high[k] = std::max(high[k], surface.points[i][k]);
        }
      low_.push_back(low);
      high_.push_back(high);
    }
  }
  /// The crossing nearest to the middle of the edge.
  double crossing_of(const Vec3& a, const Vec3& b) const {
    double best = -1;
    for (std::size_t i = 0; i < low_.size(); ++i) {
      bool apart = false;
      for (int k = 0; k < 3; ++k) apart = apart || std::max(a[k], b[k]) < low_[i][k] || std::min(a[k], b[k]) > high_[i][k];
      if (apart) continue;
      const auto& t = surface_.triangles[i];
      const double at = crossing(a, b, surface_.points[t[0]], surface_.points[t[1]], surface_.points[t[2]]);
      if (at >= 0 && (best < 0 || std::abs(at - 0.5) < std::abs(best - 0.5))) best = at;
    }
    return best;
  }
  /// +1 where the normals point, −1 on the other side; by all triangles that hold the nearest point.
  int side_of(const Vec3& x) const {
    const NearestPoint nearest = index_.nearest(x);
    Vec3 normal{};
    for (std::size_t i = 0; i < low_.size(); ++i) {
      bool apart = false;
      for (int k = 0; k < 3; ++k) apart = apart || nearest.point[k] < low_[i][k] - 1e-9 || nearest.point[k] > high_[i][k] + 1e-9;
      if (apart) continue;
      const auto& t = surface_.triangles[i];
      const Vec3 &p = surface_.points[t[0]], &q = surface_.points[t[1]], &r = surface_.points[t[2]];
      if (norm(nearest_on_triangle(nearest.point, p, q, r) - nearest.point) < 1e-9) normal = normal + unit(cross(q - p, r - p));
    }
    return dot(normal, x - nearest.point) < 0 ? -1 : 1;
  }

 private:
  const Surface& surface_;
  SurfaceIndex index_;
  std::vector<Vec3> low_, high_;
};

/// Splits what is crossed; returns the nodes that lie on the cut.
std::set<int> split_crossed(CarriedMesh& mesh, const Knife& knife) {
  std::map<std::array<int, 2>, double> crossed;
  for (int t = 0; t < static_cast<int>(mesh.tets()); ++t)
    for (int i = 0; i < 4 && mesh.alive(t); ++i)
      for (int j = 0; j < 4; ++j) {
        const std::array<int, 2> edge = {mesh.tet(t)[i], mesh.tet(t)[j]};
        if (edge[0] >= edge[1] || crossed.contains(edge)) continue;
        crossed[edge] = knife.crossing_of(mesh.points()[edge[0]], mesh.points()[edge[1]]);
      }
  struct Way {
    double part;
    int towards;
  };
  std::map<int, Way> near;  // the shortest way of a node to the surface
  for (const auto& [edge, at] : crossed) {
    const bool first = at < 0.5;
    const double part = first ? at : 1 - at;
    if (!(at >= 0 && part < movable)) continue;
    const auto [known, is_new] = near.try_emplace(edge[first ? 0 : 1], Way{part, edge[first ? 1 : 0]});
    if (!is_new && part < known->second.part) known->second = {part, edge[first ? 1 : 0]};
  }
  std::set<int> on_cut;
  for (const auto& [node, way] : near)
    if (!on_cut.contains(way.towards) && (mesh.slide(node, way.towards, way.part, kept) || way.part < close_to_node)) on_cut.insert(node);
  for (const auto& [edge, at] : crossed)
    if (at >= 0 && !on_cut.contains(edge[0]) && !on_cut.contains(edge[1])) on_cut.insert(mesh.split(edge[0], edge[1], at));
  return on_cut;
}

/// ±1; 0 for a tetrahedron that reaches around the rim of an open surface, or is away from the cut.
std::vector<int> sides(const TetMesh& mesh, const std::set<int>& on_cut, const Knife& knife) {
  std::map<int, int> of_node;
  const auto side = [&](int node) {
    const auto [at, is_new] = of_node.try_emplace(node, 0);
    if (is_new) at->second = knife.side_of(mesh.points[node]);
    return at->second;
  };
  std::vector<int> sides(mesh.tets.size(), 0);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto& corners = mesh.tets[t];
    const long on = std::count_if(corners.begin(), corners.end(), [&](int node) { return on_cut.contains(node); });
    if (on < 3) continue;
    for (int node : corners)
      if (!on_cut.contains(node)) sides[t] = side(node);
    if (on < 4) continue;
    Vec3 centre{};
    for (int node : corners) centre = centre + 0.25 * mesh.points[node];
    sides[t] = knife.side_of(centre);
  }
  return sides;
}

/// Corners of tetrahedra (4 · tet + corner) that are one node.
struct Joined {
  std::vector<int> to;
  explicit Joined(std::size_t corners) : to(corners) { std::iota(to.begin(), to.end(), 0); }
  int root(int i) {
    while (to[i] != i) i = to[i] = to[to[i]];
    return i;
  }
  void join(int i, int j) {
    i = root(i);
    j = root(j);
    to[std::max(i, j)] = std::min(i, j);
  }
};

int local(const TetMesh& mesh, int tet, int node) {
  return static_cast<int>(std::find(mesh.tets[tet].begin(), mesh.tets[tet].end(), node) - mesh.tets[tet].begin());
}

using TetsOfFaces = std::map<Face, std::vector<int>>;  ///< by sorted corners

TetsOfFaces tets_of_faces(const TetMesh& mesh) {
  TetsOfFaces tets;
  for (int t = 0; t < static_cast<int>(mesh.tets.size()); ++t)
    for (int f = 0; f < 4; ++f) tets[sorted(face_of(mesh, t, f))].push_back(t);
  return tets;
}

/// Lists a face of a tetrahedron, outward, as part of a lip.
void add_lip(Result& result, int tet, const Face& key, int region) {
  for (int f = 0; f < 4; ++f)
    if (sorted(face_of(result.mesh, tet, f)) == key) {
      result.mesh.faces.push_back(face_of(result.mesh, tet, f));
      result.mesh.face_region.push_back(region);
      result.face_parents.push_back(-1);
    }
}

/// At nodes of the cut every group of joined corners gets a node of its own; the first group keeps the old one.
void double_nodes(Result& result, Joined& joined, const std::set<int>& on_cut, const std::vector<int>& tet_of_face) {
  TetMesh& mesh = result.mesh;
  std::map<std::pair<int, int>, int> number;  // of (node, group)
  std::vector<char> taken(mesh.points.size(), 0);
  auto tets = mesh.tets;
  for (int t = 0; t < static_cast<int>(tets.size()); ++t)
    for (int a = 0; a < 4; ++a) {
      const int node = mesh.tets[t][a];
      if (!on_cut.contains(node)) continue;
      const auto [at, is_new] = number.try_emplace({node, joined.root(4 * t + a)}, node);
      if (is_new && taken[node]) {
        at->second = static_cast<int>(mesh.points.size());
        mesh.points.push_back(Vec3(mesh.points[node]));
        result.origins.push_back(Origin(result.origins[node]));
        if (!result.rest.empty()) result.rest.push_back(Vec3(result.rest[node]));
      }
      taken[node] = 1;
      tets[t][a] = at->second;
    }
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    for (int& node : mesh.faces[f]) node = tets[tet_of_face[f]][local(mesh, tet_of_face[f], node)];
  mesh.tets = std::move(tets);
}

}  // namespace

CutReport cut(CarriedMesh mesh, const Surface& surface, Result& result) {
  const Knife knife(surface);
  const auto on_cut = split_crossed(mesh, knife);
  result = mesh.result();
  TetMesh& m = result.mesh;
  const int lips = m.region_names.empty() ? 1000 : std::max(1000, m.region_names.rbegin()->first + 1);
  const auto side = sides(m, on_cut, knife);
  const auto tets_of = tets_of_faces(m);
  CutReport report;
  std::vector<std::pair<Face, std::vector<int>>> parted;
  Joined joined(4 * m.tets.size());
  std::vector<int> tet_of_face;
  for (const auto& face : m.faces) tet_of_face.push_back(tets_of.at(sorted(face)).front());
  for (const auto& [face, tets] : tets_of) {
    if (tets.size() != 2) continue;
    if (side[tets[0]] * side[tets[1]] < 0 && std::all_of(face.begin(), face.end(), [&](int node) { return on_cut.contains(node); }))
      parted.emplace_back(face, tets);
    else
      for (int node : face) joined.join(4 * tets[0] + local(m, tets[0], node), 4 * tets[1] + local(m, tets[1], node));
  }
  for (const auto& [face, tets] : parted) {
    const bool opens = std::any_of(face.begin(), face.end(), [&, &two = tets](int node) {
      return joined.root(4 * two[0] + local(m, two[0], node)) != joined.root(4 * two[1] + local(m, two[1], node));
    });
    if (!opens) continue;  // all of its corners lie on the rim
    for (int t : tets) {
      add_lip(result, t, face, side[t] < 0 ? lips : lips + 1);
      tet_of_face.push_back(t);
    }
    ++report.faces;
    report.area_mm2 += norm(cross(m.points[face[1]] - m.points[face[0]], m.points[face[2]] - m.points[face[0]])) / 2;
  }
  if (report.faces == 0) throw Failure(ExitCode::misuse, "the surface cuts nothing of the mesh", "--cut", "a surface through the mesh, in its place as it is now");
  m.region_names[lips] = "cut_1";
  m.region_names[lips + 1] = "cut_2";
  double_nodes(result, joined, on_cut, tet_of_face);
  report.components = components(m);
  return report;
}

int components(const TetMesh& mesh) {
  Joined joined(mesh.tets.size());
  for (const auto& [face, tets] : tets_of_faces(mesh))
    if (tets.size() == 2) joined.join(tets[0], tets[1]);
  int count = 0;
  for (int t = 0; t < static_cast<int>(mesh.tets.size()); ++t) count += joined.root(t) == t;
  return count;
}

}  // namespace palpate
