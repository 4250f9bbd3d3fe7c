// A small made-up study folder for the tests of the report: tetrahedra with an analytic dent, cards and curves to match.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>

#include <palpate/json.hpp>
#include <palpate/mesh_files.hpp>
#include <palpate/text_file.hpp>

using namespace palpate;
namespace fs = std::filesystem;

namespace {

constexpr double radius_mm = 15, tool_radius_mm = 2.5, depth_mm = 4;
const Vec3 axis{0, 0, -1}, first_contact{0, 0, radius_mm};

/// A cube of n³ cells, six tetrahedra each, blown up into an ellipsoid.
TetMesh ellipsoid(int n) {
  TetMesh mesh;
  const auto index = [n](int i, int j, int k) { return (k * (n + 1) + j) * (n + 1) + i; };
  for (int k = 0; k <= n; ++k)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) {
        const Vec3 c{2.0 * i / n - 1, 2.0 * j / n - 1, 2.0 * k / n - 1};
        const double cube = std::max({std::abs(c[0]), std::abs(c[1]), std::abs(c[2])}), round = norm(c);
        const Vec3 x = (round > 0 ? radius_mm * cube / round : 0) * c;
        mesh.points.push_back({1.5 * x[0], 0.8 * x[1], x[2]});
      }
  constexpr int paths[6][2] = {{0, 1}, {0, 2}, {1, 0},
                               {1, 2}, {2, 0}, {2, 1}};  // from one corner of the cell to the opposite one
  for (int cell = 0; cell < n * n * n; ++cell) {
    const int low[3] = {cell % n, cell / n % n, cell / n / n};
    for (const auto& [first, second] : paths) {
      int a[3] = {low[0], low[1], low[2]};
      ++a[first];
      int b[3] = {a[0], a[1], a[2]};
      ++b[second];
      const int p = index(low[0], low[1], low[2]), q = index(a[0], a[1], a[2]), r = index(b[0], b[1], b[2]),
                s = index(low[0] + 1, low[1] + 1, low[2] + 1);
      const bool even = (second - first + 3) % 3 == 1;
      mesh.tets.push_back(even ? std::array<int, 4>{p, q, r, s} : std::array<int, 4>{p, r, q, s});
      mesh.tet_region.push_back(1);
    }
  }
  mesh.region_names = {{1, "kidney"}};
  return mesh;
}

Surface skin_of(const TetMesh& mesh, int n) {
  Surface surface{mesh.points, {}, {}, {{1, "kidney"}}};
  const auto coordinate = [n](int p, int a) {
    return a == 0 ? p % (n + 1) : a == 1 ? p / (n + 1) % (n + 1) : p / (n + 1) / (n + 1);
  };
  constexpr int outward[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  for (const auto& t : mesh.tets)
    for (const auto& f : outward)
      for (int side = 0; side < 6; ++side) {
        const auto on_side = [&](int corner) { return coordinate(t[f[corner]], side / 2) == (side % 2) * n; };
        if (!on_side(0) || !on_side(1) || !on_side(2)) continue;
        surface.triangles.push_back({t[f[0]], t[f[1]], t[f[2]]});
        surface.triangle_region.push_back(1);
      }
  return surface;
}

Json check(const std::string& name, const Json& value, const std::string& limit, bool pass) {
  return {{"name", name}, {"value", value}, {"limit", limit}, {"pass", pass}};
}

void write_card(const fs::path& output, const std::string& tool, const Json& checks, const Json& notes) {
  write_json(output.string() + ".card.json", {{"schema", "palpate-card/1"},
                                              {"tool", "palpate-" + tool},
                                              {"version", "0.1.0"},
                                              {"seconds", 1.25},
                                              {"warnings", Json::array()},
                                              {"checks", checks},
                                              {"notes", notes}});
}

std::string history_text(double stiffening) {
  std::string history = "t[s],depth[mm],Fx[N],Fy[N],Fz[N],F[N],contact_area[mm2],iterations\n";
  constexpr int steps = 20;
  for (int i = 0; i <= steps; ++i) {
    const double d = depth_mm * i / steps, force = 0.01 * std::pow(d, 1.5) * std::exp(stiffening * d);
    char line[200];
    std::snprintf(line, sizeof line, "%g,%g,0,0,%.8g,%.8g,%.8g,%d\n", 0.1 * i, d, -force, force, 3.1416 * tool_radius_mm * d,
                  i ? 4 : 0);
    history += line;
  }
  return history;
}

void write_frames(const fs::path& folder, const TetMesh& mesh, double stiffening) {
  Field rest{"displacement", 3, {}}, pressed = rest, von_mises{"von_mises", 1, {}}, J{"J", 1, {}};
  for (const Vec3& x : mesh.points) {
    const double r2 = x[0] * x[0] + x[1] * x[1],
                 down = depth_mm * std::exp(-r2 / 40) * std::max(0.0, (x[2] + radius_mm) / (2 * radius_mm));
    for (double u : {0.1 * x[0] * down / depth_mm, 0.1 * x[1] * down / depth_mm, -down}) pressed.values.push_back(u);
    for (int c = 0; c < 3; ++c) rest.values.push_back(0);
  }
  for (const auto& t : mesh.tets) {
    const Vec3 c = 0.25 * (mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]] + mesh.points[t[3]]) - first_contact;
    von_mises.values.push_back(0.02 * std::exp(-dot(c, c) / 60) * (1 + stiffening));
    J.values.push_back(1 - 0.01 * std::exp(-dot(c, c) / 60));
  }
  fs::create_directories(folder / "frames");
  write_mesh(folder / "frames/frame_0000.vtu", mesh, {rest}, {von_mises, J});
  write_mesh(folder / "frames/frame_0001.vtu", mesh, {pressed}, {von_mises, J});
  write_text(folder / "frames.pvd",
             "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n"
             "<DataSet timestep=\"0\" part=\"0\" file=\"frames/frame_0000.vtu\"/>\n<DataSet timestep=\"2\" part=\"0\" "
             "file=\"frames/frame_0001.vtu\"/>\n"
             "</Collection>\n</VTKFile>\n");
}

void write_solve(const fs::path& folder, const TetMesh& mesh, double stiffening) {
  write_frames(folder, mesh, stiffening);
  write_text(folder / "history.csv", history_text(stiffening));
  const Json tool = {{"kind", "rod"},
                     {"radius_mm", tool_radius_mm},
                     {"aim_mm", first_contact},
                     {"axis", axis},
                     {"first_contact_mm", first_contact}};
  write_json(folder / "summary.json", {{"law", folder.filename().string()},
                                       {"parameters", {{"mu", 0.00667}}},
                                       {"smallest_J", 0.98},
                                       {"tool", tool},
                                       {"depth_mm", {{"asked", depth_mm}, {"reached", depth_mm}}}});
  write_card(folder, "solve", Json::array({check("depth reached", depth_mm, "≥ 4 mm", true)}), Json::object());
}

/// One grey pixel.
std::string tiny_png() {
  static const unsigned char bytes[] = {
      0x89, 'P', 'N',  'G', 13,   10,   26,   10,   0,    0,    0, 13, 'I', 'H', 'D', 'R', 0,   0,    0,    1,    0,    0,    0,
      1,    8,   0,    0,   0,    0,    0x3a, 0x7e, 0x9b, 0x55, 0, 0,  0,   10,  'I', 'D', 'A', 'T',  0x78, 0x9c, 0x63, 0x68, 0,
      0,    0,   0x82, 0,   0x81, 0x77, 0xcd, 0x72, 0xb6, 0,    0, 0,  0,   'I', 'E', 'N', 'D', 0xae, 0x42, 0x60, 0x82};
  return {reinterpret_cast<const char*>(bytes), sizeof bytes};
}

Json spread(double min, double one_percent, double median) {
  return {{"min", min}, {"one_percent", one_percent}, {"median", median}};
}

void write_cards(const fs::path& folder, const TetMesh& mesh) {
  write_card(folder / "labels.nii.gz", "segment", Json::array(), {{"label_names", {{"1", "kidney"}}}, {"voxels", 14137}});
  write_card(folder / "surface.vtp", "surface",
             Json::array({check("open edges", 0, "= 0", true), check("made to fail & <tell>", nullptr, "≥ 8 deg", false)}),
             {{"volume_ledger", {{"voxels_mm3", 14137.0}, {"raw_mm3", 14120.5}, {"final_mm3", 14133.2}}}});
  const Json histogram = {{"bin_deg", 10},
                          {"count", {0, 3, 50, 200, 420, 700, 900, 850, 640, 410, 230, 120, 60, 20, 5, 1, 0, 0}}};
  const Json quality = {{"dihedral_deg", spread(12.5, 20.1, 45.2)},
                        {"radius_ratio", spread(0.2, 0.4, 0.8)},
                        {"scaled_jacobian", spread(0.2, 0.3, 0.6)},
                        {"dihedral_histogram", histogram}};
  write_card(folder / "mesh.vtu", "mesh", Json::array({check("smallest dihedral angle", 12.5, "≥ 8 deg", true)}),
             {{"nodes", mesh.points.size()}, {"tets", mesh.tets.size()}, {"volume_mm3", 14133.2}, {"quality", quality}});
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const fs::path folder = argv[1];
  fs::create_directories(folder);
  constexpr int n = 12;
  const TetMesh mesh = ellipsoid(n);
  write_mesh(folder / "mesh.vtu", mesh);
  write_surface(folder / "surface.vtp", skin_of(mesh, n));
  write_text(folder / "labels.nii.gz", "");
  write_text(folder / "labels.sheet.png", tiny_png());
  write_cards(folder, mesh);
  write_solve(folder / "solve/fung_demiray", mesh, 0.25);
  write_solve(folder / "solve/neo_hookean", mesh, 0.05);
}
