// Quality is the smallest dihedral sine (quality.hpp).
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/mesh/tet_complex.hpp>

#include <algorithm>

#include <pipeline/mesh/quality.hpp>

namespace palpate {

TetComplex::TetComplex(const TetMesh& mesh)
    : points_(mesh.points), tets_(mesh.tets), region_(mesh.tet_region), alive_(mesh.tets.size(), true), star_(mesh.points.size()) {
  for (int t = 0; t < tets_.size(); ++t) {
    quality_.push_back(quality_of(tets_[t]));
    for (int i : tets_[t]) star_[i].push_back(t);
  }
}

double TetComplex::quality_of(const Tet& t) const { return smallest_dihedral_sine({points_[t[0]], points_[t[1]], points_[t[2]], points_[t[3]]}); }

double TetComplex::worst_of(const std::vector<int>& tets) const {
  double worst = 1;
  for (int t : tets) worst = std::min(worst, quality_[t]);
  return worst;
}

double TetComplex::worst_of(const std::vector<Tet>& tets) const {
  double worst = 1;
  for (const Tet& t : tets) worst = std::min(worst, quality_of(t));
  return worst;
}

double TetComplex::worst_with(int node, const Vec3& x, double floor) const {
  double worst = 1;
  for (int t : star_[node]) {
    Corners corners;
    for (int k = 0; k < 4; ++k) corners[k] = tets_[t][k] == node ? x : points_[tets_[t][k]];
    worst = std::min(worst, smallest_dihedral_sine(corners));
    if (worst <= floor) break;
  }
  return worst;
}

void TetComplex::move(int node, const Vec3& x) {
  points_[node] = x;
  for (int t : star_[node]) quality_[t] = quality_of(tets_[t]);
}

int TetComplex::add_point(const Vec3& x) {
  points_.push_back(x);
  star_.emplace_back();
  return static_cast<int>(points_.size()) - 1;
}

void TetComplex::replace(const std::vector<int>& old, const std::vector<Tet>& fresh) {
  const int region = region_[old.front()];
  for (int t : old) {
    alive_[t] = false;
    for (int i : tets_[t]) std::erase(star_[i], t);
  }
  for (const Tet& tet : fresh) {
    const int t = static_cast<int>(tets_.size());
    tets_.push_back(tet);
    region_.push_back(region);
    alive_.push_back(true);
    quality_.push_back(quality_of(tet));
    for (int i : tet) star_[i].push_back(t);
  }
}

std::vector<int> TetComplex::around_edge(int a, int b) const {
  std::vector<int> both;
  std::set_intersection(star_[a].begin(), star_[a].end(), star_[b].begin(), star_[b].end(), std::back_inserter(both));
  return both;
}

std::vector<int> TetComplex::ring(int a, int b, const std::vector<int>& around) const {
  std::vector<std::array<int, 2>> steps;
  for (int t : around) {
    if (region_[t] != region_[around.front()]) return {};
    steps.push_back(opposite_edge(tets_[t], a, b));
  }
  std::vector<int> nodes = {steps.front()[0]};
  for (int next = steps.front()[1]; next != nodes.front();) {
    nodes.push_back(next);
    const auto step = std::find_if(steps.begin(), steps.end(), [&](const auto& s) { return s[0] == next; });
    if (step == steps.end() || nodes.size() > steps.size()) return {};
    next = (*step)[1];
  }
  return nodes.size() == steps.size() ? nodes : std::vector<int>{};
}

int TetComplex::neighbour(int tet, int corner) const {
  const Tet face = with_apex(tets_[tet], corner);
  for (int t : star_[face[1]])
    if (t != tet && std::count(tets_[t].begin(), tets_[t].end(), face[2]) && std::count(tets_[t].begin(), tets_[t].end(), face[3])) return t;
  return -1;
}

void TetComplex::write_to(TetMesh& mesh) const {
  std::vector<int> index(points_.size(), -1);
  mesh.points.clear();
  for (int i = 0; i < points_.size(); ++i) {
    if (star_[i].empty()) continue;
    index[i] = static_cast<int>(mesh.points.size());
    mesh.points.push_back(points_[i]);
  }
  mesh.tets.clear();
  mesh.tet_region.clear();
  for (int t = 0; t < tets_.size(); ++t) {
    if (!alive_[t]) continue;
    mesh.tets.push_back({index[tets_[t][0]], index[tets_[t][1]], index[tets_[t][2]], index[tets_[t][3]]});
    mesh.tet_region.push_back(region_[t]);
  }
}

std::array<int, 2> opposite_edge(const Tet& tet, int a, int b) {
  static constexpr int even[12][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1},
                                      {1, 0, 3, 2}, {2, 0, 1, 3}, {3, 0, 2, 1}, {2, 1, 3, 0}, {3, 1, 0, 2}, {3, 2, 1, 0}};
  for (const auto& p : even)
    if (tet[p[0]] == a && tet[p[1]] == b) return {tet[p[2]], tet[p[3]]};
  return {-1, -1};
}

Tet with_apex(const Tet& tet, int corner) {
  static constexpr int even[4][4] = {{0, 1, 2, 3}, {1, 0, 3, 2}, {2, 0, 1, 3}, {3, 0, 2, 1}};
  const auto& p = even[corner];
  return {tet[p[0]], tet[p[1]], tet[p[2]], tet[p[3]]};
}

}  // namespace palpate
