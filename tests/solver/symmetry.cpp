// Planes of symmetry in a case: what they keep, and what is refused.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <fstream>

#include <palpate/errors.hpp>
#include <solver/case.hpp>
#include <solver/export/calculix.hpp>
#include <tests/verify/organs.hpp>
#include <tests/verify/shapes.hpp>
#include <tests/words/temporary_folder.hpp>

using namespace palpate;

namespace {

std::string symmetry(const std::string& point, const std::string& normal) {
  return "[[symmetry]]\nplane = { point_mm = " + point + ", normal = " + normal + " }\n";
}

const std::string three_planes = symmetry("[0, 9, 9]", "[1, 0, 0]") + symmetry("[9, 2, 9]", "[0, -1, 0]") + symmetry("[9, 9, 0]", "[0, 0, 3]");
const std::string top = "plane = { point_mm = [0.0, 0.0, 2.99], normal = [0.0, 0.0, -1.0] }\n";
const std::string pushed = "[[pressure]]\npressure_MPa = 0.004\n" + top;

/// An eighth of a block, [0, 2] x [0, 2] x [0, 3] mm.
class Symmetric : public InFolder {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    write_mesh(folder / "mesh.vtu", verify::mesh_of(verify::brick(verify::uniform(0, 2, 2), verify::uniform(0, 2, 2), verify::uniform(0, 3, 3))));
  }
  Case read(const std::string& rest) const {
    std::ofstream(folder / "case.toml") << "schema = \"palpate-case/1\"\n[material]\nlaw = \"neo_hookean\"\nmu = 0.0067\n" << rest;
    return read_case(folder / "case.toml", "");
  }
  std::string refusal(const std::string& rest) const {
    try {
      read(rest);
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.code(), ExitCode::misuse);
      return failure.what();
    }
    return "";
  }
};

}  // namespace

/// Uniaxial compression, as nothing but the planes holds it: p = mu (1/l − l²), and faces stay where symmetry has them.
TEST_F(Symmetric, APressedBlockIsUniaxial) {
  const Case c = read(three_planes + pushed + "[steps]\ncount = 4\n");
  EXPECT_TRUE(c.base.empty());
  implicit::Equilibrium equilibrium(c.model, 1);
  implicit::State state = implicit::rest_state(c.model);
  ASSERT_EQ(run_steps(equilibrium, state, c.steps, [](const implicit::Step&) {}), 1);
  double least = 0;
  for (std::size_t i = 0; i < c.model.points.size(); ++i) {
    const auto& x = c.model.points[i];
    const Eigen::Vector3d u = state.displacement(i);
    if (x.x() == 0) {
      EXPECT_EQ(u.x(), 0);
    }
    if (x.y() == 2) {
      EXPECT_EQ(u.y(), 0);
    }
    if (x.z() == 0) {
      EXPECT_EQ(u.z(), 0);
    }
    least = std::min(least, u.z());
  }
  const double stretch = 1 + least / 3;
  ASSERT_LT(stretch, 0.9);
  EXPECT_NEAR(0.0067 * (1 / stretch - stretch * stretch), 0.004, 1e-8);
}

/// What holds or moves a node goes before the plane that it lies on too; no component is prescribed twice.
TEST_F(Symmetric, WhatIsHeldOnItIsHeld) {
  const std::string base = "[base]\nplane = { point_mm = [0.0, 0.0, 0.01], normal = [0.0, 0.0, 1.0] }\n";
  const Case c = read(symmetry("[0, 0, 0]", "[1, 0, 0]") + symmetry("[0, 0, 0]", "[0, 1, 0]") + base + "[[displacement]]\nmotion_mm = [0, 0, -0.5]\n" + top);
  std::set<std::pair<int, int>> seen;
  for (const auto& p : c.model.prescribed) EXPECT_TRUE(seen.insert({p.node, p.component}).second);
  EXPECT_EQ(c.base.size(), 9u);
  // 9 nodes below and 9 above with three components; on each of two levels between them 3 of each plane.
  EXPECT_EQ(seen.size(), 3u * 18 + 2 * 6);
}

TEST_F(Symmetric, Refusals) {
  const std::string one = symmetry("[0, 0, 0]", "[1, 0, 0]");
  EXPECT_EQ(refusal(one + pushed), "");
  EXPECT_NE(refusal(symmetry("[0, 0, 0]", "[1, 0.1, 0]") + pushed).find("right angles to x, y or z"), std::string::npos);
  EXPECT_NE(refusal(symmetry("[1, 0, 0]", "[1, 0, 0]") + pushed).find("goes through its plane of symmetry"), std::string::npos);
  EXPECT_NE(refusal(symmetry("[0, 0, 0]", "[-1, 0, 0]") + pushed).find("turn the normal"), std::string::npos);
  EXPECT_NE(refusal(symmetry("[-1, 0, 0]", "[1, 0, 0]") + pushed).find("0 nodes"), std::string::npos);
  EXPECT_NE(refusal(one + "[[displacement]]\nmotion_mm = [0.1, 0, -0.5]\n" + top).find("off the plane of symmetry"), std::string::npos);
}

/// An edge from one plane to another lies in neither: its middle is free, in quadratic elements.
TEST_F(Symmetric, CalculixHoldsNoMiddleBetweenTwoPlanes) {
  const std::string input = calculix::input(read(three_planes + pushed), 1000);
  const auto begin = input.find("*BOUNDARY"), end = input.find("*END STEP");
  ASSERT_NE(begin, std::string::npos);
  // Of each plane all corners and middles of the quadratic faces, a component each: 5 x 5 of z, 5 x 7 of x and of y.
  const std::string lines = input.substr(begin, end - begin);
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 1 + 25 + 35 + 35);
}
