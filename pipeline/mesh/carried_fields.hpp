// What a deformed mesh brings along (targets, rest places, other fields), and what a new mesh says of where it came from.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>

#include <pipeline/mesh/carried_mesh.hpp>

namespace palpate {

/// The point field "rest", or nothing. Throws Failure(unreadable) when it has not three components.
std::vector<Vec3> rest_places(const MeshFields& fields, const TetMesh& mesh);

/// The field "target_mm" of the tetrahedra, or the same `otherwise` for all.
std::vector<double> targets(const MeshFields& fields, const TetMesh& mesh, double otherwise);

double longest_edge(const TetMesh& mesh);

long inverted_at_rest(const CarriedMesh::Result& result);

/// The new mesh with the old point fields carried by the weights, origin_nodes, origin_weights on points, parent on cells.
void write_carried(const std::filesystem::path& path, const CarriedMesh::Result& result, const MeshFields& old);

}  // namespace palpate
