// A case's material: the bulk modulus by kappa or by D1, stiffening by D2 and D3, and what is refused.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <fstream>

#include <palpate/errors.hpp>
#include <solver/case.hpp>
#include <tests/verify/shapes.hpp>
#include <tests/words/temporary_folder.hpp>

using namespace palpate;

namespace {

class CaseMaterial : public InFolder {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    const auto model = verify::brick(verify::uniform(-5, 5, 2), verify::uniform(-5, 5, 2), verify::uniform(0, 5, 2));
    TetMesh mesh;
    for (const auto& p : model.points) mesh.points.push_back({p.x(), p.y(), p.z()});
    mesh.tets = model.tets;
    mesh.tet_region.assign(mesh.tets.size(), 1);
    mesh.faces = model.faces;
    mesh.face_region.assign(mesh.faces.size(), 1);
    mesh.region_names = {{1, "block"}};
    write_mesh(folder / "mesh.vtu", mesh);
  }

  elements::Material read(const std::string& material) const {
    const auto path = folder / "case.toml";
    std::ofstream(path) << "schema = \"palpate-case/1\"\n[material]\n"
                        << material << R"(
[base]
plane = { point_mm = [0.0, 0.0, 0.01], normal = [0.0, 0.0, 1.0] }
[tool]
kind = "ball"
radius_mm = 3.0
aim_mm = [0.1, 0.2, 5.0]
axis = [0.0, 0.0, -1.0]
depth_mm = 1.0
)";
    return read_case(path, "").model.materials.front();
  }

  /// What a misuse says; empty when it is accepted.
  std::string refusal(const std::string& material) const {
    try {
      read(material);
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.code(), ExitCode::misuse);
      return failure.what();
    }
    return "";
  }
};

const std::string mooney_rivlin = "law = \"mooney_rivlin\"\nC10 = 0.083\nC01 = 0.0565\n";
const std::string yeoh = "law = \"yeoh\"\nC10 = 0.003\nC20 = 0.001\nC30 = 0.0\n";
const std::string neo_hookean = "law = \"neo_hookean\"\nmu = 0.0067\n";
const std::string fibres =
    "law = \"hgo\"\nmu = 0.0067\nk1 = 0.004\nk2 = 1.5\nangle_deg = 35\naxis_x = 1\naxis_y = 2\naxis_z = 0\n";

bool says(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

}  // namespace

TEST_F(CaseMaterial, D1IsTwoOverKappa) {
  EXPECT_DOUBLE_EQ(read(mooney_rivlin + "D1 = 0.25\n").bulk_modulus, read(mooney_rivlin + "kappa = 8.0\n").bulk_modulus);
  EXPECT_DOUBLE_EQ(read(yeoh + "D1 = 0.25\n").bulk_modulus, 8);
  EXPECT_FALSE(std::isfinite(read(mooney_rivlin).bulk_modulus));
}

TEST_F(CaseMaterial, D2AndD3StiffenTheVolume) {
  const auto both = read(yeoh + "D1 = 0.25\nD2 = 0.5\nD3 = 4.0\n"), third = read(yeoh + "kappa = 8.0\nD3 = 4.0\n");
  EXPECT_EQ(both.volume_stiffening, (std::array<double, 2>{2, 0.25}));
  EXPECT_EQ(third.volume_stiffening, (std::array<double, 2>{0, 0.25}));
}

TEST_F(CaseMaterial, WhatDoesNotGoTogetherIsRefused) {
  EXPECT_TRUE(says(refusal(mooney_rivlin + "D1 = 0.25\nkappa = 8.0\n"), "given twice"));
  EXPECT_TRUE(says(refusal(yeoh + "D2 = 0.25\n"), "D2 without D1"));
  EXPECT_TRUE(says(refusal(mooney_rivlin + "D1 = 0.25\nD2 = 1.0\n"), "D2"));
  EXPECT_TRUE(says(refusal(neo_hookean + "D1 = 0.25\n"), "D1"));
  EXPECT_TRUE(says(refusal(yeoh + "D1 = 0.0\n"), "D1"));
  EXPECT_TRUE(says(refusal(fibres + "side_x = 2\nside_y = 4\nside_z = 0\n"), "plane is not defined"));
  EXPECT_EQ(refusal(fibres + "side_x = 2\nside_y = 3\nside_z = 0\n"), "");
}
