// Every tool of the catalogue: gradient and Hessian of its distance, continuity, a full entry.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <unistd.h>

#include <random>

#include <solver/contact/tool.hpp>
#include <tests/verify/block_surface.hpp>

using namespace palpate::tools;

namespace palpate::tools {
/// The name of a test shows this.
void PrintTo(const Shape& tested, std::ostream* out) { *out << tested.entry.name; }
}  // namespace palpate::tools
using Eigen::Vector3d;

namespace {
/// A shape that comes from a file gets a block, edge radius and all, with its tip at the origin.
Shape ready(Shape shape) {
  if (!shape.read) return shape;
  const auto file = std::filesystem::path(testing::TempDir()) / ("palpate_every_tool_" + std::to_string(getpid()) + ".vtp");
  palpate::write_surface(file, palpate::verify::block_surface({-2, -3, 1}, {2, 3, 5}));
  shape.distance = shape.read(file);
  std::filesystem::remove(file);
  return shape;
}
std::vector<double> typical(const Shape& shape) {
  std::vector<double> values;
  for (const auto& p : shape.entry.parameters) values.push_back(p.typical);
  return values;
}
class EveryTool : public testing::TestWithParam<Shape> {};
}  // namespace

TEST_P(EveryTool, TipTouchesTheOrigin) {
  const Shape shape = ready(GetParam());
  const auto d = shape.distance(Vector3d::Zero(), typical(shape));
  EXPECT_LE(std::abs(d.g), 1e-12);
  EXPECT_LE((d.n + Vector3d::UnitZ()).norm(), 1e-12);
}

TEST_P(EveryTool, GradientAndHessianNearTheSurface) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> side(-1, 1);
  const Shape shape = ready(GetParam());
  const auto p = typical(shape);
  const double h = 1e-5;
  int tried = 0;
  while (tried < 400) {
    const double reach = tried < 200 ? 4 : 12;  // mm: the tip, then what lies around it
    const Vector3d x = reach * Vector3d(side(random), side(random), side(random));
    const auto d = shape.distance(x, p);
    if (d.g < -0.1 || d.g > 1) continue;
    bool smooth = true;  // not across a seam of the shape's pieces, where the Hessian jumps
    Eigen::Matrix3d numeric;
    for (int k = 0; k < 3; ++k) {
      const auto plus = shape.distance(x + h * Vector3d::Unit(k), p), minus = shape.distance(x - h * Vector3d::Unit(k), p);
      smooth = smooth && (plus.hessian - minus.hessian).norm() < 0.1;
      EXPECT_LE(std::abs((plus.g - minus.g) / (2 * h) - d.n(k)), 1e-5);
      numeric.col(k) = (plus.n - minus.n) / (2 * h);
    }
    EXPECT_LE(std::abs(d.n.norm() - 1), 1e-12);
    if (smooth) {
      EXPECT_LE((numeric - d.hessian).norm(), 1e-6 * (1 + d.hessian.norm()));
    }
    ++tried;
  }
}

TEST_P(EveryTool, EntryIsComplete) {
  const auto& entry = GetParam().entry;
  EXPECT_EQ(entry.kind, "tool");
  EXPECT_FALSE(entry.sentence.empty() || entry.reference.empty());
  for (const auto& p : entry.parameters) {
    EXPECT_FALSE(p.name.empty() || p.unit.empty() || p.meaning.empty()) << p.name;
    EXPECT_TRUE(p.range.contains(p.typical)) << p.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Catalogue, EveryTool, testing::ValuesIn(all()), [](const auto& instance) { return instance.param.entry.name; });
