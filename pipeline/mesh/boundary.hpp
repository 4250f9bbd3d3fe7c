// The boundary of a tetrahedral mesh: its faces with region, and an audit of what must hold for any mesh that is delivered.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <vector>

#include <palpate/mesh_files.hpp>
#include <pipeline/mesh/components.hpp>

namespace palpate {

/// Faces that belong to one tetrahedron only, counter-clockwise seen from outside, in order of their tetrahedron.
std::vector<std::array<int, 3>> boundary_faces(const TetMesh& mesh);

/// Lists the boundary as faces of the mesh. A face's region is that of its triangle in `surface` (whose points come first in the mesh),
/// shifted by a power of ten above all tet regions (at least 100) and named "<name>_surface".
void name_boundary(TetMesh& mesh, const Surface& surface);

/// Where a body's outer surface carries several regions (organs that hang together), each of its tets takes the region of the triangle nearest to
/// its centroid; all others keep their body's.
void divide_by_nearest_triangle(TetMesh& mesh, const Surface& surface, const std::vector<Shell>& shells, const std::vector<Body>& bodies);

struct MeshAudit {
  double volume_mm3 = 0;
  double area_mm2 = 0;         ///< of the boundary
  long inverted_tets = 0;      ///< Jacobian not positive
  long unlisted_faces = 0;     ///< boundary faces without a 2-D cell, or 2-D cells that are no boundary face (orientation counts)
  long open_edges = 0;         ///< boundary edges not shared by an even number of faces
  long unused_nodes = 0;
  long duplicate_nodes = 0;    ///< nodes at the place of another
  long unnamed_regions = 0;
};
MeshAudit audit(const TetMesh& mesh);

}  // namespace palpate
