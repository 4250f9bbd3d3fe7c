// Pictures of a thin wall between jaws, coloured by its stress.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include <palpate/mesh_files.hpp>
#include <pipeline/report/picture.hpp>

namespace palpate {

/// A wall at one moment of a solution.
struct PressedWall {
  ShellMesh mesh;                  ///< reference points
  std::vector<Vec3> displacement;  ///< per point, mm
  std::vector<double> von_mises;   ///< per triangle, MPa
  Surface jaws;                    ///< two blocks of eight points, as palpate-solve writes them; empty: none
};

/// From the side and from above with the jaws' outlines, and the section through their middle, on one scale of stress.
std::vector<NamedPicture> wall_pictures(const PressedWall& wall, double stress_mpa);

}  // namespace palpate
