// Surfaces (.vtp), volume meshes and thin walls (.vtu) with region per cell, SPACE=LPS and UNITS=mm as field data.
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

/// A thin wall: triangles of its mid-surface (counter-clockwise seen from outside) with a thickness at every point.
struct ShellMesh {
  std::vector<Vec3> points;
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> triangle_region;
  std::vector<double> thickness_mm;   ///< one per point
  std::vector<int> end;               ///< one per point: 1, 2, … on the rim of an end of the tube, 0 elsewhere
  std::vector<Vec3> end_direction;    ///< one per point: along the local centre line, out of the tube; zero away from the ends
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
/// `tet_fields`: of the tetrahedra, and of the faces behind them where a field is long enough.
void write_mesh(const std::filesystem::path& path, const TetMesh& mesh, const std::vector<Field>& point_fields = {},
                const std::vector<Field>& tet_fields = {});

/// Throws Failure(unreadable) as read_mesh does, and for cells other than triangles or points without a thickness.
ShellMesh read_shells(const std::filesystem::path& path);
void write_shells(const std::filesystem::path& path, const ShellMesh& mesh, const std::vector<Field>& point_fields = {},
                  const std::vector<Field>& triangle_fields = {});

/// The fields on the points, the tetrahedra and the faces of a .vtu (a solver's frame).
struct MeshFields {
  std::vector<Field> on_points, on_tets, on_faces;
};
MeshFields read_mesh_fields(const std::filesystem::path& path);

}  // namespace palpate
