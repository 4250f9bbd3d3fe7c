// Surfaces (.vtp) and volume meshes (.vtu) with region per cell, SPACE=LPS and UNITS=mm as field data.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <palpate/vec3.hpp>

namespace palpate {

using RegionNames = std::map<int, std::string>;

/// Closed triangle surface; triangles counter-clockwise seen from outside.
struct Surface {
  std::vector<Vec3> points;
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> triangle_region;  ///< one per triangle
  RegionNames region_names;
};

/// Tetrahedra (positive volume, VTK order) and named faces of their boundary.
struct TetMesh {
  std::vector<Vec3> points;
  std::vector<std::array<int, 4>> tets;
  std::vector<int> tet_region;
  std::vector<std::array<int, 3>> faces;  ///< sets as 2-D cells, outward
  std::vector<int> face_region;
  RegionNames region_names;
};

/// A result on the points of a mesh or on its tetrahedra: `components` numbers each, in order.
struct Field {
  std::string name;
  int components = 1;
  std::vector<double> values;
};

/// Throws Failure(unreadable): not a .vtp, cells that are not triangles, points that are not finite.
Surface read_surface(const std::filesystem::path& path);
void write_surface(const std::filesystem::path& path, const Surface& surface, const std::vector<Field>& point_fields = {});

/// Throws Failure(unreadable): not a .vtu, cells other than tetrahedra and triangles, points that are not finite.
TetMesh read_mesh(const std::filesystem::path& path);
void write_mesh(const std::filesystem::path& path, const TetMesh& mesh, const std::vector<Field>& point_fields = {},
                const std::vector<Field>& tet_fields = {});

/// The fields on the points and on the tetrahedra of a .vtu (a solver's frame).
struct MeshFields {
  std::vector<Field> on_points, on_tets;
};
MeshFields read_mesh_fields(const std::filesystem::path& path);

}  // namespace palpate
