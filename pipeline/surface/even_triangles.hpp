// Remeshing that does not stop at narrow creases.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <palpate/mesh_files.hpp>

namespace palpate {

/// Remeshed to edges of `edge_mm`; where a crease or neck is too narrow for the triangles (an angle below 20 deg, a fold below 40
/// deg), it is relaxed a little and the whole remeshed again, while that helps.
Surface even_triangles(const Surface& surface, double edge_mm, int iterations);

}  // namespace palpate
