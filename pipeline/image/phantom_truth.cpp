// Volumes by adaptive integration: cells with |f(centre)| above half their diagonal are all in or all out, as |∇f| ≤ 1.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/phantom_truth.hpp>

#include <algorithm>
#include <array>

#include <pipeline/image/marching_tetrahedra.hpp>
#include <pipeline/image/slices_in_parallel.hpp>

namespace palpate {
namespace {

/// Adds the cell's part inside. At the last level f / |∇f| is the distance of a plane: unbiased, for ½ − f / h is odd about f = 0.
void add_cell(const Implicit& f, const Vec3& centre, const Vec3& edges, int depth, Moments& m) {
  const double value = f(centre), half_diagonal = 0.5 * norm(edges);
  const bool pure = std::abs(value) >= half_diagonal;
  if (pure && value > 0) return;
  if (!pure && depth > 0) {
    for (int corner = 0; corner < 8; ++corner) {
      Vec3 child = centre;
      for (int i = 0; i < 3; ++i) child[i] += (corner >> i & 1 ? 0.25 : -0.25) * edges[i];
      add_cell(f, child, 0.5 * edges, depth - 1, m);
    }
    return;
  }
  const double h = std::cbrt(edges[0] * edges[1] * edges[2]);
  const double slope = pure ? 1.0 : std::max(norm(gradient(f, centre, 1e-3 * h)), 1e-3);
  const double inside = (pure ? 1.0 : std::clamp(0.5 - value / slope / h, 0.0, 1.0)) * edges[0] * edges[1] * edges[2];
  m.volume_mm3 += inside;
  m.centroid_mm = m.centroid_mm + inside * centre;
}

constexpr int fine = 8;  // cells of 1/256 of the box: 0.4 mm for a kidney, the volume to 1e-4

double diagonal(const Box& box) { return norm(box.max - box.min); }

/// First zero of f from x along the unit vector d, or `limit`.
double distance_to_boundary(const Implicit& f, const Vec3& x, const Vec3& d, double limit) {
  double t = 0;
  while (t < limit) {
    const double value = f(x + t * d);
    if (value > -1e-9) break;
    t -= value;
  }
  return t;
}

Json press_facts(const Organ& organ) {
  const double limit = diagonal(organ.box);
  const Vec3 entry = organ.seed - distance_to_boundary(organ.shape, organ.seed, -1.0 * organ.press_axis, limit) * organ.press_axis;
  const Vec3 exit = organ.seed + distance_to_boundary(organ.shape, organ.seed, organ.press_axis, limit) * organ.press_axis;
  return {{"axis", organ.press_axis}, {"entry_mm", entry}, {"exit_mm", exit}, {"thickness_mm", norm(exit - entry)}};
}

}  // namespace

Moments integrate(const Implicit& f, const Box& box, int depth, int threads) {
  constexpr int n = 4;  // 4³ cells of the second level, each by one thread, added in order
  std::array<Moments, n * n * n> shares;
  const Vec3 edges = (1.0 / n) * (box.max - box.min);
  slices_in_parallel(n * n * n, threads, [&](int s) {
    const Vec3 index{s % n + 0.5, s / n % n + 0.5, s / (n * n) + 0.5};
    add_cell(f, box.min + Vec3{index[0] * edges[0], index[1] * edges[1], index[2] * edges[2]}, edges, depth - 2, shares[s]);
  });
  Moments m;
  for (const Moments& share : shares) {
    m.volume_mm3 += share.volume_mm3;
    m.centroid_mm = m.centroid_mm + share.centroid_mm;
  }
  if (m.volume_mm3 > 0) m.centroid_mm = (1 / m.volume_mm3) * m.centroid_mm;
  return m;
}

Implicit part_alone(const Organ& organ, int index) {
  Implicit alone = intersection(organ.shape, organ.parts[index].shape);
  for (int before = 0; before < index; ++before)
    alone = intersection(alone, [other = organ.parts[before].shape](const Vec3& x) { return -other(x); });
  return alone;
}

Surface truth_surface(const Organ& organ, int threads) {
  TriangleSoup soup = contour(organ.shape, organ.box, diagonal(organ.box) / 180, threads);
  Surface surface;
  surface.points = std::move(soup.points);
  surface.triangles = std::move(soup.triangles);
  surface.triangle_region.assign(surface.triangles.size(), 1);
  surface.region_names = {{1, organ.name}};
  return surface;
}

Json truth_facts(const PhantomSpec& spec, const Grid& grid, const Surface& surface, int threads) {
  const Organ& organ = spec.organ;
  const Moments whole = integrate(organ.shape, organ.box, fine, threads), coarse = integrate(organ.shape, organ.box, fine - 1, threads);
  Json parts = Json::array();
  for (int p = 0; p < static_cast<int>(organ.parts.size()); ++p)
    parts.push_back({{"name", organ.parts[p].name},
                     {"label", organ.parts[p].label},
                     {"volume_mm3", integrate(part_alone(organ, p), organ.box, fine - 1, threads).volume_mm3},
                     {"intensity", organ.parts[p].intensity}});
  return {{"schema", "palpate-truth/1"},
          {"title", spec.title},
          {"organ", organ.name},
          {"label", 1},
          {"volume_mm3", whole.volume_mm3},
          {"volume_error_mm3", std::abs(whole.volume_mm3 - coarse.volume_mm3)},
          {"surface_area_mm2", area_mm2({surface.points, surface.triangles})},
          {"parts", parts},
          {"box_mm", {{"min", organ.box.min}, {"max", organ.box.max}}},
          {"centre_mm", whole.centroid_mm},
          {"seed_mm", organ.seed},
          {"press", press_facts(organ)},
          {"scan",
           {{"size", grid.size},
            {"voxel_mm", spec.scan.voxel_mm},
            {"slice_thickness_mm", spec.scan.slice_thickness_mm},
            {"row_direction", spec.scan.row_direction},
            {"column_direction", spec.scan.column_direction},
            {"first_voxel_mm", grid.lps_from_voxel.origin},
            {"noise_sigma", spec.scan.noise * organ.parts.back().intensity},
            {"background", spec.scan.background}}}};
}

}  // namespace palpate
