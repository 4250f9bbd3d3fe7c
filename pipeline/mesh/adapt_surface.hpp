// A surface's triangles brought to the wanted edge length: splits, collapses, flips, tangential smoothing (Botsch & Kobbelt 2004).
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>

#include <palpate/mesh_files.hpp>
#include <pipeline/mesh/size_field.hpp>

namespace palpate {

/// Where the surface may be changed.
using AdaptWhere = std::function<bool(const Vec3&)>;

/// Edges end between 4/5 and 4/3 of the wanted length where `where` holds, and stay as they are elsewhere. Nodes lie on the input
/// surface, curved between its nodes by its normals (Phong tessellation, Boubekeur & Alexa 2008, α = 3/4); sharp edges (over 45°)
/// stay where they are. The enclosed volume is kept. Regions are kept; points without a triangle are dropped.
Surface adapt_surface(const Surface& surface, const SizeField& sizes, const AdaptWhere& where);

}  // namespace palpate
