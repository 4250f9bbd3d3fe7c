// Scenes of the study's shapes.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/report/pictures.hpp>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyDataNormals.h>
#include <vtkPolyDataSilhouette.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <set>

#include <pipeline/report/boundary.hpp>
#include <pipeline/report/scene.hpp>
#include <pipeline/report/vtk_shapes.hpp>

namespace palpate {
namespace {

using Triangles = std::vector<std::array<int, 3>>;

constexpr Colour steel{0.56, 0.60, 0.66}, ink{0.16, 0.18, 0.22}, rest_line{0.75, 0.15, 0.49};
constexpr int wide = 900, narrow = 560;  // pixels

/// Soft tones that differ in lightness too; regions beyond the last begin anew.
Colour region_colour(int region) {
  static const std::vector<Colour> tones{{0.76, 0.48, 0.42}, {0.45, 0.60, 0.72}, {0.85, 0.72, 0.46}, {0.52, 0.66, 0.52},
                                         {0.66, 0.55, 0.72}, {0.80, 0.62, 0.66}, {0.50, 0.52, 0.56}, {0.62, 0.70, 0.72}};
  return tones[std::size_t(std::max(0, region - 1)) % tones.size()];
}

Colour paler(const Colour& c) { return {0.35 * c[0] + 0.63, 0.35 * c[1] + 0.62, 0.35 * c[2] + 0.58}; }

vtkSmartPointer<vtkPolyData> polygon_of(const std::vector<Vec3>& points) {
  auto shape = vtkSmartPointer<vtkPolyData>::New();
  shape->SetPoints(vtk_points(points));
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell(static_cast<int>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) cells->InsertCellPoint(i);
  shape->SetPolys(cells);
  return shape;
}

vtkSmartPointer<vtkPolyData> smooth_shaded(vtkPolyData& shape) {
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(&shape);
  normals->SplittingOff();
  normals->ConsistencyOff();
  normals->Update();
  return normals->GetOutput();
}

std::vector<Vec3> used_points(const std::vector<Vec3>& points, const Triangles& triangles) {
  std::vector<Vec3> used;
  for (const auto& t : triangles)
    for (int i : t) used.push_back(points[i]);
  return used;
}

std::vector<double> lengths(const std::vector<Vec3>& vectors) {
  std::vector<double> list;
  for (const Vec3& v : vectors) list.push_back(norm(v));
  return list;
}

std::vector<Vec3> moved(const Pressed& pressed) {
  std::vector<Vec3> points = pressed.mesh.points;
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = points[i] + pressed.displacement[i];
  return points;
}

Triangles skin(const TetMesh& mesh) {
  Triangles triangles;
  for (const auto& face : boundary_faces(mesh.tets, std::vector<bool>(mesh.tets.size(), true))) triangles.push_back(face.points);
  return triangles;
}

/// The direction across the organ's broad side: of the patient's axes made perpendicular to `axis`, the one along which it is
/// thinnest.
Vec3 thin_direction(const std::vector<Vec3>& points, const Vec3& axis) {
  Vec3 best{0, 1, 0};
  double thinnest = std::numeric_limits<double>::infinity();
  for (const Vec3& patient : {Vec3{0, 1, 0}, Vec3{1, 0, 0}, Vec3{0, 0, 1}}) {
    const Vec3 across = patient - dot(patient, axis) * axis;
    if (norm(across) < 0.5) continue;
    const Vec3 direction = unit(across);
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Vec3& p : points) {
      low = std::min(low, dot(p, direction));
      high = std::max(high, dot(p, direction));
    }
    if (high - low < thinnest - 1e-9) {
      thinnest = high - low;
      best = direction;
    }
  }
  return best;
}

void add_regions(Scene& scene, const std::vector<Vec3>& points, const Triangles& triangles, const std::vector<int>& regions,
                 bool edges, bool pale) {
  for (int region : std::set<int>(regions.begin(), regions.end())) {
    Triangles own;
    for (std::size_t i = 0; i < triangles.size(); ++i)
      if (regions[i] == region) own.push_back(triangles[i]);
    auto shape = shape_of(points, own);
    Look look;
    look.colour = pale ? paler(region_colour(region)) : region_colour(region);
    look.edges = edges;
    look.line_width = 0.5;
    scene.add(edges ? shape.Get() : smooth_shaded(*shape).Get(), look);
  }
}

void add_tool(Scene& scene, const std::optional<Tool>& tool) {
  if (!tool) return;
  const ToolSurface shell = tool_surface(*tool);
  auto shape = shape_of(shell.points, shell.triangles);
  vtkNew<vtkPolyDataNormals> normals;  // a punch keeps its edge sharp
  normals->SetInputData(shape);
  normals->SetFeatureAngle(30);
  normals->Update();
  scene.add(normals->GetOutput(), {.colour = steel});
}

vtkSmartPointer<vtkUnstructuredGrid> grid_of(const Pressed& pressed) {
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(vtk_points(moved(pressed)));
  grid->Allocate(pressed.mesh.tets.size());
  for (const auto& t : pressed.mesh.tets) {
    const vtkIdType ids[4] = {t[0], t[1], t[2], t[3]};
    grid->InsertNextCell(VTK_TETRA, 4, ids);
  }
  grid->GetCellData()->AddArray(array_of("von_mises", pressed.von_mises));
  return grid;
}

/// Where to cut and how to look at it: along the tool's axis, or through the middle when there is no tool.
struct Cut {
  Vec3 origin, normal, axis;
};

Cut cut_of(const Pressed& pressed) {
  const auto& points = pressed.mesh.points;
  const Vec3 axis = pressed.tool ? pressed.tool->axis : Vec3{0, 0, -1};
  const Vec3 normal = thin_direction(points, axis);
  return {pressed.tool ? pressed.tool->tip_mm : fit_view(points, {0, 1, 0}, {0, 0, 1}).centre, normal, axis};
}

}  // namespace

std::vector<NamedPicture> surface_pictures(const Surface& surface) {
  struct Side {
    const char* name;
    Vec3 toward, up;
  };
  const Side sides[] = {
      {"from the front", {0, 1, 0}, {0, 0, 1}}, {"from the left", {-1, 0, 0}, {0, 0, 1}}, {"from above", {0, 0, -1}, {0, -1, 0}}};
  double width = 0, height = 0;
  for (const Side& side : sides) {
    const View view = fit_view(surface.points, side.toward, side.up);
    width = std::max(width, view.width_mm);
    height = std::max(height, view.height_mm);
  }
  Scene scene;
  add_regions(scene, surface.points, surface.triangles, surface.triangle_region, false, false);
  std::vector<NamedPicture> pictures;
  for (const Side& side : sides) {
    View view = fit_view(surface.points, side.toward, side.up);
    view.width_mm = width;
    view.height_mm = height;
    pictures.push_back({side.name, scene.draw(view, narrow)});
  }
  return pictures;
}

std::vector<NamedPicture> mesh_pictures(const TetMesh& mesh) {
  const Vec3 across = thin_direction(mesh.points, {0, 0, 0});
  const Vec3 up = std::abs(across[2]) > 0.5 ? Vec3{0, -1, 0} : Vec3{0, 0, 1};
  const Vec3 toward = across - 0.45 * up + 0.35 * cross(across, up);
  const View view = fit_view(mesh.points, toward, up);
  std::vector<NamedPicture> pictures;
  for (const bool open : {false, true}) {
    std::vector<bool> chosen;
    for (const auto& t : mesh.tets) {
      const Vec3 middle = 0.25 * (mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]] + mesh.points[t[3]]);
      chosen.push_back(!open || dot(middle - view.centre, across) > 0);
    }
    Triangles outer, inner;
    std::vector<int> outer_region, inner_region;
    for (const auto& face : boundary_faces(mesh.tets, chosen)) {
      (face.inner ? inner : outer).push_back(face.points);
      (face.inner ? inner_region : outer_region).push_back(mesh.tet_region[face.tet]);
    }
    Scene scene;
    add_regions(scene, mesh.points, outer, outer_region, true, false);
    add_regions(scene, mesh.points, inner, inner_region, true, true);
    pictures.push_back({open ? "cut open: tetrahedra inside are pale" : "whole", scene.draw(view, wide)});
  }
  return pictures;
}

Picture pressed_outside(const Pressed& pressed, double displacement_mm) {
  const Triangles triangles = skin(pressed.mesh);
  const Cut where = cut_of(pressed);
  const Vec3 toward = where.normal + 0.4 * where.axis;
  auto rest = shape_of(pressed.mesh.points, triangles);
  auto organ = shape_of(moved(pressed), triangles);
  organ->GetPointData()->AddArray(array_of("displacement", lengths(pressed.displacement)));
  vtkNew<vtkPolyDataSilhouette> silhouette;
  silhouette->SetInputData(rest);
  silhouette->SetDirectionToSpecifiedVector();
  silhouette->SetVector(const_cast<double*>(toward.data()));
  silhouette->SetEnableFeatureAngle(0);
  silhouette->Update();
  Scene scene;
  scene.add(smooth_shaded(*organ), {.field = "displacement", .tones = Tones::displacement, .top = displacement_mm});
  scene.add(silhouette->GetOutput(), {.colour = rest_line, .lit = false, .line_width = 1.5, .layer = -1000});  // behind the organ
  add_tool(scene, pressed.tool);
  std::vector<Vec3> seen = used_points(moved(pressed), triangles);
  for (const Vec3& p : used_points(pressed.mesh.points, triangles)) seen.push_back(p);
  if (pressed.tool)
    for (const Vec3& p : tool_surface(*pressed.tool).points) seen.push_back(p);
  return scene.draw(fit_view(seen, toward, -1.0 * where.axis), wide);
}

std::vector<NamedPicture> pressed_sections(const Pressed& pressed, double stress_mpa) {
  const Triangles triangles = skin(pressed.mesh);
  const Cut where = cut_of(pressed);
  auto section = cut(*grid_of(pressed), where.origin, where.normal);
  auto rest = cut(*shape_of(pressed.mesh.points, triangles), where.origin, where.normal);
  auto edge = cut(*shape_of(moved(pressed), triangles), where.origin, where.normal);
  std::vector<NamedPicture> pictures;
  for (const bool near : {false, true}) {
    if (near && !pressed.tool) break;
    Scene scene;
    scene.add(section.Get(),
              {.edges = near, .lit = false, .line_width = 0.5, .field = "von_mises", .tones = Tones::stress, .top = stress_mpa});
    scene.add(edge, {.colour = ink, .lit = false, .line_width = 1.2, .layer = 1});
    scene.add(rest, {.colour = rest_line, .lit = false, .line_width = 1.5, .layer = 3});
    std::vector<Vec3> seen = used_points(pressed.mesh.points, triangles);
    if (pressed.tool) {
      const auto tool = tool_section(*pressed.tool, cross(where.normal, where.axis));
      scene.add(polygon_of(tool), {.colour = steel, .lit = false, .layer = 2});
      seen.insert(seen.end(), tool.begin(), tool.end());
    }
    View view = fit_view(seen, where.normal, -1.0 * where.axis);
    if (near) {
      const double half = 2.6 * pressed.tool->radius_mm;
      view.centre = pressed.tool->tip_mm;
      view.width_mm = 2.4 * half;
      view.height_mm = 1.6 * half;
    }
    pictures.push_back({near ? "near the contact" : "whole section", scene.draw(view, wide)});
  }
  return pictures;
}

}  // namespace palpate
