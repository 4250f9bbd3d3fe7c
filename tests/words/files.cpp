// What is written is read back: NIfTI, meshes, cards' hashes.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include <palpate/card.hpp>
#include <palpate/errors.hpp>
#include <palpate/mesh_files.hpp>
#include <palpate/nifti.hpp>
#include <palpate/text_file.hpp>

using namespace palpate;
namespace fs = std::filesystem;

namespace {
class Files : public testing::Test {
 protected:
  fs::path folder = fs::temp_directory_path() / ("palpate-files-" + std::to_string(getpid()));
  void SetUp() override { fs::create_directories(folder); }
  void TearDown() override { fs::remove_all(folder); }
};
}  // namespace

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

TEST_F(Files, TruncatedNiftiIsRefused) {
  Scan scan;
  scan.grid.size = {20, 20, 20};
  scan.voxels.resize(8000);
  for (std::size_t i = 0; i < 8000; ++i) scan.voxels[i] = float((i * 2654435761u) % 1000);
  write_scan(folder / "s.nii.gz", scan);
  fs::resize_file(folder / "s.nii.gz", fs::file_size(folder / "s.nii.gz") / 2);
  EXPECT_THROW(read_scan(folder / "s.nii.gz"), Failure);
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
