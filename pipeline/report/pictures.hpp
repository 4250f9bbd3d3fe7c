// The pictures of a study: surface, mesh cut open, pressed organ, section through the contact.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

#include <palpate/mesh_files.hpp>
#include <pipeline/report/picture.hpp>
#include <pipeline/report/tool_shape.hpp>

namespace palpate {

/// From the front, the left and above, all at one scale.
std::vector<NamedPicture> surface_pictures(const Surface& surface);

/// The mesh whole, and with the nearer half of its tetrahedra taken away.
std::vector<NamedPicture> mesh_pictures(const TetMesh& mesh);

/// An organ at one moment of a solution.
struct Pressed {
  TetMesh mesh;                    ///< reference points
  std::vector<Vec3> displacement;  ///< per point, mm
  std::vector<double> von_mises;   ///< per tetrahedron, MPa
  std::optional<Tool> tool;
};

/// Outside, coloured by the length of the displacement from 0 to `displacement_mm`; the line is the organ at rest.
Picture pressed_outside(const Pressed& pressed, double displacement_mm);

/// The cut along the tool's axis, coloured by the von Mises stress from 0 to `stress_mpa`: whole, and near the contact with its
/// elements.
std::vector<NamedPicture> pressed_sections(const Pressed& pressed, double stress_mpa);

}  // namespace palpate
