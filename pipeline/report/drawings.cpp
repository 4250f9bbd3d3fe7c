// Reads surface, mesh and the deepest frames, finds the scale of the colours, draws.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/report/drawings.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <palpate/errors.hpp>
#include <pipeline/report/private_display.hpp>
#include <pipeline/report/wall_pictures.hpp>

namespace palpate {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void damaged(const fs::path& path, const std::string& what) {
  throw Failure(ExitCode::unreadable, what, path.string(), "run the stage that writes it again");
}

std::string place_text(const Vec3& x) {
  char text[80];
  std::snprintf(text, sizeof text, "(%.1f, %.1f, %.1f) mm", x[0], x[1], x[2]);
  return text;
}

/// The values of a field, `components` per item.
std::vector<double> values_of(const std::vector<Field>& fields, const std::string& name, int components, std::size_t items,
                              const fs::path& file) {
  for (const Field& field : fields) {
    if (field.name != name) continue;
    if (field.components != components || field.values.size() != components * items)
      damaged(file, "the field " + name + " does not fit the mesh");
    return field.values;
  }
  damaged(file, "the field " + name + " is missing");
}

void expect_finite(const std::vector<double>& values, int components, const std::string& name, const fs::path& file,
                   const std::function<Vec3(std::size_t)>& place) {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i])) damaged(file, name + " is not finite at " + place_text(place(i / components)));
}

Vec3 vec3_of(const Json& json, const std::string& key, const fs::path& file) {
  try {
    const Vec3 v = json.at(key).get<Vec3>();
    if (std::isfinite(dot(v, v))) return v;
  } catch (const Json::exception&) {
  }
  damaged(file, "tool." + key + " is not three numbers");
}

/// The tool at the depth of a frame: its tip at first contact, moved on along the axis. None when its kind is not drawn.
std::optional<Tool> tool_at(const Solve& solve, double depth_mm, double organ_mm) {
  const fs::path file = solve.folder / "summary.json";
  if (!solve.summary.contains("tool")) return {};
  const Json& json = solve.summary["tool"];
  if (!json.is_object() || !json.contains("first_contact_mm")) return {};
  Tool tool;
  try {
    if (!shape_tool(json, organ_mm, tool)) return {};
  } catch (const Json::exception& error) {
    damaged(file, std::string("tool: ") + error.what());
  }
  tool.axis = vec3_of(json, "axis", file);
  if (!(norm(tool.axis) > 0) || !(tool.radius_mm > 0)) damaged(file, "tool: the axis or the radius is zero");
  tool.axis = unit(tool.axis);
  const Vec3 any = std::abs(tool.axis[0]) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 across = json.contains("across") ? vec3_of(json, "across", file) : cross(any, tool.axis);
  const Vec3 sideways = across - dot(across, tool.axis) * tool.axis;
  if (!(norm(sideways) > 1e-6)) damaged(file, "tool: across points along the axis");
  tool.across = unit(sideways);
  tool.tip_mm = vec3_of(json, "first_contact_mm", file) + depth_mm * tool.axis;
  return tool;
}

/// Of the box around the points, mm.
double diagonal(const std::vector<Vec3>& points) {
  Vec3 low = points.front(), high = points.front();
  for (const Vec3& p : points)
    for (int k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  return norm(high - low);
}

double depth_at(const History& history, double time_s) {
  const auto &times = history.column("t[s]"), &depths = history.column("depth[mm]");
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < times.size(); ++i)
    if (std::abs(times[i] - time_s) < std::abs(times[nearest] - time_s)) nearest = i;
  return depths[nearest];
}

struct LoadedFrame {
  Pressed pressed;
  PressedWall wall;  ///< instead, where drawing.wall
  PressedDrawing drawing;
  double stress_scale_mpa = 0;  ///< 99.5 % of the elements lie below
};

/// Displacements and stresses of a frame, judged, with the scale of the latter.
void load_fields(LoadedFrame& loaded, const MeshFields& fields, const std::vector<Field>& on_cells, const std::vector<Vec3>& points,
                 const std::vector<Vec3>& cell_places, const fs::path& file, std::vector<Vec3>& displacement, std::vector<double>& von_mises) {
  const auto moved = values_of(fields.on_points, "displacement", 3, points.size(), file);
  von_mises = values_of(on_cells, "von_mises", 1, cell_places.size(), file);
  expect_finite(moved, 3, "displacement", file, [&](std::size_t i) { return points[i]; });
  expect_finite(von_mises, 1, "von_mises", file, [&](std::size_t t) { return cell_places[t]; });
  for (std::size_t i = 0; i < points.size(); ++i) {
    displacement.push_back({moved[3 * i], moved[3 * i + 1], moved[3 * i + 2]});
    loaded.drawing.largest_displacement_mm = std::max(loaded.drawing.largest_displacement_mm, norm(displacement.back()));
  }
  std::vector<double> sorted = von_mises;
  std::sort(sorted.begin(), sorted.end());
  loaded.drawing.largest_stress_mpa = sorted.back();
  loaded.stress_scale_mpa = sorted[std::size_t(0.995 * (sorted.size() - 1))];
}

void load_wall(LoadedFrame& loaded, const Solve& solve, const Frame& frame, const MeshFields& fields) {
  PressedWall& wall = loaded.wall;
  wall.mesh = read_shells(frame.file);
  std::vector<Vec3> places;
  for (const auto& t : wall.mesh.triangles) places.push_back(wall.mesh.points[t[0]]);
  load_fields(loaded, fields, fields.on_faces, wall.mesh.points, places, frame.file, wall.displacement, wall.von_mises);
  if (const fs::path jaws = solve.folder / "jaws.vtp"; fs::is_regular_file(jaws)) wall.jaws = read_surface(jaws);
}

LoadedFrame load(const Solve& solve, const Frame& frame) {
  LoadedFrame loaded;
  PressedDrawing& drawing = loaded.drawing;
  drawing.solve = solve.name;
  drawing.time_s = frame.time_s;
  drawing.depth_mm = depth_at(solve.history, frame.time_s);
  const MeshFields fields = read_mesh_fields(frame.file);
  drawing.wall = std::any_of(fields.on_points.begin(), fields.on_points.end(), [](const Field& field) { return field.name == "thickness"; });
  if (drawing.wall) {
    load_wall(loaded, solve, frame, fields);
    return loaded;
  }
  Pressed& pressed = loaded.pressed;
  pressed.mesh = read_mesh(frame.file);
  std::vector<Vec3> places;
  for (const auto& t : pressed.mesh.tets) places.push_back(pressed.mesh.points[t[0]]);
  load_fields(loaded, fields, fields.on_tets, pressed.mesh.points, places, frame.file, pressed.displacement, pressed.von_mises);
  pressed.tool = tool_at(solve, drawing.depth_mm, diagonal(pressed.mesh.points));
  return loaded;
}

}  // namespace

Drawings draw_study(const Study& study, const std::function<void(const std::string&)>& tell) {
  std::vector<LoadedFrame> frames;
  for (const Solve& solve : study.solves)
    if (const Frame* frame = deepest_frame(solve)) frames.push_back(load(solve, *frame));
  Drawings drawings;
  for (const LoadedFrame& frame : frames) {
    drawings.displacement_scale_mm = std::max(drawings.displacement_scale_mm, frame.drawing.largest_displacement_mm);
    drawings.stress_scale_mpa = std::max(drawings.stress_scale_mpa, frame.stress_scale_mpa);
  }
  const double displacement_top = std::max(drawings.displacement_scale_mm, 1e-12),
               stress_top = std::max(drawings.stress_scale_mpa, 1e-12);
  const Surface surface = study.surface.empty() ? Surface{} : read_surface(study.surface);  // all files before the first picture
  const TetMesh mesh = study.mesh.empty() ? TetMesh{} : read_mesh(study.mesh);
  const PrivateDisplay display;
  if (!surface.triangles.empty()) {
    tell("surface");
    drawings.surface = surface_pictures(surface);
  }
  if (!mesh.tets.empty()) {
    tell("mesh");
    drawings.mesh = mesh_pictures(mesh);
  }
  for (LoadedFrame& frame : frames) {
    tell(frame.drawing.solve);
    if (frame.drawing.wall) frame.drawing.sections = wall_pictures(frame.wall, stress_top);
    else {
      frame.drawing.outside = pressed_outside(frame.pressed, displacement_top);
      frame.drawing.sections = pressed_sections(frame.pressed, stress_top);
    }
    drawings.pressed.push_back(std::move(frame.drawing));
  }
  return drawings;
}

}  // namespace palpate
