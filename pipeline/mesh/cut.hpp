// A mesh cut along a triangle surface, open or closed: edges that it crosses are split there, faces on it are opened, their nodes doubled.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <pipeline/mesh/carried_mesh.hpp>

namespace palpate {

struct CutReport {
  long faces = 0;       ///< of each lip
  double area_mm2 = 0;  ///< of each lip
  int components = 0;   ///< pieces of the mesh afterwards
};

/// The cut follows the surface where it crosses edges; nodes within the body that lie close to it are moved there, those of the body's surface stay
/// and draw the cut to them (by less than a tenth of an edge). The lip on the side that the surface's normals point away from is region `cut_1` of the faces, the other one `cut_2`; inside the body an open
/// surface's rim stays joined. Throws Failure(misuse) when the surface cuts nothing.
CutReport cut(CarriedMesh mesh, const Surface& surface, CarriedMesh::Result& result);

/// Pieces that hang together by faces.
int components(const TetMesh& mesh);

}  // namespace palpate
