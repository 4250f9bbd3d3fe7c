// t = −k (u·n) n − r k (u_t − s): a bed of springs on a region of the surface, k per area, n the region's normal at rest; the slip s grows so that the
// tangential part stays below friction times the pressure on the bed. (Winkler 1867; the bound by a return as in Simo and Laursen
// 1992, Computers & Structures 42:97, eq. 2.23-2.26.)
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/effects/effect.hpp>

namespace palpate::effects {
namespace {

constexpr double never_slips = 1e6;
/// As contact::inside_the_cone; wider, because what is pressed lightly here slides by little.
constexpr double inside_the_bound = 1e-4;

bool bonded(std::span<const double> p) { return p[2] == never_slips; }

// Memory: s, with friction. Parameters: k, r, friction.
Push respond(const Held& at, std::span<const double> memory, std::span<const double> p) {
  using Eigen::Matrix3d, Eigen::Vector3d;
  const Matrix3d along = at.normal * at.normal.transpose(), across = Matrix3d::Identity() - along;
  const double k = p[0], tangential = p[1] * p[0];
  const Vector3d slip = bonded(p) ? Vector3d(Vector3d::Zero()) : Vector3d(Eigen::Map<const Vector3d>(memory.data()));
  const Vector3d shear = -tangential * across * (at.displacement - slip);
  const double pressure = std::max(0.0, k * at.displacement.dot(at.normal)), size = shear.norm();
  Push push{-k * along * at.displacement + shear, -k * along - tangential * across};
  push.slides = !bonded(p) && (at.branch == Branch::by_bound ? size > p[2] * pressure : at.branch == Branch::slides);
  if (!push.slides || size == 0) return push;
  const Vector3d m = shear / size;
  push.traction += (p[2] * pressure / size - 1) * shear;
  push.by_displacement = -k * along - p[2] * pressure / size * tangential * (across - m * m.transpose());
  if (pressure > 0) push.by_displacement += p[2] * k * m * at.normal.transpose();
  return push;
}

/// u_t − s is what the shear stretches; a little less where it slides.
void remember(const Held& at, std::span<double> memory, std::span<const double> p) {
  const double tangential = p[1] * p[0];
  if (memory.empty() || tangential == 0) return;
  const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - at.normal * at.normal.transpose();
  const Eigen::Vector3d shear = across * respond(at, memory, p).traction;
  const double bound = p[2] * std::max(0.0, p[0] * at.displacement.dot(at.normal));
  const bool slides = shear.norm() >= bound * (1 - 0.1 * inside_the_bound);
  Eigen::Map<Eigen::Vector3d>(memory.data()) = across * at.displacement + (slides ? 1 - inside_the_bound : 1) / tangential * shear;
}

}  // namespace

Effect support() {
  return {.entry = {"effect", "support", "what carries the organ gives way: a bed of springs on a region of its surface, on which it may slide",
                    "Winkler 1867, Die Lehre von der Elasticitaet und Festigkeit (bed of springs)",
                    {{"stiffness", "N/mm^3", {0, 1e6}, 0.005, "of the springs at right angles to the region, per area at rest"},
                     {"tangential", "1", {0, 1e3}, 0.5, "stiffness along the region, of that across it"},
                     {"friction", "1", {0, never_slips}, 0.4, "Coulomb's coefficient of the bed; 1e6: it never slips"}}},
          .fallbacks = {1, never_slips},
          .force = {.memory = [](std::span<const double> p) { return bonded(p) ? 0 : 3; },
                    .respond = respond,
                    .remember = remember,
                    .symmetric = bonded}};
}

}  // namespace palpate::effects
