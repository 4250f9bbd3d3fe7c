// Walls that are not everywhere as thick: zones and circular folds along the centre line, polyps on one side. The mid-surface stays.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include <palpate/mesh_files.hpp>
#include <pipeline/mesh/centre_line.hpp>

namespace palpate {

/// Between two places along the centre line (mm) the wall is `factor` times as thick, with edges of `edge` mm half inside.
struct ThicknessZone {
  double from, to, factor, edge;
};

/// t += height (1 − d²/radius²)² within the radius, mm.
struct Polyp {
  Vec3 middle;
  double radius, height;
};

/// Throws Failure(misuse) for one that reaches no node.
void vary_thickness(ShellMesh& mesh, const CentreLine& line, const std::vector<ThicknessZone>& zones, const std::vector<Polyp>& polyps);

}  // namespace palpate
