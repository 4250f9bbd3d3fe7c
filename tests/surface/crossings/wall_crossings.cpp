// Counts by CGAL, exactly, the pairs of triangles that cross in every frame of a clamped wall: of the wall with itself, and with the jaws,
// whose edges are rounded as the solver's are, the upper one moved back to where it was. test-wall-crossings RESULT EDGE_RADIUS_MM prints each
// frame that has some, and the sums. Exit 1 when there are any.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>

#include <palpate/mesh_files.hpp>
#include <palpate/text_file.hpp>
#include <pipeline/surface/remesh.hpp>

namespace fs = std::filesystem;
using namespace palpate;

namespace {

/// Depth of the jaw by time.
std::map<double, double> depths(const fs::path& history) {
  std::ifstream in(history);
  std::map<double, double> by_time;
  std::string line;
  std::getline(in, line);
  for (double t, depth; std::getline(in, line);)
    if (std::sscanf(line.c_str(), "%lf,%lf", &t, &depth) == 2) by_time[t] = depth;
  return by_time;
}

double nearest(const std::map<double, double>& by_time, double t) {
  auto after = by_time.lower_bound(t);
  if (after == by_time.end()) return by_time.rbegin()->second;
  if (after == by_time.begin()) return after->second;
  const auto before = std::prev(after);
  return t - before->first < after->first - t ? before->second : after->second;
}

/// A block with rounded edges of radius r: a cube's grid blown up to a ball of r, its eighths moved apart to the block's corners.
Surface rounded(const Vec3& middle, const std::array<Vec3, 3>& axes, const Vec3& half, double r) {
  constexpr int n = 15;  // odd: no point of the grid lies on a plane of symmetry
  Surface block;
  std::map<std::array<int, 3>, int> known;
  const auto point = [&](const std::array<int, 3>& g) {
    const auto [entry, fresh] = known.try_emplace(g, static_cast<int>(block.points.size()));
    if (fresh) {
      const Vec3 d = unit({std::tan(0.7853981 * (2.0 * g[0] / n - 1)), std::tan(0.7853981 * (2.0 * g[1] / n - 1)), std::tan(0.7853981 * (2.0 * g[2] / n - 1))});
      Vec3 x = middle;
      for (int k = 0; k < 3; ++k) x = x + (std::copysign(half[k] - r, d[k]) + r * d[k]) * axes[k];
      block.points.push_back(x);
    }
    return entry->second;
  };
  for (int k = 0; k < 3; ++k)
    for (int side : {0, n})
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          std::array<std::array<int, 3>, 4> q;
          for (int c = 0; c < 4; ++c) q[c][k] = side, q[c][(k + 1) % 3] = i + (c == 1 || c == 2), q[c][(k + 2) % 3] = j + (c >= 2);
          if (side == 0) std::swap(q[1], q[3]);
          const int a = point(q[0]), b = point(q[1]), c = point(q[2]), d = point(q[3]);
          block.triangles.push_back({a, b, c});
          block.triangles.push_back({a, c, d});
        }
  return block;
}

/// The wall as it is in the frame, and the jaws `back_mm` before their place at the end.
Surface together(const fs::path& frame, const Surface& jaws, double back_mm, double edge_radius) {
  const ShellMesh wall = read_shells(frame);
  Surface all{wall.points, wall.triangles, {}, {}};
  for (const Field& field : read_mesh_fields(frame).on_points)
    if (field.name == "displacement")
      for (std::size_t i = 0; i < all.points.size(); ++i)
        for (int k = 0; k < 3; ++k) all.points[i][k] += field.values[3 * i + k];
  const Vec3 axis = unit(jaws.points[0] - jaws.points[4]);
  for (int j : {0, 8}) {
    const Vec3 *x = &jaws.points[j], across = x[1] - x[0], along = x[2] - x[0], back = x[4] - x[0];
    const Vec3 middle = 0.5 * (x[0] + x[7]) - (j == 0 ? back_mm : 0) * axis;
    std::array<Vec3, 3> axes{unit(across), unit(along), unit(back)};
    if (dot(cross(axes[0], axes[1]), axes[2]) < 0) axes[0] = -1.0 * axes[0];
    const Surface block = rounded(middle, axes, {norm(across) / 2, norm(along) / 2, norm(back) / 2}, edge_radius);
    const int first = static_cast<int>(all.points.size());
    all.points.insert(all.points.end(), block.points.begin(), block.points.end());
    for (const auto& t : block.triangles) all.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  all.triangle_region.assign(all.triangles.size(), 1);
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const fs::path folder = argv[1];
  const Surface jaws = read_surface(folder / "jaws.vtp");
  const auto by_time = depths(folder / "history.csv");
  const double last = by_time.rbegin()->second;
  const std::string list = read_text(folder / "frames.pvd");
  static const std::regex entry("timestep=\"([^\"]*)\" file=\"([^\"]*)\"");
  std::size_t frames = 0, with_itself = 0, with_jaws = 0;
  for (std::sregex_iterator match(list.begin(), list.end(), entry), end; match != end; ++match, ++frames) {
    const std::string file = (*match)[2];
    const int triangles = static_cast<int>(read_shells(folder / file).triangles.size());
    for (const auto& [a, b] : self_intersections(together(folder / file, jaws, last - nearest(by_time, std::stod((*match)[1])), std::stod(argv[2])))) {
      std::printf("%s: triangles %d and %d%s\n", file.c_str(), a, b, b < triangles ? "" : " of a jaw");
      ++(b < triangles ? with_itself : with_jaws);
    }
  }
  std::printf("%zu frames: %zu pairs of the wall, %zu of wall and jaws\n", frames, with_itself, with_jaws);
  return frames > 0 && with_itself + with_jaws == 0 ? 0 : 1;
}
