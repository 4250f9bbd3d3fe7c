// One point of integration: all is constant.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/elements/membrane_triangle.hpp>

namespace palpate::elements {

MembraneSystem membrane_triangle(const effects::Active& active, const std::array<Eigen::Vector3d, 3>& rest, const std::array<Eigen::Vector3d, 3>& now) {
  const Eigen::Vector3d edge = rest[1] - rest[0], other = rest[2] - rest[0], normal = edge.cross(other);
  const double area = normal.norm() / 2;
  const Eigen::Vector3d e1 = edge.normalized(), e2 = normal.cross(edge).normalized();
  Eigen::Matrix2d edges;
  edges << edge.norm(), other.dot(e1), 0, other.dot(e2);
  Eigen::Matrix<double, 2, 3> gradients;
  gradients.rightCols<2>() = edges.inverse().transpose();
  gradients.col(0) = -gradients.col(1) - gradients.col(2);
  Eigen::Matrix<double, 3, 2> F = Eigen::Matrix<double, 3, 2>::Zero();
  for (int a = 0; a < 3; ++a) F += now[a] * gradients.col(a).transpose();
  const auto r = active.effect.layer.respond(F, active.parameters);
  MembraneSystem system;
  system.energy = area * r.W;
  system.internal_force = area * r.A.norm() * gradients.norm();
  for (int a = 0; a < 3; ++a) {
    system.residual.segment<3>(3 * a) = area * r.N * gradients.col(a);
    for (int b = 0; b < 3; ++b)
      for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j)
          system.tangent.block<3, 3>(3 * a, 3 * b) += area * gradients(i, a) * gradients(j, b) * r.A.block<3, 3>(3 * i, 3 * j);
  }
  return system;
}

}  // namespace palpate::elements
