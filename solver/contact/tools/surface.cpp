// Any closed triangle surface, grown by r so that its edges are round: g = g_surface(x − r e_z) − r; its lowest point comes to the tip.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/contact/closed_surface.hpp>

#include <algorithm>
#include <limits>
#include <memory>

#include <palpate/mesh_files.hpp>

namespace palpate::tools {
namespace {

Shape::Function read(const std::filesystem::path& file) {
  const Surface surface = read_surface(file);
  std::vector<Eigen::Vector3d> points;
  double lowest = std::numeric_limits<double>::infinity();
  for (const auto& p : surface.points) points.emplace_back(p[0], p[1], p[2]);
  for (const auto& t : surface.triangles)
    for (int point : t) lowest = std::min(lowest, points[point].z());
  const auto body = std::make_shared<const contact::ClosedSurface>(std::move(points), surface.triangles, file.string());
  return [body, lowest](const Eigen::Vector3d& x, std::span<const double> p) {
    Distance d = body->distance(x + (lowest - p[0]) * Eigen::Vector3d::UnitZ());
    d.g -= p[0];
    return d;
  };
}

}  // namespace

Shape surface() {
  return {{"tool", "surface",
           "any rigid closed triangle surface of a .vtp `file` (beside the case), z along its shank and its lowest point ahead, x along `across`",
           "Baerentzen, Aanaes 2005, IEEE Trans. Vis. Comput. Graph. 11:243 (sign of the distance)",
           {{"edge_radius_mm", "mm", {0, 1e3}, 0.25,
             "the surface is grown by this much, so that its edges are round (0: sharp, and contact may not converge)"}}},
          {}, read};
}

}  // namespace palpate::tools
