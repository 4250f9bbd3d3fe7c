// Reading a phantom's TOML file.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/phantom_spec.hpp>

#include <algorithm>
#include <limits>
#include <numbers>

#include <palpate/errors.hpp>
#include <palpate/settings.hpp>

namespace palpate {
namespace {

constexpr Range size_mm{0.5, 1000}, intensity{0, 20000};

[[noreturn]] void misuse(const std::string& what, const std::string& where, const std::string& next) {
  throw Failure(ExitCode::misuse, what, where, next);
}

/// Rotation by angles about x, then y, then z, in degrees.
Affine rotation(const Vec3& degrees) {
  Affine total;
  for (int axis = 0; axis < 3; ++axis) {
    const double angle = degrees[axis] * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (Vec3& column : total.columns) {
      const double a = column[u], b = column[v];
      column[u] = c * a - s * b;
      column[v] = s * a + c * b;
    }
  }
  return total;
}

Organ read_kidney(const Settings& s) {
  KidneyShape k;
  k.length_mm = s.real("length_mm", k.length_mm, size_mm);
  k.width_mm = s.real("width_mm", k.width_mm, size_mm);
  k.thickness_mm = s.real("thickness_mm", k.thickness_mm, size_mm);
  k.fullness = s.real("fullness", k.fullness, {0.5, 0.98});
  k.cortex_mm = s.real("cortex_mm", 0.15 * k.thickness_mm, {0, 100});
  k.hilum_depth_mm = s.real("hilum_depth_mm", 0.12 * k.width_mm, {0, 100});
  k.pyramids = static_cast<int>(s.integer("pyramids", k.pyramids, {1, 30}));
  k.cortex = s.real("cortex", k.cortex, intensity);
  k.medulla = s.real("medulla", k.medulla, intensity);
  k.pelvis = s.real("pelvis", k.pelvis, intensity);
  if (const auto defect = defect_of(k); !defect.empty()) misuse(defect, s.where(), "human: length 110, width 60, thickness 45");
  return kidney(k);
}

std::vector<Vec3> read_points(const Settings& s, const std::string& key, const std::vector<Vec3>& fallback) {
  if (!s.has(key)) return fallback;
  std::vector<Vec3> points;
  const Json list = s.value(key);
  const auto is_point = [](const Json& p) {
    return p.is_array() && p.size() == 3 && std::all_of(p.begin(), p.end(), [](const Json& x) {
             return x.is_number() && std::isfinite(x.get<double>()) && std::abs(x.get<double>()) <= 2000;
           });
  };
  if (!list.is_array() || !std::all_of(list.begin(), list.end(), is_point))
    misuse("not a list of points: " + key, s.where(key), key + " = [[x, y, z], …] in mm");
  for (const Json& p : list) points.push_back(p.get<Vec3>());
  return points;
}

Organ read_colon(const Settings& s) {
  ColonShape c;
  c.centreline_mm = read_points(s, "centreline_mm", c.centreline_mm);
  c.lumen_radius_mm = s.real("lumen_radius_mm", c.lumen_radius_mm, size_mm);
  c.wall_mm = s.real("wall_mm", c.wall_mm, {0.1, 100});
  c.haustra_spacing_mm = s.real("haustra_spacing_mm", c.haustra_spacing_mm, size_mm);
  c.haustra_depth_mm = s.real("haustra_depth_mm", c.haustra_depth_mm, {0, 100});
  c.wall = s.real("wall", c.wall, intensity);
  c.lumen = s.real("lumen", c.lumen, intensity);
  if (const auto defect = defect_of(c); !defect.empty()) misuse(defect, s.where(), "a smoother centreline_mm or a smaller lumen_radius_mm");
  return colon(c);
}

Organ read_uterus(const Settings& s) {
  UterusShape u;
  constexpr Range or_none{0, 1000};
  u.length_mm = s.real("length_mm", u.length_mm, size_mm);
  u.width_mm = s.real("width_mm", u.width_mm, size_mm);
  u.thickness_mm = s.real("thickness_mm", u.thickness_mm, size_mm);
  u.cervix_mm = s.real("cervix_mm", u.cervix_mm, size_mm);
  u.tube_length_mm = s.real("tube_length_mm", u.tube_length_mm, or_none);
  u.tube_mm = s.real("tube_mm", u.tube_mm, size_mm);
  u.ovary_length_mm = s.real("ovary_length_mm", u.ovary_length_mm, or_none);
  u.ovary_width_mm = s.real("ovary_width_mm", u.ovary_width_mm, size_mm);
  u.ovary_thickness_mm = s.real("ovary_thickness_mm", u.ovary_thickness_mm, size_mm);
  u.gap_mm = s.real("gap_mm", u.gap_mm, size_mm);
  u.uterus = s.real("uterus", u.uterus, intensity);
  u.tube = s.real("tube", u.tube, intensity);
  u.ovary = s.real("ovary", u.ovary, intensity);
  if (const auto defect = defect_of(u); !defect.empty()) misuse(defect, s.where(), "human: length 75, width 48, thickness 36, tube_length_mm 80");
  return uterus(u);
}

/// The organ of the one table [kidney], [colon] or [uterus].
Organ read_organ(const Settings& s) {
  constexpr std::pair<const char*, Organ (*)(const Settings&)> readers[] = {{"kidney", read_kidney}, {"colon", read_colon}, {"uterus", read_uterus}};
  int given = 0;
  for (const auto& [name, read] : readers) given += s.has(name);
  if (given != 1) misuse("one organ, please", s.where(), "one table of [kidney], [colon], [uterus]");
  const auto& [name, read] = *std::find_if(std::begin(readers), std::end(readers), [&](const auto& reader) { return s.has(reader.first); });
  return read(s.table(name));
}

/// Unit row and column directions of a plane, turned by `rotation_deg`; or as given.
void read_orientation(const Settings& s, ScanSettings& scan) {
  const auto plane = s.has("plane") ? s.choice("plane", {"axial", "coronal", "sagittal"}) : "axial";
  scan.row_direction = plane == "sagittal" ? Vec3{0, 1, 0} : Vec3{1, 0, 0};
  scan.column_direction = plane == "axial" ? Vec3{0, 1, 0} : Vec3{0, 0, -1};
  const Affine turn = rotation(s.vec3("rotation_deg", Vec3{0, 0, 0}));
  scan.row_direction = turn.linear(s.vec3("row_direction", scan.row_direction));
  scan.column_direction = turn.linear(s.vec3("column_direction", scan.column_direction));
  const double lengths = norm(scan.row_direction) * norm(scan.column_direction);
  if (!(lengths > 1e-6) || !(std::abs(dot(scan.row_direction, scan.column_direction)) < 0.01 * lengths))
    misuse("row_direction and column_direction are not at right angles", s.where("row_direction"), "leave them out, or give both");
  scan.row_direction = unit(scan.row_direction);
  scan.column_direction = unit(scan.column_direction - dot(scan.column_direction, scan.row_direction) * scan.row_direction);
}

ScanSettings read_scan_settings(const Settings& s) {
  ScanSettings scan;
  read_orientation(s, scan);
  scan.voxel_mm = s.vec3("voxel_mm", scan.voxel_mm);
  for (double edge : scan.voxel_mm)
    if (!(edge >= 0.05 && edge <= 20)) misuse("out of range: voxel_mm", s.where("voxel_mm"), "edges from 0.05 to 20 mm");
  scan.slice_thickness_mm = s.real("slice_thickness_mm", scan.voxel_mm[2], {0.05, 40});
  scan.margin_mm = s.real("margin_mm", scan.margin_mm, {0, 500});
  scan.background = s.real("background", scan.background, intensity);
  scan.noise = s.real("noise", scan.noise, {0, 1});
  scan.bias = s.real("bias", scan.bias, {0, 0.9});
  scan.supersampling = static_cast<int>(s.integer("supersampling", scan.supersampling, {1, 16}));
  return scan;
}

}  // namespace

PhantomSpec read_phantom_spec(const std::filesystem::path& path) {
  const Settings s = Settings::read(path);
  if (s.text("schema") != "palpate-phantom/1") misuse("not a phantom: schema", s.where("schema"), "schema = \"palpate-phantom/1\"");
  PhantomSpec spec;
  spec.title = s.text("title", path.stem().string());
  spec.organ = read_organ(s);
  if (s.has("pose")) {
    const Settings pose = s.table("pose");
    Affine patient_from_organ = rotation(pose.vec3("rotation_deg", Vec3{0, 0, 0}));
    patient_from_organ.origin = pose.vec3("centre_mm", Vec3{0, 0, 0});
    spec.organ = moved(spec.organ, patient_from_organ);
  }
  if (s.has("scan")) spec.scan = read_scan_settings(s.table("scan"));
  s.expect_all_read();
  return spec;
}

Grid scan_grid(const PhantomSpec& spec) {
  const Vec3 axes[3] = {spec.scan.row_direction, spec.scan.column_direction, cross(spec.scan.row_direction, spec.scan.column_direction)};
  const Box& box = spec.organ.box;
  Grid grid;
  grid.lps_from_voxel.origin = 0.5 * (box.min + box.max);
  double count = 1;
  for (int a = 0; a < 3; ++a) {
    double half = 0;  // of the box's shadow on this axis
    for (int i = 0; i < 3; ++i) half += std::abs(axes[a][i]) * (box.max[i] - box.min[i]) / 2;
    const double cells = std::ceil(2 * (half + spec.scan.margin_mm) / spec.scan.voxel_mm[a]) + 1;
    count *= cells;
    if (cells > 4096 || count > 4e8)
      misuse("the scan would have too many voxels", "[scan]", "larger voxel_mm or a smaller margin_mm (at most 4096 a side, 4e8 in all)");
    grid.size[a] = static_cast<int>(cells);
    grid.lps_from_voxel.columns[a] = spec.scan.voxel_mm[a] * axes[a];
  }
  grid.lps_from_voxel.origin =
      grid.lps_from_voxel.origin - grid.lps_from_voxel.linear({0.5 * (grid.size[0] - 1), 0.5 * (grid.size[1] - 1), 0.5 * (grid.size[2] - 1)});
  return grid;
}

}  // namespace palpate
