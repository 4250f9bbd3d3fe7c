// test-surface-shapes FOLDER: labels and surfaces, good and bad, for tests/stage/surface.sh.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <palpate/mesh_files.hpp>
#include <palpate/nifti.hpp>
#include <tests/surface/shapes/shapes.hpp>

#include <array>
#include <filesystem>
#include <fstream>
#include <numbers>

namespace {

using namespace palpate;

/// A ball of radius 20 mm, as rings of triangles between two poles; `open_rings` are left out at the south pole.
Surface globe(int rings, int open_rings) {
  Surface s;
  const int around = 2 * rings;
  const auto at = [&](int ring, int turn) {
    const double theta = std::numbers::pi * ring / rings, phi = 2 * std::numbers::pi * turn / around;
    return Vec3{20 * std::sin(theta) * std::cos(phi), 20 * std::sin(theta) * std::sin(phi), 20 * std::cos(theta)};
  };
  for (int ring = 0; ring <= rings; ++ring)
    for (int turn = 0; turn < around; ++turn) s.points.push_back(at(ring, turn));
  for (int ring = 0; ring < rings - open_rings; ++ring)
    for (int turn = 0; turn < around; ++turn) {
      const int a = ring * around + turn, b = ring * around + (turn + 1) % around, c = a + around, d = b + around;
      if (ring > 0) s.triangles.push_back({a, c, b});
      if (ring + 1 < rings) s.triangles.push_back({b, c, d});
    }
  s.triangle_region.assign(s.triangles.size(), 3);
  s.region_names = {{3, "globe"}};
  return s;
}

void write_stl(const std::filesystem::path& path, const Surface& s) {
  std::ofstream out(path);
  out << "solid globe\n";
  for (const auto& t : s.triangles) {
    out << "facet normal 0 0 0\nouter loop\n";
    for (int p : t) out << "vertex " << s.points[p][0] << " " << s.points[p][1] << " " << s.points[p][2] << "\n";
    out << "endloop\nendfacet\n";
  }
  out << "endsolid globe\n";
}

}  // namespace

int main(int, char** argv) {
  const std::filesystem::path folder(argv[1]);
  const Vec3 thick{0.8, 0.8, 4}, half{18, 18, 18};
  write_labels(folder / "ball.nii.gz", test::labels_of(half, thick, test::ball(14)));
  write_labels(folder / "mirrored.nii.gz", test::labels_of(half, thick, test::ball(14), true));
  write_labels(folder / "ring.nii.gz", test::labels_of({24, 24, 8}, {1, 1, 1}, test::torus(15, 5)));
  write_labels(folder / "cut.nii.gz", test::labels_of({10, 18, 18}, thick, test::ball(14)));
  Labels two = test::labels_of({36, 18, 18}, thick, test::ball(14, {-18, 0, 0}));
  const Labels other = test::labels_of({36, 18, 18}, thick, test::ball(11, {18, 0, 0}));
  for (std::size_t v = 0; v < two.voxels.size(); ++v)
    if (other.voxels[v]) two.voxels[v] = 2;
  write_labels(folder / "two.nii.gz", two);
  write_labels(folder / "empty.nii.gz", test::labels_of(half, thick, [](const Vec3&) { return false; }));
  Scan scan{two.grid, std::vector<float>(two.voxels.begin(), two.voxels.end())};
  write_scan(folder / "nan.nii", scan);
  std::fstream file(folder / "nan.nii", std::ios::in | std::ios::out | std::ios::binary);
  const float nan = NAN;
  file.seekp(352 + 7 * sizeof nan);  // behind the header of NIfTI-1
  file.write(reinterpret_cast<const char*>(&nan), sizeof nan);
  write_surface(folder / "globe.vtp", globe(40, 0));
  write_stl(folder / "globe.stl", globe(40, 0));
  write_surface(folder / "small_hole.vtp", globe(40, 3));
  write_surface(folder / "large_hole.vtp", globe(40, 15));
  Surface crossing = globe(40, 0);
  const Surface copy = crossing;
  for (const Vec3& x : copy.points) crossing.points.push_back(x + Vec3{15, 0, 0});
  for (const auto& t : copy.triangles) {
    const int n = int(copy.points.size());
    crossing.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
    crossing.triangle_region.push_back(3);
  }
  write_surface(folder / "crossing.vtp", crossing);
}
