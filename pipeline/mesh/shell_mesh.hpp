// Triangles of even size on an open tube, by gmsh: the surface is cut into pieces that a plane map can carry, and each is meshed there.
// (Marchandise, Remacle, Geuzaine 2014, Optimal parametrizations for surface remeshing, Engineering with Computers 30:383.)
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>

#include <palpate/mesh_files.hpp>

namespace palpate {

/// New triangles on `tube` with edges near `size(x)` mm; rims stay where they are, region 1 "wall", thickness everywhere the same,
/// ends marked with the normal of their rim, out of the tube. Throws Failure(check_failed) with gmsh's words.
ShellMesh mesh_tube(const Surface& tube, const std::function<double(const Vec3&)>& size, double thickness_mm);

}  // namespace palpate
