// Σ m mᵀ over what is held, m = (e_c, x × e_c) the rigid motions' work at component c of node x; its small eigenvalues are free motions.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/implicit/free_bodies.hpp>

#include <cmath>
#include <numeric>

namespace palpate::implicit {
namespace {

using Mat6 = Eigen::Matrix<double, 6, 6>;

/// The body of each node: the smallest node that tetrahedra join it to.
std::vector<int> bodies_of_nodes(const Model& model) {
  std::vector<int> body(model.points.size());
  std::iota(body.begin(), body.end(), 0);
  const auto root = [&](int node) {
    while (body[node] != node) node = body[node] = body[body[node]];
    return node;
  };
  for (const auto& tet : model.tets)
    for (int k = 1; k < 4; ++k) {
      const int a = root(tet[0]), b = root(tet[k]);
      body[std::max(a, b)] = std::min(a, b);
    }
  for (int node = 0; node < static_cast<int>(body.size()); ++node) body[node] = root(node);
  return body;
}

}  // namespace

std::vector<FreeBody> free_bodies(const Model& model) {
  const auto body = bodies_of_nodes(model);
  const int count = static_cast<int>(body.size());
  std::vector<Eigen::Vector3d> middle(count, Eigen::Vector3d::Zero());
  std::vector<double> nodes(count, 0), size(count, 0);
  for (int i = 0; i < count; ++i) {
    middle[body[i]] += model.points[i];
    ++nodes[body[i]];
  }
  for (int i = 0; i < count; ++i) size[body[i]] = std::max(size[body[i]], (model.points[i] - middle[body[i]] / nodes[body[i]]).norm());
  std::vector<Mat6> held(count, Mat6::Zero());
  const auto hold = [&](int node, int c) {
    const int b = body[node];
    Eigen::Matrix<double, 6, 1> m;
    const Eigen::Vector3d e = Eigen::Vector3d::Unit(c), arm = (model.points[node] - middle[b] / nodes[b]) / size[b];
    m << e, arm.cross(e);
    held[b] += m * m.transpose();
  };
  for (const auto& p : model.prescribed)
    if (p.component < 3) hold(p.node, p.component);
  for (const auto& spring : model.springs)
    for (int c = 0; c < 3; ++c)
      if (spring.stiffness > 0) hold(spring.node, c);
  for (const auto& bed : model.region_forces) {
    const std::vector<double> at_rest(bed.memory(), 0.0);
    for (const auto& point : bed.points) {
      const Eigen::Matrix3d stiffness = bed.effect.force.respond({Eigen::Vector3d::Zero(), point.normal}, at_rest, bed.parameters).by_displacement;
      for (int c = 0; c < 3; ++c)
        if (stiffness(c, c) < 0) hold(point.node, c);
    }
  }
  std::vector<FreeBody> list;
  for (int b = 0; b < count; ++b) {
    if (nodes[b] == 0) continue;
    const auto strengths = Eigen::SelfAdjointEigenSolver<Mat6>(held[b]).eigenvalues();
    const int motions = static_cast<int>((strengths.array() < 1e-6).count());
    if (motions == 0) continue;
    FreeBody free{std::vector<char>(count, 0), middle[b] / nodes[b], motions};
    for (int i = 0; i < count; ++i) free.nodes[i] = body[i] == b;
    list.push_back(std::move(free));
  }
  return list;
}

bool touched(const Model& model, const State& state, const FreeBody& body) {
  std::size_t at = 0;
  for (std::size_t tool = 0; tool < model.tools.size(); ++tool)
    for (const auto& face : model.faces)
      for (int q = 0; q < contact::points_per_face; ++q, ++at)
        if (state.contact_pressures[at] > 0 && body.nodes[face[0]]) return true;
  at = 0;
  for (const auto& pass : model.passes)
    for (int f : pass.own)
      for (int q = 0; q < contact::points_per_face; ++q, ++at)
        if (state.pair_pressures[at] > 0 && body.nodes[model.faces[f][0]]) return true;
  return false;
}

}  // namespace palpate::implicit
