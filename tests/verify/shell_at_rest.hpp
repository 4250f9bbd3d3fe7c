// A shell under loads at rest: Newton's method on the very forces of the explicit scheme, tangent of each triangle by differences.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Sparse>
#include <algorithm>
#include <stdexcept>

#include <solver/explicit/wall_forces.hpp>

namespace palpate::explicit_shell {

struct AtRest {
  Wall wall;
  WallState state;
  std::vector<std::array<char, 3>> fixed;  ///< components of nodes
  std::vector<char> edge_fixed;
  std::vector<Lanes> load;
  std::vector<double> moment;              ///< on directors

  explicit AtRest(Wall w) : wall(std::move(w)), state(rest_state(wall)) {
    fixed.assign(wall.rest.size(), {0, 0, 0});
    edge_fixed.assign(wall.edges.size(), 0);
    load.assign(wall.rest.size(), Lanes{});
    moment.assign(wall.edges.size(), 0);
  }

  /// On a plane of symmetry: no motion along `axis`, no turn of the directors of edges in it.
  template <class On>
  void symmetric(int axis, const On& on) {
    for (std::size_t i = 0; i < wall.rest.size(); ++i)
      if (on(wall.rest[i])) fixed[i][axis] = 1;
    for (std::size_t e = 0; e < wall.edges.size(); ++e)
      if (on(wall.rest[wall.edges[e][0]]) && on(wall.rest[wall.edges[e][1]])) edge_fixed[e] = 1;
  }

  /// The state moved by `u`: three numbers per node, one turn per edge; directors are carried with their edges first.
  WallState moved(const Eigen::VectorXd& u) const {
    WallState s = state;
    for (std::size_t i = 0; i < s.x.size(); ++i) s.x[i] += Lanes{u[3 * i], u[3 * i + 1], u[3 * i + 2], 0};
    for (std::size_t e = 0; e < wall.edges.size(); ++e) turn(s, e, u[3 * s.x.size() + e]);
    return s;
  }

  void turn(WallState& s, int e, double angle) const {
    const auto [a, b] = wall.edges[e];
    Lanes t0 = state.x[b] - state.x[a], t = s.x[b] - s.x[a], d = state.director[e];
    t0 /= length3(t0), t /= length3(t);
    d -= dot3(d, t) / (1 + dot3(t0, t)) * (t0 + t);
    s.director[e] = std::cos(angle) * d + std::sin(angle) * cross3(t, d);
  }

  Eigen::VectorXd residual(const WallState& s) const {
    Slots slots = make_slots(wall);
    wall_forces(wall, s, 0, static_cast<int>(wall.packs.size()), slots);
    const WallLoad inner = gathered(wall, slots);
    const int n = static_cast<int>(wall.rest.size());
    Eigen::VectorXd r = Eigen::VectorXd::Zero(3 * n + wall.edges.size());
    for (int i = 0; i < n; ++i)
      for (int c = 0; c < 3; ++c) r[3 * i + c] = fixed[i][c] ? 0 : inner.force[i][c] + load[i][c];
    for (std::size_t e = 0; e < wall.edges.size(); ++e) r[3 * n + e] = edge_fixed[e] ? 0 : inner.moment[e] + moment[e];
    return r;
  }

  /// −∂r/∂u, fixed numbers on the diagonal.
  Eigen::SparseMatrix<double> tangent() const {
    std::vector<Eigen::Triplet<double>> entries;
    const int n = static_cast<int>(wall.rest.size());
    for (int t = 0; t < static_cast<int>(wall.triangles.size()); ++t) {
      std::array<int, 12> number;
      for (int k = 0; k < 3; ++k) {
        for (int c = 0; c < 3; ++c) number[3 * k + c] = 3 * wall.triangles[t][k] + c;
        number[9 + k] = 3 * n + wall.triangle_edges[t][k];
      }
      const auto rest = lane(wall.packs[t / 4].rest, t % 4);
      const double h = 1e-6 * rest.length[0];
      Eigen::Matrix<double, 12, 12> K;
      for (int j = 0; j < 12; ++j) {
        const double step = j < 9 ? h : 1e-6;
        const auto high = one(t, rest, j, step), low = one(t, rest, j, -step);
        K.col(j) = (high - low) / (2 * step);
      }
      for (int i = 0; i < 12; ++i)
        for (int j = 0; j < 12; ++j)
          if (!is_fixed(number[i]) && !is_fixed(number[j])) entries.emplace_back(number[i], number[j], K(i, j));
    }
    const int size = 3 * n + static_cast<int>(wall.edges.size());
    for (int i = 0; i < size; ++i)
      if (is_fixed(i)) entries.emplace_back(i, i, 1);
    Eigen::SparseMatrix<double> K(size, size);
    K.setFromTriplets(entries.begin(), entries.end());
    return K;
  }

  /// Newton steps until the residual is below `tolerance` of the loads. Returns how many. Throws std::runtime_error.
  int relax(double tolerance = 1e-4, int most = 30) {
    double scale = 0;
    for (const Lanes& f : load) scale = std::max(scale, length3(f));
    for (double m : moment) scale = std::max(scale, std::abs(m));
    const bool moments = std::any_of(moment.begin(), moment.end(), [](double m) { return m != 0; });
    if (scale == 0) scale = 1;  // only prescribed places: N
    for (int step = 0; step < most; ++step) {
      const Eigen::VectorXd r = residual(state);
      if (r.lpNorm<Eigen::Infinity>() <= tolerance * scale) return step;
      state = moved(moments ? solved<Eigen::SparseLU<Eigen::SparseMatrix<double>>>(r) : solved<Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>>(r));
    }
    throw std::runtime_error("not at rest");
  }

 private:
  /// Large turns do not commute: under moments the tangent is not quite symmetric, and L D Lᵀ would not converge.
  template <class Factor>
  Eigen::VectorXd solved(const Eigen::VectorXd& r) const {
    const Factor factor(tangent());
    if (factor.info() != Eigen::Success) throw std::runtime_error("singular tangent");
    return factor.solve(r);
  }

  bool is_fixed(int i) const {
    const int n = 3 * static_cast<int>(wall.rest.size());
    return i < n ? fixed[i / 3][i % 3] : edge_fixed[i - n];
  }

  Eigen::Matrix<double, 12, 1> one(int t, const elements::ShellRest<double>& rest, int j, double step) const {
    auto shape = now(wall, state, t);
    std::array<Lanes, 3> x0, x;
    for (int k = 0; k < 3; ++k) x[k] = x0[k] = state.x[wall.triangles[t][k]];
    if (j < 9) x[j / 3][j % 3] += step;
    for (int k = 0; k < 3; ++k) {
      shape.x[k] = {x[k][0], x[k][1], x[k][2]};
      const int a = (k + 1) % 3, b = (k + 2) % 3;
      Lanes t0 = x0[b] - x0[a], t1 = x[b] - x[a], d = state.director[wall.triangle_edges[t][k]];
      t0 /= length3(t0), t1 /= length3(t1);
      d -= dot3(d, t1) / (1 + dot3(t0, t1)) * (t0 + t1);
      const double angle = j == 9 + k ? rest.sign[k] * step : 0;
      d = std::cos(angle) * d + std::sin(angle) * cross3(t1, d);
      shape.director[k] = {d[0], d[1], d[2]};
    }
    const auto strain = elements::shell_strain(rest, shape);
    Eigen::Matrix<double, 12, 1> f;
    std::visit([&](const auto& law) {
      const auto out = elements::shell_forces(rest, shape, strain, elements::shell_stress(rest, strain, law));
      for (int k = 0; k < 3; ++k) f.segment<3>(3 * k) << out.force[k].x, out.force[k].y, out.force[k].z;
      for (int k = 0; k < 3; ++k) f[9 + k] = out.moment[k];
    }, wall.law);
    return f;
  }
};

/// A grid of (nu + 1) × (nv + 1) points of a map (u, v) → space, u, v in [0, 1], each square cut in two, diagonals alternating.
template <class Map>
ShellMesh grid_shell(int nu, int nv, double thickness, const Map& map) {
  ShellMesh mesh;
  for (int j = 0; j <= nv; ++j)
    for (int i = 0; i <= nu; ++i) mesh.points.push_back(map(double(i) / nu, double(j) / nv));
  for (int j = 0; j < nv; ++j)
    for (int i = 0; i < nu; ++i) {
      const int a = j * (nu + 1) + i, b = a + 1, c = b + nu + 1, d = a + nu + 1;
      if ((i + j) % 2 == 0) mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {a, c, d}});
      else mesh.triangles.insert(mesh.triangles.end(), {{a, b, d}, {b, c, d}});
    }
  mesh.thickness_mm.assign(mesh.points.size(), thickness);
  return mesh;
}

inline int nearest_node(const Wall& wall, const Vec3& x) {
  int best = 0;
  for (int i = 0; i < static_cast<int>(wall.rest.size()); ++i)
    if (length3(wall.rest[i] - lanes(x)) < length3(wall.rest[best] - lanes(x))) best = i;
  return best;
}

}  // namespace palpate::explicit_shell
