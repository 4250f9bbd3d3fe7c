// Lifts the worst tetrahedra: optimisation-based smoothing and topological changes, after Freitag & Ollivier-Gooch (1997).
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <palpate/json.hpp>
#include <pipeline/mesh/nearest_point.hpp>

namespace palpate {

struct ImproveSettings {
  double target_deg = 18;   ///< dihedral angles are kept from 0° and 180° by this much where possible
  int passes = 40;          ///< at most; ends earlier when nothing improves
};

struct ImproveLog {
  long moved = 0, edges_removed = 0, faces_swapped = 0, contracted = 0, split = 0, moved_on_surface = 0;
};

Json to_json(const ImproveLog& log);

/// Each change raises the smallest dihedral sine of the tetrahedra it touches. Nodes before `first_inner` are the surface's: they keep
/// their order, and move only along `surface` and only where nothing else helped; the boundary's triangles keep their corners. Nodes
/// that are no longer used are removed. Deterministic.
ImproveLog improve(TetMesh& mesh, int first_inner, const SurfaceIndex& surface, const ImproveSettings& settings = {});

}  // namespace palpate
