// A case's material (the bulk modulus by kappa or by D1, stiffening by D2 and D3), its loads and its tools, and what is refused.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <fstream>

#include <palpate/errors.hpp>
#include <solver/case.hpp>
#include <tests/verify/block_surface.hpp>
#include <tests/verify/organs.hpp>
#include <tests/verify/shapes.hpp>
#include <tests/words/temporary_folder.hpp>

using namespace palpate;

namespace {

const std::string base = R"(
[base]
plane = { point_mm = [0.0, 0.0, 0.01], normal = [0.0, 0.0, 1.0] }
)";
const std::string ball = R"(
[tool]
kind = "ball"
radius_mm = 3.0
aim_mm = [0.1, 0.2, 5.0]
axis = [0.0, 0.0, -1.0]
depth_mm = 1.0
)";
const std::string top = "plane = { point_mm = [0.0, 0.0, 4.99], normal = [0.0, 0.0, -1.0] }\n";

class CaseFile : public InFolder {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    const auto model = verify::brick(verify::uniform(-5, 5, 2), verify::uniform(-5, 5, 2), verify::uniform(0, 5, 2));
    write_mesh(folder / "mesh.vtu", verify::mesh_of(model));
  }

  Case read_whole(const std::string& material, const std::string& rest) const {
    const auto path = folder / "case.toml";
    std::ofstream(path) << "schema = \"palpate-case/1\"\n[material]\n" << material << rest;
    return read_case(path, "");
  }
  elements::Material read(const std::string& material) const { return read_whole(material, base + ball).model.materials.front(); }

  /// What a misuse says; empty when it is accepted.
  std::string refusal(const std::string& material, const std::string& rest = base + ball) const {
    try {
      read_whole(material, rest);
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

TEST_F(CaseFile, D1IsTwoOverKappa) {
  EXPECT_DOUBLE_EQ(read(mooney_rivlin + "D1 = 0.25\n").bulk_modulus, read(mooney_rivlin + "kappa = 8.0\n").bulk_modulus);
  EXPECT_DOUBLE_EQ(read(yeoh + "D1 = 0.25\n").bulk_modulus, 8);
  EXPECT_FALSE(std::isfinite(read(mooney_rivlin).bulk_modulus));
}

TEST_F(CaseFile, D2AndD3StiffenTheVolume) {
  const auto both = read(yeoh + "D1 = 0.25\nD2 = 0.5\nD3 = 4.0\n"), third = read(yeoh + "kappa = 8.0\nD3 = 4.0\n");
  EXPECT_EQ(both.volume_stiffening, (std::array<double, 2>{2, 0.25}));
  EXPECT_EQ(third.volume_stiffening, (std::array<double, 2>{0, 0.25}));
}

TEST_F(CaseFile, WhatDoesNotGoTogetherIsRefused) {
  EXPECT_TRUE(says(refusal(mooney_rivlin + "D1 = 0.25\nkappa = 8.0\n"), "given twice"));
  EXPECT_TRUE(says(refusal(yeoh + "D2 = 0.25\n"), "D2 without D1"));
  EXPECT_TRUE(says(refusal(mooney_rivlin + "D1 = 0.25\nD2 = 1.0\n"), "D2"));
  EXPECT_TRUE(says(refusal(neo_hookean + "D1 = 0.25\n"), "D1"));
  EXPECT_TRUE(says(refusal(yeoh + "D1 = 0.0\n"), "D1"));
  EXPECT_TRUE(says(refusal(fibres + "side_x = 2\nside_y = 4\nside_z = 0\n"), "plane is not defined"));
  EXPECT_EQ(refusal(fibres + "side_x = 2\nside_y = 3\nside_z = 0\n"), "");
}

TEST_F(CaseFile, LoadsOfEveryKind) {
  const Case c = read_whole(yeoh, base + "[gravity]\ndirection = [0, 0, -1]\nsteps = 2\n[[force]]\ntotal_N = [0, 0, 0.3]\npath = [[0, 0], [3, 2]]\n" + top +
                                      "[[spring]]\nstiffness_N_mm3 = 0.01\n" + top);
  EXPECT_EQ(c.settling.times, (std::vector<double>{-1, -0.5, 0}));
  EXPECT_EQ(c.steps.times.back(), 3);
  double total = 0, stiffness = 0;
  for (const auto& f : c.model.nodal_forces) total += f.value.z() * c.model.amplitudes[f.amplitude].at(3);
  for (const auto& s : c.model.springs) stiffness += s.stiffness;
  EXPECT_NEAR(total, 0.6, 1e-12);
  EXPECT_NEAR(stiffness, 0.01 * 100, 0.01 * 100);  // the top's rim belongs to the sides too
  EXPECT_GE(stiffness, 0.01 * 100);
  EXPECT_NEAR(c.model.gravity.z(), -9.81, 1e-12);
}

TEST_F(CaseFile, APathPressesAndLifts) {
  const Case c = read_whole(yeoh, base + "[tool]\nkind = \"ball\"\nradius_mm = 3.0\naim_mm = [0.1, 0.2, 5.0]\naxis = [0, 0, -1]\npath = [[0, 0], [2, 1.5], [4, 0.5]]\n");
  EXPECT_EQ(c.model.tools[0].travel(1), 0.75);
  EXPECT_EQ(c.model.tools[0].travel(3), 1.0);
  EXPECT_EQ(c.steps.times.back(), 4);
}

TEST_F(CaseFile, StepsEndWhereTheyAreToldAndAtCornersOfPaths) {
  const std::string pressing = "[tool]\nkind = \"ball\"\nradius_mm = 3.0\naim_mm = [0.1, 0.2, 5.0]\naxis = [0, 0, -1]\npath = [[0, 0], [1, 1.5], [4, 0.5]]\n";
  EXPECT_EQ(read_whole(yeoh, base + pressing + "[steps]\ncount = 2\n").steps.times, (std::vector<double>{0, 1, 2, 4}));
  EXPECT_EQ(read_whole(yeoh, base + pressing + "[steps]\ntimes_s = [0.5, 3]\n").steps.times, (std::vector<double>{0, 0.5, 3}));
  for (const char* times : {"[]", "[1, 0.5]", "[0, 1]", "[1, nan]", "[1]\ncount = 3"})
    EXPECT_NE(refusal(yeoh, base + pressing + "[steps]\ntimes_s = " + times + "\n"), "") << times;
}

TEST_F(CaseFile, EffectsGoIntoTheMaterialsOfTheirRegion) {
  const std::string two = "[[effect]]\nname = \"mullins\"\ninverse_r = 0.2\nm = 0.001\n[[effect]]\nname = \"prony\"\ng = [0.2, 0.1]\ntau_s = [1, 20]\n";
  const auto effects = read_whole(yeoh, base + ball + two).model.materials.front().effects;
  ASSERT_EQ(effects.size(), 2);
  EXPECT_EQ(effects[0].effect.entry.name, "mullins");
  EXPECT_EQ(effects[1].parameters, (std::vector<double>{0.2, 1, 0.1, 20}));
  EXPECT_EQ(effects[1].memory_at, 1);
  for (const char* prony : {"g = []\ntau_s = []", "g = [0.2]\ntau_s = [1, 2]", "g = [0.6, 0.5]\ntau_s = [1, 2]", "g = [0.2, nan]\ntau_s = [1, 2]",
                            "g = 0.2\ntau_s = 0", "g = 0.2\ntau_s = 1\nregion = \"liver\""})
    EXPECT_NE(refusal(yeoh, base + ball + "[[effect]]\nname = \"prony\"\n" + prony + "\n"), "") << prony;
}

TEST_F(CaseFile, EffectsOfEverySocketGoWhereTheyBelong) {
  const auto with = [](const std::string& effect) { return "[[effect]]\n" + effect + "\n"; };
  const std::string lump = "name = \"inclusion\"\nexcess = 3\nx_mm = 0\ny_mm = 0\nz_mm = 2.5\nradius_mm = 4\n";
  const Case c = read_whole(neo_hookean, base + ball + with("name = \"capsule\"\nE_h = 0.02\n" + top) + with("name = \"capsule\"\nE_h = 0.01\ntension = 0.1") +
                                             with("name = \"friction\"\nmu = 0.2\ntool = 1") + with("name = \"adhesion\"\nwork = 0\nrange_mm = 1") +
                                             with("name = \"support\"\nstiffness = 0.01\n" + top) + with("name = \"prestress\"\np_kPa = 2") + with(lump));
  ASSERT_EQ(c.model.layers.size(), 2u);
  EXPECT_EQ(c.model.layers[0].faces.size(), 8u);
  EXPECT_EQ(c.model.layers[1].faces.size(), c.model.faces.size());
  EXPECT_EQ(c.model.layers[0].parameters, (std::vector<double>{0.02, 0}));
  EXPECT_EQ(c.settling.times.size(), 5u);
  ASSERT_EQ(c.model.tools[0].tractions.size(), 1u);  // adhesion is off
  EXPECT_TRUE(c.model.tools[0].holds_on());
  double area = 0;
  for (const auto& point : c.model.region_forces.at(0).points) {
    area += point.area;
    EXPECT_LE((point.normal - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
  }
  EXPECT_NEAR(area, 100, 1e-9);
  EXPECT_NEAR(c.model.starts.at(0)[0].turgor, 0.002, 1e-15);
  double stiffest = 0;
  for (const auto& tet : c.model.starts)
    for (const auto& start : tet) stiffest = std::max(stiffest, start.modulus);
  EXPECT_EQ(stiffest, 4);
  EXPECT_EQ(read_whole(neo_hookean, ball + with("name = \"support\"\nstiffness = 0.01\n" + top)).base.size(), 0);  // holds it alone
}

TEST_F(CaseFile, ThicknessMapsTheRestShapeAndNotThePatches) {
  const Case c = read_whole(neo_hookean, base + ball + "[[effect]]\nname = \"thickness\"\nexcess = -0.4\naxis_x = 0\naxis_y = 0\naxis_z = 2\n"
                                                       "[[pressure]]\npressure_MPa = 0.001\n" + top);
  const Case plain = read_whole(neo_hookean, base + ball + "[[pressure]]\npressure_MPa = 0.001\n" + top);
  for (std::size_t i = 0; i < c.model.points.size(); ++i)
    EXPECT_LE((c.model.points[i] - plain.model.points[i].cwiseProduct(Eigen::Vector3d(1, 1, 0.6))).norm(), 1e-14);
  EXPECT_EQ(rest_mesh(c).points[20][2], c.model.points[20].z());
  EXPECT_EQ(c.model.pressures[0].faces, plain.model.pressures[0].faces);
  EXPECT_NEAR(c.model.tools[0].first_contact.z(), 3, 0.01);
}

TEST_F(CaseFile, EffectsThatAreRefused) {
  const auto why = [&](const std::string& effect) { return refusal(neo_hookean, base + ball + "[[effect]]\n" + effect + "\n"); };
  EXPECT_TRUE(says(why("name = \"capsul\"\nE_h = 1"), "capsule"));
  EXPECT_TRUE(says(why("name = \"capsule\"\nE_h = 1\ntensoin = 1"), "tension"));
  EXPECT_TRUE(says(why("name = \"capsule\"\nE_h = 1\nregion = \"block\""), "region"));
  EXPECT_TRUE(says(why("name = \"support\"\nstiffness = 1"), "plane, box, label"));
  EXPECT_TRUE(says(why("name = \"adhesion\"\nwork = 1\nrange_mm = 1\ntool = 2"), "tool"));
  EXPECT_TRUE(says(why("name = \"inclusion\"\nexcess = 1\nx_mm = 90\ny_mm = 0\nz_mm = 0\nradius_mm = 2"), "changes nothing"));
  EXPECT_TRUE(says(why("name = \"thickness\"\nexcess = 1\naxis_x = 0\naxis_y = 0\naxis_z = 0"), "no direction"));
}

TEST_F(CaseFile, LoadsThatAreRefused) {
  EXPECT_NE(refusal(yeoh, ball).find("nothing holds"), std::string::npos);
  EXPECT_NE(refusal(yeoh, base).find("nothing moves"), std::string::npos);
  EXPECT_NE(refusal(yeoh, base + "[[force]]\ntotal_N = [0, 0, 1]\npath = [[0, 0], [0, 1]]\n" + top).find("ascend"), std::string::npos);
  for (const char* path : {"[[0, 0], [1, nan]]", "[[0, 0], [1, 2], [2, inf]]", "[[nan, 0], [1, 1]]"})
    EXPECT_NE(refusal(yeoh, base + "[[force]]\ntotal_N = [0, 0, 1]\npath = " + path + "\n" + top).find("not finite"), std::string::npos) << path;
  EXPECT_NE(refusal(yeoh, base + "[[force]]\ntotal_N = [0, 0, 1]\npath = [[-1, 0], [1, 1]]\n" + top).find("before t = 0"), std::string::npos);
  EXPECT_NE(refusal(yeoh, base + "[[displacement]]\nmotion_mm = [0, 0, 1]\nplane = { point_mm = [0, 0, 9], normal = [0, 0, 1] }\n").find("held or moved"),
            std::string::npos);
  EXPECT_NE(refusal("region = \"liver\"\n" + yeoh).find("liver"), std::string::npos);
}

TEST_F(CaseFile, AToolIsTurnedByAcross) {
  const std::string box = R"(
[tool]
kind = "box"
width_mm = 2.0
length_mm = 20.0
height_mm = 5.0
edge_radius_mm = 0.5
aim_mm = [0.1, 0.2, 5.0]
axis = [0.0, 0.0, -1.0]
depth_mm = 1.0
)";
  const auto tool = read_whole(neo_hookean, base + box + "across = [0.0, 3.0, 1.0]\n").model.tools.front();
  EXPECT_LE((tool.frame().col(0) - Eigen::Vector3d::UnitY()).norm(), 1e-15);  // as far as it is at right angles to the axis
  EXPECT_NEAR(tool.first_contact.z(), 5, 1e-3);
  EXPECT_TRUE(says(refusal(neo_hookean, base + box + "across = [0.0, 0.0, 2.0]\n"), "across points along"));
}

TEST_F(CaseFile, AToolFromAFileLiesBesideTheCase) {
  write_surface(folder / "block.vtp", verify::block_surface({-2, -3, 7}, {2, 3, 9}));
  const std::string tool = R"(
[tool]
kind = "surface"
edge_radius_mm = 0.5
aim_mm = [0.1, 0.2, 5.0]
axis = [0.0, 0.0, -1.0]
depth_mm = 1.0
)";
  const std::string file = "file = \"block.vtp\"\n";
  const auto the_case = read_whole(neo_hookean, base + tool + file);
  EXPECT_NEAR(the_case.model.tools.front().first_contact.z(), 5, 1e-3);
  ASSERT_EQ(the_case.tool_files.size(), 1u);
  EXPECT_EQ(the_case.tool_files[0], folder / "block.vtp");
  EXPECT_TRUE(says(refusal(neo_hookean, base + tool), "file"));
  EXPECT_TRUE(says(refusal(neo_hookean, base + ball + file), "file"));  // a ball has none
}

TEST_F(CaseFile, ContactIsBetweenRegionsOfTheMesh) {
  auto two = verify::brick(verify::uniform(-5, 5, 2), verify::uniform(-5, 5, 2), verify::uniform(0, 5, 2));
  const int tets = two.tets.size(), faces = two.faces.size();
  auto upper = two;
  for (auto& x : upper.points) x.z() += 6;
  verify::append(two, upper);
  auto mesh = verify::mesh_of(two);
  for (std::size_t t = tets; t < mesh.tets.size(); ++t) mesh.tet_region[t] = 2;
  mesh.region_names = {{1, "lower"}, {2, "upper"}};
  write_mesh(folder / "mesh.vtu", mesh);
  const auto with = [&](const std::string& contact) { return base + ball + "[[contact]]\n" + contact; };
  const auto between = read_whole(neo_hookean, with("between = [\"lower\", \"upper\"]\n"));
  ASSERT_EQ(between.model.passes.size(), 2u);
  EXPECT_EQ(between.model.passes[0].own.size(), faces);
  EXPECT_EQ(between.model.passes[0].own, between.model.passes[1].other);
  EXPECT_FALSE(between.model.passes[0].joined);
  const auto self = read_whole(neo_hookean, with("self = \"upper\"\n"));
  ASSERT_EQ(self.model.passes.size(), 1u);
  EXPECT_TRUE(self.model.passes[0].joined);
  EXPECT_EQ(self.model.passes[0].own.front(), faces);
  EXPECT_TRUE(says(refusal(neo_hookean, with("between = [\"lower\", \"lower\"]\n")), "two regions"));
  EXPECT_TRUE(says(refusal(neo_hookean, with("between = [\"lower\", \"tube\"]\n")), "tube"));
  EXPECT_TRUE(says(refusal(neo_hookean, with("self = \"tube\"\n")), "tube"));
  const std::string once = "between = [\"lower\", \"upper\"]\n", again = "[[contact]]\nbetween = [\"upper\", \"lower\"]\n";
  EXPECT_TRUE(says(refusal(neo_hookean, with(once + "friction = 0.2\n" + again)), "given twice"));
  EXPECT_TRUE(says(refusal(neo_hookean, with(once + "friction = 0.2\nsticking = true\n")), "what touches sticks"));
  EXPECT_EQ(read_whole(neo_hookean, with(once + "friction = 0.2\nsticking = false\n[[contact]]\nself = \"upper\"\n")).model.passes.size(), 3u);
  EXPECT_TRUE(says(refusal(neo_hookean, with("")), "two regions or of one with itself"));
}

TEST_F(CaseFile, PressureForceControlAndTurns) {
  const auto pressed = read_whole(neo_hookean, base + "[[pressure]]\npressure_MPa = 0.001\n" + top);
  ASSERT_EQ(pressed.model.pressures.size(), 1u);
  EXPECT_EQ(pressed.model.pressures[0].faces.size(), 8u);  // 2 x 2 cells, two triangles each
  EXPECT_EQ(pressed.model.pressures[0].value, 0.001);
  EXPECT_TRUE(says(refusal(neo_hookean, base + "[[pressure]]\n" + top), "pressure_MPa"));
  const std::string rod = "[tool]\nkind = \"rod\"\naim_mm = [0.1, 0.2, 5.0]\naxis = [0.0, 0.0, -1.0]\nradius_mm = 2.0\n";
  const auto loaded = read_whole(neo_hookean, base + rod + "control = \"force\"\npath = [[0, 0], [2, 0.05], [4, 0.05]]\n");
  EXPECT_TRUE(loaded.model.tools[0].force_controlled);
  EXPECT_NEAR(loaded.model.tools[0].force * loaded.model.tools[0].ramp.at(1), 0.025, 1e-15);
  EXPECT_EQ(loaded.steps.times.back(), 4);
  EXPECT_TRUE(says(refusal(neo_hookean, base + rod + "control = \"force\"\ndepth_mm = 2.0\n"), "force_N"));
  const auto turned = read_whole(neo_hookean, base + rod + "depth_mm = 1.0\nturn = { about = [0, 2, 0], from_tip_mm = [0, 0, 9], path = [[0, 0], [3, 90]] }\n");
  EXPECT_NEAR(turned.model.tools[0].turn.at(1.5), M_PI / 4, 1e-12);
  EXPECT_EQ(turned.model.tools[0].spin, Eigen::Vector3d::UnitY());
  EXPECT_EQ(turned.steps.times.back(), 3);
  EXPECT_TRUE(says(refusal(neo_hookean, base + rod + "depth_mm = 1.0\nturn = { about = [0, 2, 0], path = [[0, 10], [3, 90]] }\n"), "0 degrees"));
}
