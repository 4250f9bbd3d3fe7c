// Marching tetrahedra (Doi and Koide 1991) on a Kuhn-split lattice.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/marching_tetrahedra.hpp>

#include <algorithm>
#include <cstdint>
#include <unordered_map>

#include <pipeline/image/slices_in_parallel.hpp>

namespace palpate {
namespace {

using Node = std::array<int, 3>;

/// The six paths from corner (0,0,0) to (1,1,1): each is a tetrahedron. Corner numbers have bit i set for a step along axis i.
constexpr int tetrahedra[6][4] = {{0, 1, 3, 7}, {0, 1, 5, 7}, {0, 2, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 4, 6, 7}};

struct Lattice {
  Vec3 origin;
  double edge;
  Node size;
  std::vector<float> sign;  ///< of f at the nodes: −1 inside, +1 outside

  std::size_t at(const Node& n) const { return (std::size_t(n[2]) * size[1] + n[1]) * size[0] + n[0]; }
  Vec3 position(const Node& n) const { return origin + edge * Vec3{double(n[0]), double(n[1]), double(n[2])}; }
};

Lattice lattice_over(const Box& box, double edge) {
  Lattice lattice{box.min - Vec3{2 * edge, 2 * edge, 2 * edge}, edge, {}, {}};
  for (int i = 0; i < 3; ++i) lattice.size[i] = static_cast<int>(std::ceil((box.max[i] - box.min[i]) / edge)) + 5;
  return lattice;
}

/// Signs at all nodes. As |∇f| ≤ 1, a value f spares the next |f| / edge nodes of the row.
void fill_signs(Lattice& lattice, const Implicit& f, int threads) {
  lattice.sign.resize(std::size_t(lattice.size[0]) * lattice.size[1] * lattice.size[2]);
  slices_in_parallel(lattice.size[2], threads, [&](int k) {
    for (int j = 0; j < lattice.size[1]; ++j)
      for (int i = 0; i < lattice.size[0];) {
        const double value = f(lattice.position({i, j, k}));
        const int stop = std::min(lattice.size[0], i + 1 + static_cast<int>(std::abs(value) / lattice.edge));
        for (; i < stop; ++i) lattice.sign[lattice.at({i, j, k})] = value < 0 ? -1 : 1;
      }
  });
}

class Contourer {
 public:
  explicit Contourer(const Lattice& lattice) : lattice_(lattice) {}

  void cell(const Node& corner) {
    std::array<Node, 8> nodes;
    std::array<bool, 8> inside;
    int count = 0;
    for (int c = 0; c < 8; ++c) {
      nodes[c] = {corner[0] + (c & 1), corner[1] + (c >> 1 & 1), corner[2] + (c >> 2 & 1)};
      inside[c] = lattice_.sign[lattice_.at(nodes[c])] < 0;
      count += inside[c];
    }
    if (count == 0 || count == 8) return;
    for (const auto& t : tetrahedra) tetrahedron(nodes, inside, t);
  }

  using Edge = std::array<Node, 2>;  ///< from the inner to the outer node

  std::vector<Edge> crossings;  ///< one per vertex
  std::vector<std::array<int, 3>> triangles;

 private:
  void tetrahedron(const std::array<Node, 8>& nodes, const std::array<bool, 8>& inside, const int (&corners)[4]) {
    std::vector<Node> in, out;
    for (int c : corners) (inside[c] ? in : out).push_back(nodes[c]);
    if (in.size() == 1) triangle(in, out, {{{in[0], out[0]}, {in[0], out[1]}, {in[0], out[2]}}});
    if (in.size() == 3) triangle(in, out, {{{in[0], out[0]}, {in[1], out[0]}, {in[2], out[0]}}});
    if (in.size() == 2) {
      triangle(in, out, {{{in[0], out[0]}, {in[0], out[1]}, {in[1], out[1]}}});
      triangle(in, out, {{{in[0], out[0]}, {in[1], out[1]}, {in[1], out[0]}}});
    }
  }

  void triangle(const std::vector<Node>& in, const std::vector<Node>& out, const std::array<Edge, 3>& edges) {
    std::array<int, 3> t;
    std::array<Vec3, 3> middle;
    for (int i = 0; i < 3; ++i) {
      t[i] = vertex(edges[i]);
      middle[i] = 0.5 * (lattice_.position(edges[i][0]) + lattice_.position(edges[i][1]));
    }
    const Vec3 outward = mean(out) - mean(in);
    if (dot(cross(middle[1] - middle[0], middle[2] - middle[0]), outward) < 0) std::swap(t[1], t[2]);
    triangles.push_back(t);
  }

  Vec3 mean(const std::vector<Node>& nodes) const {
    Vec3 sum{};
    for (const Node& n : nodes) sum = sum + lattice_.position(n);
    return (1.0 / nodes.size()) * sum;
  }

  int vertex(const Edge& e) {
    const std::uint64_t key = std::uint64_t(std::min(lattice_.at(e[0]), lattice_.at(e[1]))) * 8 + direction(e);
    const auto [found, is_new] = vertices_.try_emplace(key, static_cast<int>(crossings.size()));
    if (is_new) crossings.push_back(e);
    return found->second;
  }

  /// Which of the seven edge directions: bits of the axes in which the two nodes differ.
  static int direction(const Edge& e) {
    int bits = 0;
    for (int i = 0; i < 3; ++i) bits |= (e[0][i] != e[1][i]) << i;
    return bits;
  }

  const Lattice& lattice_;
  std::unordered_map<std::uint64_t, int> vertices_;
};

/// Where f = 0 crosses a lattice edge: bisection keeps to its middle 70 % (so that no two vertices meet), Newton does the rest.
Vec3 crossing_point(const Implicit& f, const Vec3& inside, const Vec3& outside_point, double reach) {
  const Vec3 d = outside_point - inside;
  double low = 0, high = 1;
  for (int step = 0; step < 5; ++step) {
    const double t = 0.5 * (low + high);
    (f(inside + t * d) < 0 ? low : high) = t;
  }
  return project_to_zero(f, inside + std::clamp(0.5 * (low + high), 0.15, 0.85) * d, reach);
}

}  // namespace

TriangleSoup contour(const Implicit& f, const Box& box, double edge_mm, int threads) {
  Lattice lattice = lattice_over(box, edge_mm);
  fill_signs(lattice, f, threads);
  Contourer contourer(lattice);
  for (int k = 0; k + 1 < lattice.size[2]; ++k)
    for (int j = 0; j + 1 < lattice.size[1]; ++j)
      for (int i = 0; i + 1 < lattice.size[0]; ++i) contourer.cell({i, j, k});
  TriangleSoup result{{}, std::move(contourer.triangles)};
  result.points.resize(contourer.crossings.size());
  constexpr int block = 1024;
  slices_in_parallel(static_cast<int>(result.points.size() / block) + 1, threads, [&](int b) {
    for (std::size_t v = std::size_t(b) * block; v < std::min(result.points.size(), std::size_t(b + 1) * block); ++v)
      result.points[v] = crossing_point(f, lattice.position(contourer.crossings[v][0]), lattice.position(contourer.crossings[v][1]), edge_mm);
  });
  return result;
}

double area_mm2(const TriangleSoup& s) {
  double sum = 0;
  for (const auto& t : s.triangles) sum += 0.5 * norm(cross(s.points[t[1]] - s.points[t[0]], s.points[t[2]] - s.points[t[0]]));
  return sum;
}

double enclosed_mm3(const TriangleSoup& s) {
  double sum = 0;
  for (const auto& t : s.triangles) sum += dot(s.points[t[0]], cross(s.points[t[1]], s.points[t[2]])) / 6;
  return sum;
}

}  // namespace palpate
