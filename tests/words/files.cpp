// What is written is read back: NIfTI, meshes, cards' hashes.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <fstream>

#include <palpate/card.hpp>
#include <palpate/errors.hpp>
#include <palpate/mesh_files.hpp>
#include <palpate/nifti.hpp>
#include <palpate/text_file.hpp>

#include <tests/words/temporary_folder.hpp>

using namespace palpate;
namespace fs = std::filesystem;

class Files : public InFolder {};

TEST_F(Files, NiftiKeepsValuesAndObliqueFrame) {
  Scan scan;
  scan.grid.size = {3, 4, 5};
  scan.grid.lps_from_voxel = {{Vec3{0.48, 0.64, 0}, Vec3{-1.2, 0.9, 0}, Vec3{0, 0, 2.5}}, {-10, 20.5, 33}};
  for (std::size_t i = 0; i < scan.grid.count(); ++i) scan.voxels.push_back(i * 0.5f - 7);
  write_scan(folder / "s.nii.gz", scan);
  const Scan read = read_scan(folder / "s.nii.gz");
  EXPECT_EQ(read.voxels, scan.voxels);
  EXPECT_EQ(read.grid.size, scan.grid.size);
  for (int a = 0; a < 3; ++a) EXPECT_LE(norm(read.grid.lps_from_voxel.columns[a] - scan.grid.lps_from_voxel.columns[a]), 1e-6);
  EXPECT_LE(norm(read.grid.lps_from_voxel.origin - scan.grid.lps_from_voxel.origin), 1e-5);
}

TEST_F(Files, NiftiReadsTheFileItWasGiven) {  // not its uncompressed neighbour
  Scan scan{{{2, 2, 2}, {}}, {1, 2, 3, 4, 5, 6, 7, 8}}, other{scan.grid, {8, 7, 6, 5, 4, 3, 2, 1}};
  write_scan(folder / "scan.nii", other);
  write_scan(folder / "scan.nii.gz", scan);
  EXPECT_EQ(read_scan(folder / "scan.nii.gz").voxels, scan.voxels);
  EXPECT_EQ(read_scan(folder / "scan.nii").voxels, other.voxels);
}

TEST_F(Files, TruncatedNiftiIsRefused) {
  Scan scan;
  scan.grid.size = {20, 20, 20};
  scan.voxels.resize(8000);
  for (std::size_t i = 0; i < 8000; ++i) scan.voxels[i] = float((i * 2654435761u) % 1000);
  write_scan(folder / "s.nii.gz", scan);
  fs::resize_file(folder / "s.nii.gz", fs::file_size(folder / "s.nii.gz") / 2);
  EXPECT_THROW(read_scan(folder / "s.nii.gz"), Failure);
}

TEST_F(Files, ShearedNiftiKeepsItsFrame) {
  Labels labels;
  labels.grid.size = {2, 2, 2};
  labels.grid.lps_from_voxel = {{Vec3{0.5, 0, 0}, Vec3{0, 0.5, 0}, Vec3{0, 0.8, 2.5}}, {1, 2, 3}};
  labels.voxels = {0, 1, 2, 3, 4, 5, 6, 65535};
  write_labels(folder / "l.nii", labels);
  const Labels read = read_labels(folder / "l.nii");
  EXPECT_EQ(read.voxels, labels.voxels);
  EXPECT_LE(norm(read.grid.lps_from_voxel.columns[2] - labels.grid.lps_from_voxel.columns[2]), 1e-6);
}

TEST_F(Files, EveryCutOfANiftiIsRefused) {
  Scan scan;
  scan.grid.size = {7, 5, 3};
  scan.voxels.assign(105, 1.5f);
  for (const char* name : {"s.nii", "s.nii.gz"}) {
    write_scan(folder / name, scan);
    const auto size = fs::file_size(folder / name);
    for (std::uintmax_t kept : {size - 1, size - 9, size / 2, std::uintmax_t{352}, std::uintmax_t{40}, std::uintmax_t{0}}) {
      if (kept >= size) continue;
      fs::copy_file(folder / name, folder / (std::string("cut-") + name), fs::copy_options::overwrite_existing);
      fs::resize_file(folder / (std::string("cut-") + name), kept);
      EXPECT_THROW(read_scan(folder / (std::string("cut-") + name)), Failure) << name << " cut to " << kept;
    }
  }
}

TEST_F(Files, EveryCutOfAMeshIsRefused) {
  TetMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1.25}};
  mesh.tets = {{0, 1, 2, 3}};
  mesh.tet_region = {1};
  Surface surface{mesh.points, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}, {1, 1, 1, 1}, {}};
  write_mesh(folder / "m.vtu", mesh);
  write_surface(folder / "s.vtp", surface);
  for (const char* name : {"m.vtu", "s.vtp"}) {
    const std::string whole = read_text(folder / name);
    for (std::size_t kept = 0; kept + 24 < whole.size(); kept += whole.size() / 40) {
      write_text(folder / (std::string("cut-") + name), whole.substr(0, kept));
      if (std::string(name) == "m.vtu")
        EXPECT_THROW(read_mesh(folder / "cut-m.vtu"), Failure) << kept << " of " << whole.size();
      else
        EXPECT_THROW(read_surface(folder / "cut-s.vtp"), Failure) << kept << " of " << whole.size();
    }
  }
}

TEST_F(Files, FullDiskIsTold) {  // /dev/full takes nothing
  for (const char* name : {"s.nii", "s.nii.gz", "m.vtu", "s.vtp", "t.json"}) fs::create_symlink("/dev/full", folder / name);
  EXPECT_THROW(write_scan(folder / "s.nii", Scan{{{1, 1, 1}, {}}, {0}}), Failure);
  EXPECT_THROW(write_labels(folder / "s.nii.gz", Labels{{{1, 1, 1}, {}}, {0}}), Failure);
  EXPECT_THROW(write_mesh(folder / "m.vtu", TetMesh{{{0, 0, 0}}, {}, {}, {}, {}, {}}), Failure);
  EXPECT_THROW(write_surface(folder / "s.vtp", Surface{{{0, 0, 0}}, {}, {}, {}}), Failure);
  EXPECT_THROW(write_json(folder / "t.json", {{"a", 1}}), Failure);
}

TEST_F(Files, TextThatIsNotUtf8DoesNotStopACard) {
  write_json(folder / "card.json", {{"series", "caf\xe9"}});
  EXPECT_EQ(read_json(folder / "card.json").at("series"), "caf\uFFFD");
}

TEST_F(Files, SpoiltMeshIsRefused) {
  TetMesh mesh;
  for (int i = 0; i < 400; ++i) mesh.points.push_back({std::sin(1.0 * i), std::cos(2.0 * i), 0.1 * i});
  for (int i = 0; i + 3 < 400; ++i) mesh.tets.push_back({i, i + 1, i + 2, i + 3});
  mesh.tet_region.assign(mesh.tets.size(), 1);
  write_mesh(folder / "m.vtu", mesh);
  std::string bytes = read_text(folder / "m.vtu");
  EXPECT_EQ(read_mesh(folder / "m.vtu").tets.size(), mesh.tets.size());
  bytes.replace(bytes.size() * 6 / 10, 40, std::string(40, 'x'));
  write_text(folder / "spoilt.vtu", bytes);
  EXPECT_THROW(read_mesh(folder / "spoilt.vtu"), Failure);
}

TEST_F(Files, MeshKeepsCellsRegionsAndFields) {
  TetMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1.25}};
  mesh.tets = {{0, 1, 2, 3}};
  mesh.tet_region = {4};
  mesh.faces = {{0, 2, 1}};
  mesh.face_region = {7};
  mesh.region_names = {{4, "kidney"}, {7, "base"}};
  write_mesh(folder / "m.vtu", mesh, {{"pressure", 1, {1, 2, 3, 4}}}, {{"J", 1, {0.5}}});
  const TetMesh read = read_mesh(folder / "m.vtu");
  EXPECT_EQ(read.points, mesh.points);
  EXPECT_EQ(read.tets, mesh.tets);
  EXPECT_EQ(read.tet_region, mesh.tet_region);
  EXPECT_EQ(read.faces, mesh.faces);
  EXPECT_EQ(read.face_region, mesh.face_region);
  EXPECT_EQ(read.region_names, mesh.region_names);
  EXPECT_EQ(read_mesh_fields(folder / "m.vtu").on_points.at(0).values, (std::vector<double>{1, 2, 3, 4}));
}

TEST_F(Files, Sha256OfKnownText) {  // FIPS 180-2, appendix B.1
  write_text(folder / "abc", "abc");
  EXPECT_EQ(sha256(folder / "abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST_F(Files, ChecksRefuseNaN) {
  EXPECT_FALSE(check_at_most("x", std::nan(""), 1).pass);
  EXPECT_FALSE(check_at_least("x", std::nan(""), 1).pass);
}
