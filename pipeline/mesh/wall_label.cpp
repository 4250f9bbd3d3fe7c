// Sampling along the normal, then two rounds of means over neighbours: a label's staircase is half a voxel high.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/mesh/wall_label.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include <palpate/errors.hpp>

namespace palpate {
namespace {

/// Share of the label at a place: trilinear between voxels' centres, nothing outside the image.
double share_at(const Labels& labels, const Affine& voxel_from_lps, int label, const Vec3& x) {
  const Vec3 v = voxel_from_lps(x);
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1;
    std::array<int, 3> at{};
    for (int c = 0; c < 3; ++c) {
      const double low = std::floor(v[c]);
      at[c] = static_cast<int>(low) + (corner >> c & 1);
      weight *= corner >> c & 1 ? v[c] - low : 1 - (v[c] - low);
    }
    const auto& size = labels.grid.size;
    if (at[0] < 0 || at[1] < 0 || at[2] < 0 || at[0] >= size[0] || at[1] >= size[1] || at[2] >= size[2]) continue;
    if (labels(at[0], at[1], at[2]) == label) sum += weight;
  }
  return sum;
}

struct Through {
  double from = 0, to = 0, thickness = 0, middle = 0;  ///< mm along the normal

  double distance() const { return from <= 0 && to >= 0 ? 0 : std::min(std::abs(from), std::abs(to)); }
};

/// Of the stretches of the line with some of the label, at least half of it somewhere, the one nearest to its start. Thickness is ∫ share ds: where share
/// crosses one half would make walls of few voxels a fifth of a voxel thinner.
std::optional<Through> through(const std::function<double(double)>& share, double reach, double step) {
  std::optional<Through> nearest;
  Through now;
  double most = 0, moment = 0;
  for (double s = -reach; s < reach + step; s += step) {
    const double part = s <= reach ? share(s) : 0;
    if (part > 0) {
      if (most == 0) now = {s, s, 0, 0}, moment = 0;
      now.to = s;
      now.thickness += part * step;
      moment += s * part * step;
      most = std::max(most, part);
      continue;
    }
    if (most >= 0.5) {
      now.middle = moment / now.thickness;
      if (!nearest || now.distance() < nearest->distance()) nearest = now;
    }
    most = 0;
  }
  return nearest;
}

/// Means over each node and its neighbours, `known` ones only.
void smooth(const ShellMesh& mesh, std::vector<double>& value, std::vector<char>& known) {
  std::vector<double> sum(value.size(), 0), count(value.size(), 0);
  const auto give = [&](int to, int from) {
    if (known[from]) sum[to] += value[from], count[to] += 1;
  };
  for (std::size_t i = 0; i < value.size(); ++i) give(static_cast<int>(i), static_cast<int>(i));
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) give(t[k], t[(k + 1) % 3]), give(t[(k + 1) % 3], t[k]);
  for (std::size_t i = 0; i < value.size(); ++i)
    if (count[i] > 0) value[i] = sum[i] / count[i], known[i] = 1;
}

}  // namespace

MeasuredWall measure_wall(ShellMesh& mesh, const Labels& labels, int wall_label, double reach) {
  const Affine voxel_from_lps = labels.grid.lps_from_voxel.inverse();
  const Vec3 spacing = labels.grid.spacing();
  const double step = 0.25 * std::min({spacing[0], spacing[1], spacing[2]});
  const std::size_t nodes = mesh.points.size();
  std::vector<Vec3> normal(nodes, Vec3{0, 0, 0});
  for (const auto& [a, b, c] : mesh.triangles)
    for (int i : {a, b, c}) normal[i] = normal[i] + cross(mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a]);
  std::vector<double> thickness(nodes, 0), middle(nodes, 0);
  std::vector<char> known(nodes, 0);
  MeasuredWall wall;
  for (std::size_t i = 0; i < nodes; ++i) {
    normal[i] = unit(normal[i]);
    const auto found = through([&](double s) { return share_at(labels, voxel_from_lps, wall_label, mesh.points[i] + s * normal[i]); }, reach, step);
    if (!found) continue;
    thickness[i] = found->thickness, middle[i] = found->middle, known[i] = 1;
    ++wall.measured;
  }
  if (!(2 * wall.measured >= static_cast<int>(nodes)))
    throw Failure(ExitCode::check_failed, "the wall's label is found at " + std::to_string(wall.measured) + " of " + std::to_string(nodes) + " nodes only", "",
                  "another --wall-label, or a surface that lies on the wall");
  for (int round = 0; round < 2 || std::count(known.begin(), known.end(), 0) > 0; ++round) {
    auto also = known;
    smooth(mesh, middle, also);
    smooth(mesh, thickness, known);
  }
  wall.filled = static_cast<int>(nodes) - wall.measured;
  for (std::size_t i = 0; i < nodes; ++i) {
    mesh.points[i] = mesh.points[i] + middle[i] * normal[i];
    mesh.thickness_mm[i] = thickness[i];
    wall.farthest_move = std::max(wall.farthest_move, std::abs(middle[i]));
  }
  return wall;
}

}  // namespace palpate
