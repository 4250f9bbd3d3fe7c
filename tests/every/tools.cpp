// Every tool of the catalogue: gradient and Hessian of its distance, continuity, a full entry.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <random>

#include <solver/contact/tool.hpp>

using namespace palpate::tools;
using Eigen::Vector3d;

namespace {
std::vector<double> typical(const Shape& shape) {
  std::vector<double> values;
  for (const auto& p : shape.entry.parameters) values.push_back(p.typical);
  return values;
}
class EveryTool : public testing::TestWithParam<Shape> {};
}  // namespace

TEST_P(EveryTool, TipTouchesTheOrigin) {
  const auto d = GetParam().distance(Vector3d::Zero(), typical(GetParam()));
  EXPECT_LE(std::abs(d.g), 1e-12);
  EXPECT_LE((d.n + Vector3d::UnitZ()).norm(), 1e-12);
}

TEST_P(EveryTool, GradientAndHessianNearTheSurface) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> side(-4, 4);
  const auto p = typical(GetParam());
  const double h = 1e-5;
  int tried = 0;
  while (tried < 200) {
    const Vector3d x(side(random), side(random), side(random));
    const auto d = GetParam().distance(x, p);
    if (d.g < -0.1 || d.g > 1) continue;
    bool smooth = true;  // not across a seam of the shape's pieces, where the Hessian jumps
    Eigen::Matrix3d numeric;
    for (int k = 0; k < 3; ++k) {
      const auto plus = GetParam().distance(x + h * Vector3d::Unit(k), p), minus = GetParam().distance(x - h * Vector3d::Unit(k), p);
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
  EXPECT_FALSE(entry.sentence.empty() || entry.reference.empty() || entry.parameters.empty());
}

INSTANTIATE_TEST_SUITE_P(Catalogue, EveryTool, testing::ValuesIn(all()), [](const auto& instance) { return instance.param.entry.name; });
