// Organs of analytic implicit shapes: a bean-shaped kidney, a colon with haustra, and a uterus with a tube and an ovary.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include <pipeline/image/implicit_shapes.hpp>

namespace palpate {

/// A tissue inside an organ. `shape` is cut by the organ and by the parts before it.
struct OrganPart {
  std::string name;
  int label = 0;
  Implicit shape;
  double intensity = 0;  ///< noise-free signal
};

/// A solid and its tissues. The last part is the rest of the organ: its shape is the organ's.
struct Organ {
  std::string name, body_part, laterality;  ///< the last two as DICOM codes; laterality may be empty
  Implicit shape;
  std::vector<OrganPart> parts;
  Box box;                     ///< encloses the shape
  Vec3 seed{0, 0, 0};          ///< a point well inside
  Vec3 press_axis{0, 1, 0};    ///< direction in which a tool would press: along the thickness
};

constexpr int outside = -1;
/// Index of the part at x, or `outside`.
int part_at(const Organ& organ, const Vec3& x);

/// In its own frame: long axis along z, lateral side towards +x, hilum towards −x, thickness along y; centred at 0.
struct KidneyShape {
  double length_mm = 110, width_mm = 60, thickness_mm = 45;
  double fullness = 0.84;        ///< diameter of the bent tube over the width; the rest is the bend
  double cortex_mm = 7;
  double hilum_depth_mm = 7;     ///< 0: none
  int pyramids = 9;
  double cortex = 1000, medulla = 850, pelvis = 1150;  ///< intensities
};
/// Why these numbers make no kidney; empty when they do.
std::string defect_of(const KidneyShape& shape);
Organ kidney(const KidneyShape& shape);

/// A tube around a curve through `centreline_mm`, closed at both ends; sacs (haustra) at equal distances along it.
struct ColonShape {
  std::vector<Vec3> centreline_mm{{-45, 0, -40}, {-50, 5, -5}, {-38, 0, 32}, {-8, -12, 42}, {22, -8, 30}, {38, 4, 0}, {48, 6, -32}};
  double lumen_radius_mm = 14;   ///< in the sacs
  double wall_mm = 3;
  double haustra_spacing_mm = 20;
  double haustra_depth_mm = 4;   ///< how far the folds between the sacs reach in; 0: a smooth tube
  double wall = 700, lumen = 1100;  ///< intensities
};
std::string defect_of(const ColonShape& shape);
Organ colon(const ColonShape& shape);

/// In its own frame: fundus towards +z, cervix towards −z, thickness along y, tube and ovary at +x; the pear's middle at 0. The ovary hangs on
/// the uterus by a ligament, which counts as uterus; the tube leaves the shoulder and arches over the ovary without touching it.
struct UterusShape {
  double length_mm = 75, width_mm = 48, thickness_mm = 36;
  double cervix_mm = 26;         ///< width of the cervix
  double tube_length_mm = 80;    ///< of its centre line; 0: no tube
  double tube_mm = 7;            ///< diameter
  double ovary_length_mm = 32, ovary_width_mm = 20, ovary_thickness_mm = 18;  ///< along x, z, y; length 0: no ovary
  double gap_mm = 5;             ///< between tube and the ovary's top; at its flank it is down to 0.6 of it
  double uterus = 800, tube = 1050, ovary = 1300;  ///< intensities
};
std::string defect_of(const UterusShape& shape);
Organ uterus(const UterusShape& shape);

/// The organ moved as a rigid body.
Organ moved(const Organ& organ, const Affine& pose);

}  // namespace palpate
