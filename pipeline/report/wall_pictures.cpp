// The jaws tell where to look from: their faces lie across the axis, their longer side across the tube.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/report/wall_pictures.hpp>

#include <vtkCellData.h>

#include <pipeline/report/scene.hpp>
#include <pipeline/report/vtk_shapes.hpp>

namespace palpate {
namespace {

constexpr Colour steel{0.56, 0.60, 0.66}, ink{0.16, 0.18, 0.22}, rest_line{0.75, 0.15, 0.49};
constexpr int wide = 900;

struct Frame {
  Vec3 axis{0, -1, 0}, across{1, 0, 0}, along{0, 0, 1}, middle{0, 0, 0};  ///< where the upper jaw goes; of the tube; between the jaws
};

/// Corner k of a block: bit 0 across, bit 1 along, bit 2 away from the wall; the upper jaw's eight come first.
Frame frame_of(const PressedWall& wall) {
  const auto& x = wall.jaws.points;
  Frame f;
  if (x.size() != 16) {
    for (const Vec3& p : wall.mesh.points) f.middle = f.middle + (1.0 / wall.mesh.points.size()) * p;
    return f;
  }
  f.axis = unit(x[0] - x[4]);
  f.across = unit(x[1] - x[0]);
  f.along = unit(x[2] - x[0]);
  f.middle = 0.125 * (x[0] + x[1] + x[2] + x[3] + x[8] + x[9] + x[10] + x[11]);
  return f;
}

std::vector<Vec3> moved(const PressedWall& wall) {
  std::vector<Vec3> points = wall.mesh.points;
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = points[i] + wall.displacement[i];
  return points;
}

std::vector<std::array<int, 2>> block_edges(std::size_t points) {
  std::vector<std::array<int, 2>> edges;
  for (int first = 0; first + 8 <= static_cast<int>(points); first += 8)
    for (const auto& [a, b] : {std::array{0, 1}, std::array{2, 3}, std::array{4, 5}, std::array{6, 7}, std::array{0, 2}, std::array{1, 3}, std::array{4, 6}, std::array{5, 7},
                               std::array{0, 4}, std::array{1, 5}, std::array{2, 6}, std::array{3, 7}})
      edges.push_back({first + a, first + b});
  return edges;
}

Picture outside(const PressedWall& wall, const Vec3& toward, const Vec3& up, double stress_mpa) {
  const auto points = moved(wall);
  auto shape = shape_of(points, wall.mesh.triangles);
  shape->GetCellData()->AddArray(array_of("von_mises", wall.von_mises));
  Scene scene;
  scene.add(shape, {.field = "von_mises", .tones = Tones::stress, .top = stress_mpa});
  scene.add(lines_of(wall.jaws.points, block_edges(wall.jaws.points.size())), {.colour = steel, .lit = false, .line_width = 1.5});
  std::vector<Vec3> seen = points;
  seen.insert(seen.end(), wall.jaws.points.begin(), wall.jaws.points.end());
  return scene.draw(fit_view(seen, toward, up), wide);
}

Picture section(const PressedWall& wall, const Frame& f, double stress_mpa) {
  auto shape = shape_of(moved(wall), wall.mesh.triangles);
  shape->GetCellData()->AddArray(array_of("von_mises", wall.von_mises));
  auto now = cut(*shape, f.middle, f.along), rest = cut(*shape_of(wall.mesh.points, wall.mesh.triangles), f.middle, f.along);
  auto jaws = cut(*shape_of(wall.jaws.points, wall.jaws.triangles), f.middle, f.along);
  std::vector<Vec3> seen = wall.jaws.points;
  for (auto* line : {now.Get(), rest.Get()})
    for (vtkIdType i = 0; i < line->GetNumberOfPoints(); ++i) seen.push_back({line->GetPoint(i)[0], line->GetPoint(i)[1], line->GetPoint(i)[2]});
  Scene scene;
  scene.add(rest, {.colour = rest_line, .lit = false, .line_width = 1});
  scene.add(jaws, {.colour = ink, .lit = false, .line_width = 2, .layer = 1});
  scene.add(now, {.lit = false, .line_width = 4, .layer = 2, .field = "von_mises", .tones = Tones::stress, .top = stress_mpa});
  return scene.draw(fit_view(seen, f.along, -1.0 * f.axis), wide);
}

}  // namespace

std::vector<NamedPicture> wall_pictures(const PressedWall& wall, double stress_mpa) {
  const Frame f = frame_of(wall);
  std::vector<NamedPicture> pictures{{"from the side", outside(wall, f.across + 0.5 * f.axis + 0.3 * f.along, -1.0 * f.axis, stress_mpa)},
                                     {"along the jaws' axis", outside(wall, f.axis, f.along, stress_mpa)}};
  if (!wall.jaws.points.empty()) pictures.push_back({"section between the jaws", section(wall, f, stress_mpa)});
  return pictures;
}

}  // namespace palpate
