// The wall of a scan as labels have it: along each node's normal, the integral of the label's share (trilinear) is the wall's
// thickness t = ∫ share ds, and its centroid the mid-surface.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <palpate/mesh_files.hpp>
#include <palpate/volume.hpp>

namespace palpate {

struct MeasuredWall {
  int measured = 0, filled = 0;  ///< nodes; those whose normal meets no wall have their neighbours' mean
  double farthest_move = 0;      ///< of a node to the wall's middle, mm
};

/// Sets thicknesses and moves nodes along their normals, but not at right angles to them; rims stay in their planes as far as their normals do. What lies
/// farther than `reach` mm from a node is another wall. Throws Failure(check_failed) when fewer than half of the nodes find the label.
MeasuredWall measure_wall(ShellMesh& mesh, const Labels& labels, int wall_label, double reach);

}  // namespace palpate
