// Tetrahedra that fill the bodies of a surface, by gmsh; the surface's triangles become the mesh's boundary as they are.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include <palpate/mesh_files.hpp>
#include <pipeline/mesh/components.hpp>
#include <pipeline/mesh/size_field.hpp>

namespace palpate {

struct Filling {
  TetMesh mesh;                       ///< tets with their body's region; no faces yet; points of the surface first, in its order
  std::vector<std::string> messages;  ///< gmsh's warnings, before improvement
};

/// Throws Failure(check_failed) with gmsh's own words and, where it names one, the place: triangles that intersect, a boundary that
/// cannot be recovered. Same input, same bytes; one thread; no files, no user options are read.
Filling fill(const Surface& surface, const std::vector<Shell>& shells, const std::vector<Body>& bodies, const SizeField& sizes);

}  // namespace palpate
