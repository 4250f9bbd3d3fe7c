// Splitting and opening with stars kept up to date.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/mesh/carried_mesh.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

#include <pipeline/mesh/quality.hpp>

namespace palpate {
namespace {

/// Weights of a + t (b − a). Both lie in one tetrahedron of the first mesh, so that at most four nodes are involved.
Origin between(const Origin& a, const Origin& b, double t) {
  std::map<int, double> sum;
  for (int i = 0; i < 4; ++i) {
    if (a.weights[i] != 0) sum[a.nodes[i]] += (1 - t) * a.weights[i];
    if (b.weights[i] != 0) sum[b.nodes[i]] += t * b.weights[i];
  }
  if (sum.size() > 4) throw std::logic_error("an edge does not lie in one tetrahedron of the first mesh");
  Origin origin{{0, 0, 0, 0}, {0, 0, 0, 0}};
  int i = 0;
  for (const auto& [node, weight] : sum) {
    origin.nodes[i] = node;
    origin.weights[i++] = weight;
  }
  return origin;
}

Vec3 between(const Vec3& a, const Vec3& b, double t) { return a + t * (b - a); }

template <std::size_t n>
std::array<int, n> with(std::array<int, n> corners, int old, int fresh) {
  std::replace(corners.begin(), corners.end(), old, fresh);
  return corners;
}

}  // namespace

CarriedMesh::CarriedMesh(const TetMesh& mesh, std::vector<Vec3> rest)
    : region_names_(mesh.region_names), now_(mesh.points), rest_(std::move(rest)), star_(mesh.points.size()), face_star_(mesh.points.size()) {
  for (int i = 0; i < static_cast<int>(now_.size()); ++i) origins_.push_back({{i, 0, 0, 0}, {1, 0, 0, 0}});
  for (int t = 0; t < static_cast<int>(mesh.tets.size()); ++t) {
    parent_.push_back(t);
    region_.push_back(mesh.tet_region[t]);
    tets_.push_back(mesh.tets[t]);
    alive_.push_back(1);
    for (int node : mesh.tets[t]) star_[node].push_back(t);
  }
  faces_ = mesh.faces;
  face_region_ = mesh.face_region;
  for (int f = 0; f < static_cast<int>(faces_.size()); ++f) {
    face_parent_.push_back(f);
    for (int node : faces_[f]) face_star_[node].push_back(f);
  }
}

std::vector<int> CarriedMesh::around(int a, int b) const {
  std::vector<int> both;
  std::set_intersection(star_[a].begin(), star_[a].end(), star_[b].begin(), star_[b].end(), std::back_inserter(both));
  return both;
}

double CarriedMesh::size2(int a, int b) const {
  const Vec3 now = now_[b] - now_[a];
  if (rest_.empty()) return dot(now, now);
  const Vec3 before = rest_[b] - rest_[a];
  return dot(now, now) + dot(before, before);
}

void CarriedMesh::add_tet(const Tet& tet, int like) {
  const int number = static_cast<int>(tets_.size());
  tets_.push_back(tet);
  alive_.push_back(1);
  parent_.push_back(parent_[like]);
  region_.push_back(region_[like]);
  for (int node : tet) star_[node].push_back(number);
}

void CarriedMesh::remove_tet(int tet) {
  alive_[tet] = 0;
  for (int node : tets_[tet]) std::erase(star_[node], tet);
}

int CarriedMesh::split(int a, int b, double t) {
  const auto cut = around(a, b);
  const int node = static_cast<int>(now_.size());
  now_.push_back(between(now_[a], now_[b], t));
  if (!rest_.empty()) rest_.push_back(between(rest_[a], rest_[b], t));
  origins_.push_back(between(origins_[a], origins_[b], t));
  star_.emplace_back();
  face_star_.emplace_back();
  for (int tet : cut) {
    const Tet whole = tets_[tet];
    remove_tet(tet);
    add_tet(with(whole, b, node), tet);
    add_tet(with(whole, a, node), tet);
  }
  std::vector<int> split_faces;
  for (int f : face_star_[a])
    if (std::count(faces_[f].begin(), faces_[f].end(), b)) split_faces.push_back(f);
  std::sort(split_faces.begin(), split_faces.end());
  for (int f : split_faces) {
    const auto whole = faces_[f];
    const int other = static_cast<int>(faces_.size());
    faces_[f] = with(whole, b, node);
    faces_.push_back(with(whole, a, node));
    face_parent_.push_back(face_parent_[f]);
    face_region_.push_back(face_region_[f]);
    std::erase(face_star_[b], f);
    face_star_[node].push_back(f);
    for (int corner : faces_[other]) face_star_[corner].push_back(other);
  }
  return node;
}

bool CarriedMesh::slide(int a, int b, double t, double share) {
  if (!face_star_[a].empty()) return false;
  const auto keeps = [&](const std::vector<Vec3>& places) {
    const Vec3 moved = between(places[a], places[b], t);
    return std::all_of(star_[a].begin(), star_[a].end(), [&](int tet) {
      Corners before, after;
      for (int i = 0; i < 4; ++i) {
        before[i] = places[tets_[tet][i]];
        after[i] = tets_[tet][i] == a ? moved : before[i];
      }
      return jacobian(after) > share * jacobian(before);
    });
  };
  if (!keeps(now_) || (!rest_.empty() && !keeps(rest_))) return false;
  now_[a] = between(now_[a], now_[b], t);
  if (!rest_.empty()) rest_[a] = between(rest_[a], rest_[b], t);
  origins_[a] = between(origins_[a], origins_[b], t);
  return true;
}

CarriedMesh::Result CarriedMesh::result() const {
  Result r;
  r.mesh.points = now_;
  r.mesh.region_names = region_names_;
  r.rest = rest_;
  r.origins = origins_;
  for (std::size_t t = 0; t < tets_.size(); ++t) {
    if (!alive_[t]) continue;
    r.mesh.tets.push_back(tets_[t]);
    r.mesh.tet_region.push_back(region_[t]);
    r.tet_parents.push_back(parent_[t]);
  }
  r.mesh.faces = faces_;
  r.mesh.face_region = face_region_;
  r.face_parents = face_parent_;
  return r;
}

}  // namespace palpate
