// The order of a thin wall's nodes and triangles.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <palpate/mesh_files.hpp>

namespace palpate {

/// Numbers nodes layer by layer from end 1 on (breadth first, as Cuthill and McKee 1969), and triangles by the smallest of their nodes: what lies near each other is near in memory too, and threads that
/// take the first and the second half meet along one ring only. A mesh without ends begins at its first node; a piece that hangs together with nothing before it follows at its first.
void order_along(ShellMesh& mesh);

}  // namespace palpate
