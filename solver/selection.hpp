// Where a case holds, moves or loads an organ: nodes of its surface, chosen by plane, box or label.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <set>
#include <vector>

#include <palpate/mesh_files.hpp>
#include <palpate/settings.hpp>

namespace palpate {

Eigen::Vector3d eigen(const Vec3& v);

/// A unit vector; Failure(misuse) for a zero one.
Eigen::Vector3d direction(const Settings& settings, const std::string& key);

std::set<int> boundary_nodes(const TetMesh& mesh);

/// By exactly one of plane = { point_mm, normal } (what lies on the side the normal points away from), box = { min_mm, max_mm },
/// label = "name". Failure(misuse) when fewer than three nodes are chosen.
std::set<int> chosen_nodes(const Settings& settings, const TetMesh& mesh);

/// Faces of the surface, by their numbers: those of a label, or those all of whose nodes a plane or a box chooses.
std::vector<int> chosen_faces(const Settings& settings, const TetMesh& mesh);

}  // namespace palpate
