// CGAL's halfedge mesh and the way there and back. Included only by this room's CGAL sources.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <optional>

#include <palpate/mesh_files.hpp>

namespace palpate {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalMesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// Empty when the triangles are not those of an oriented manifold. Faces keep their order.
std::optional<CgalMesh> to_cgal(const Surface& surface);

/// Points and triangles in the order of the mesh's indices; regions are 0.
Surface from_cgal(CgalMesh& mesh);

inline Vec3 vec3(const Kernel::Point_3& p) { return {p.x(), p.y(), p.z()}; }

}  // namespace palpate
