// Node by node.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/mesh/shell_thickness.hpp>

#include <algorithm>

#include <palpate/errors.hpp>

namespace palpate {
namespace {

double ramp(double x) {
  const double t = std::clamp(x + 0.5, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

void expect(bool reached, const char* what) {
  if (!reached) throw Failure(ExitCode::misuse, std::string(what) + " reaches no node of the wall", "", "another place, a larger one, or a finer mesh there (--focus)");
}

}  // namespace

void vary_thickness(ShellMesh& mesh, const CentreLine& line, const std::vector<ThicknessZone>& zones, const std::vector<Polyp>& polyps) {
  std::vector<double> factor(mesh.points.size(), 1), more(mesh.points.size(), 0);
  for (const auto& zone : zones) {
    bool reached = false;
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
      const double s = line.project(mesh.points[i]), part = ramp((s - zone.from) / zone.edge) * ramp((zone.to - s) / zone.edge);
      factor[i] *= 1 + (zone.factor - 1) * part;
      reached = reached || part > 0.5;
    }
    expect(reached, "--zone");
  }
  for (const auto& polyp : polyps) {
    bool reached = false;
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
      const double d = norm(mesh.points[i] - polyp.middle) / polyp.radius;
      if (!(d < 1)) continue;
      more[i] += polyp.height * (1 - d * d) * (1 - d * d);
      reached = true;
    }
    expect(reached, "--polyp");
  }
  for (std::size_t i = 0; i < mesh.points.size(); ++i) mesh.thickness_mm[i] = factor[i] * mesh.thickness_mm[i] + more[i];
}

}  // namespace palpate
