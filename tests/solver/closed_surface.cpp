// Distances to closed triangle surfaces: against the box tool, a search over all triangles, and an inside known by hand; what is refused.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <map>
#include <random>

#include <palpate/errors.hpp>
#include <solver/contact/closed_surface.hpp>
#include <solver/implicit/steps.hpp>
#include <tests/verify/block_surface.hpp>
#include <tests/verify/shapes.hpp>
#include <tests/words/temporary_folder.hpp>

using namespace palpate;
using Eigen::Vector3d;

namespace {

using Points = std::vector<Vector3d>;
using Triangles = std::vector<std::array<int, 3>>;

/// A column over a polygon (counter-clockwise) in x and y, z from 0 to height: caps as given triangles, sides in two each.
std::pair<Points, Triangles> column(const std::vector<std::array<double, 2>>& polygon, const Triangles& cap, double height) {
  Points points;
  Triangles triangles;
  const int n = polygon.size();
  for (double z : {0.0, height})
    for (const auto& p : polygon) points.emplace_back(p[0], p[1], z);
  for (const auto& t : cap) {
    triangles.push_back({t[0], t[2], t[1]});
    triangles.push_back({n + t[0], n + t[1], n + t[2]});
  }
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    triangles.push_back({i, j, n + j});
    triangles.push_back({i, n + j, n + i});
  }
  return {points, triangles};
}

/// [0,4]×[0,2] and [0,2]×[2,4], 3 mm high: a corner that points inward.
std::pair<Points, Triangles> angle_iron() {
  return column({{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}, 3);
}

/// An octahedron cut `times` over, its points on the sphere of radius R.
std::pair<Points, Triangles> sphere(double R, int times) {
  Points points = {{R, 0, 0}, {-R, 0, 0}, {0, R, 0}, {0, -R, 0}, {0, 0, R}, {0, 0, -R}};
  Triangles triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int i = 0; i < times; ++i) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [it, fresh] = middles.insert({std::minmax(a, b), int(points.size())});
      if (fresh) points.push_back(R * (points[a] + points[b]).normalized());
      return it->second;
    };
    Triangles finer;
    for (const auto& [a, b, c] : triangles) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (const auto& t : Triangles{{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}) finer.push_back(t);
    }
    triangles = finer;
  }
  return {points, triangles};
}

std::string refusal(const Points& points, const Triangles& triangles) {
  try {
    contact::ClosedSurface(points, triangles, "tool.vtp");
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::unreadable);
    return failure.what();
  }
  return "";
}

void expect_says(const std::string& text, const std::string& words) { EXPECT_NE(text.find(words), std::string::npos) << text; }

class SurfaceTool : public InFolder {};

}  // namespace

TEST_F(SurfaceTool, GrownBlockIsTheBox) {  // a core of 8 × 18 × 4 mm grown by 1 mm is the box of 10 × 20 × 6 mm; its place along z is free
  write_surface(folder / "block.vtp", verify::block_surface({-4, -9, 31}, {4, 9, 35}));
  const auto grown = verify::tool_named("surface").read(folder / "block.vtp");
  const auto box = verify::tool_named("box");
  const std::vector<double> r = {1}, sizes = {10, 20, 6, 1};
  std::mt19937 random(3);
  std::uniform_real_distribution<double> side(-14, 14);
  for (int i = 0; i < 2000; ++i) {
    const Vector3d x(side(random), side(random), side(random));
    const auto d = grown(x, r), exact = box.distance(x, sizes);
    EXPECT_LE(std::abs(d.g - exact.g), 1e-12);
    EXPECT_LE((d.n - exact.n).norm(), 1e-11);
    EXPECT_LE((d.hessian - exact.hessian).norm(), 1e-10);
  }
}

TEST_F(SurfaceTool, SphereOfTrianglesPressesLikeABall) {  // 8192 triangles of the sphere of 1.5 mm, grown by 1.5 mm
  const auto [points, triangles] = sphere(1.5, 5);
  Surface surface;
  for (const auto& p : points) surface.points.push_back({p.x(), p.y(), p.z()});
  surface.triangles = triangles;
  surface.triangle_region.assign(triangles.size(), 1);
  write_surface(folder / "sphere.vtp", surface);
  auto shape = verify::tool_named("surface");
  shape.distance = shape.read(folder / "sphere.vtp");
  std::vector<double> forces;
  for (const auto& [tool, parameters] : {std::pair(shape, std::vector<double>{1.5}), std::pair(verify::tool_named("ball"), std::vector<double>{3})}) {
    auto model = verify::brick(verify::uniform(-5, 5, 6), verify::uniform(-5, 5, 6), verify::uniform(0, 6, 4));
    model.materials = {verify::material("neo_hookean", {0.0067})};
    for (int c = 0; c < 3; ++c) verify::hold(model, c, [](const Vector3d& x) { return x.z() < 1e-9; });
    model.tools = {contact::Tool{tool, parameters, -Vector3d::UnitZ(), {0.1, 0.2, 6}, 1.5, {}}};
    implicit::Equilibrium equilibrium(model, 1);
    implicit::State state = implicit::rest_state(model);
    int iterations = 0, cuts = 0;
    const double reached = implicit::run_steps(equilibrium, state, {verify::uniform(0, 1, 6), 6}, [&](const implicit::Step& step) {
      iterations += step.iterations;
      cuts += step.cuts;
      if (step.index == 6) forces.push_back(-step.equations.contact.tools[0].force.z());
    });
    std::printf("  %s: %d iterations, %d cuts\n", tool.entry.name.c_str(), iterations, cuts);
    ASSERT_EQ(reached, 1) << equilibrium.trouble().cause;
  }
  std::printf("  force of the triangles %.6f N, of the ball %.6f N\n", forces[0], forces[1]);
  EXPECT_GT(forces[1], 0);
  EXPECT_LE(std::abs(forces[0] / forces[1] - 1), 0.01);  // measured −0.2 %
}

TEST(ClosedSurface, SignAndDistanceOfABodyWithAnInwardCorner) {
  const auto [points, triangles] = angle_iron();
  const contact::ClosedSurface surface(points, triangles, "");
  std::mt19937 random(5);
  std::uniform_real_distribution<double> side(-2, 6);
  for (int i = 0; i < 3000; ++i) {
    const Vector3d x(side(random), side(random), side(random));
    const bool inside = x.minCoeff() > 0 && x.z() < 3 && ((x.x() < 4 && x.y() < 2) || (x.x() < 2 && x.y() < 4));
    double squared = 1e9;
    for (const auto& t : triangles) squared = std::min(squared, contact::nearest_on_triangle(x, {points[t[0]], points[t[1]], points[t[2]]}).squared_distance);
    EXPECT_LE(std::abs(surface.distance(x).g - (inside ? -1 : 1) * std::sqrt(squared)), 1e-12) << x.transpose();
  }
}

/// By central differences away from seams, on faces, edges and corners; inside, only the edges at the inward corner bend it.
TEST(ClosedSurface, HessianIsTheChangeOfTheNormalOnBothSides) {
  const auto [points, triangles] = angle_iron();
  const contact::ClosedSurface surface(points, triangles, "");
  std::mt19937 random(13);
  std::uniform_real_distribution<double> side(-2, 6);
  constexpr double h = 1e-5;
  int bent[2] = {0, 0};  // outside, inside
  for (int i = 0; i < 9000; ++i) {
    const Vector3d x(side(random), side(random), side(random));
    const auto d = surface.distance(x);
    bool smooth = std::abs(d.g) > 0.1;
    Eigen::Matrix3d numeric;
    for (int k = 0; k < 3; ++k) {
      const auto plus = surface.distance(x + h * Vector3d::Unit(k)), minus = surface.distance(x - h * Vector3d::Unit(k));
      smooth = smooth && (plus.n - minus.n).norm() < 1e-3 && (plus.hessian - minus.hessian).norm() < 0.05;
      numeric.col(k) = (plus.n - minus.n) / (2 * h);
    }
    if (!smooth) continue;
    EXPECT_LE((numeric - d.hessian).norm(), 1e-6 * (1 + d.hessian.norm())) << x.transpose();
    bent[d.g < 0] += d.hessian.norm() > 0;
  }
  EXPECT_GT(bent[0], 500);
  EXPECT_GT(bent[1], 20);
}

TEST(ClosedSurface, NearestPointOfATriangleIsTheNearestOfItsPoints) {
  const std::array<Vector3d, 3> corners = {Vector3d(0, 0, 0), Vector3d(5, 0, 0.5), Vector3d(-1, 0.8, 0)};  // obtuse
  std::mt19937 random(11);
  std::uniform_real_distribution<double> side(-4, 7);
  for (int i = 0; i < 300; ++i) {
    const Vector3d x(side(random), side(random), side(random));
    const double found = std::sqrt(contact::nearest_on_triangle(x, corners).squared_distance);
    double sampled = 1e9;
    constexpr int n = 60;
    for (int a = 0; a <= n; ++a)
      for (int b = 0; a + b <= n; ++b)
        sampled = std::min(sampled, (x - (a * corners[0] + b * corners[1] + (n - a - b) * corners[2]) / n).norm());
    EXPECT_LE(found, sampled + 1e-12);
    EXPECT_GE(found, sampled - 6.2 / n);  // no sample is farther from its neighbours than the longest side / n
  }
}

TEST(ClosedSurface, FineSphereIsNearlyABall) {
  const double R = 5;
  const auto [points, triangles] = sphere(R, 4);  // 2048 triangles of about 0.55 mm: they lie up to h²/(8 R)·4/3 within the sphere
  const contact::ClosedSurface surface(points, triangles, "");
  std::mt19937 random(7);
  std::uniform_real_distribution<double> side(-8, 8);
  double worst = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector3d x(side(random), side(random), side(random));
    worst = std::max(worst, std::abs(surface.distance(x).g - (x.norm() - R)));
  }
  std::printf("  worst difference to the ball %.4f mm of radius %g mm\n", worst, R);
  EXPECT_LE(worst, 0.03);
}

TEST(ClosedSurface, WhatHasNoInsideIsRefusedWithItsPlace) {
  const auto [points, triangles] = angle_iron();
  auto open = triangles, turned = triangles, doubled = triangles, inverted = triangles, flat = triangles;
  open.pop_back();
  std::swap(turned[0][0], turned[0][1]);
  doubled.push_back(doubled[0]);
  for (auto& t : inverted) std::swap(t[0], t[1]);
  flat[0][2] = flat[0][1];
  EXPECT_EQ(refusal(points, triangles), "");
  expect_says(refusal(points, open), "is open");
  expect_says(refusal(points, open), "tool.vtp at (0, ");
  expect_says(refusal(points, turned), "opposite ways");
  expect_says(refusal(points, doubled), "3 triangles share an edge");
  expect_says(refusal(points, inverted), "inside out");
  expect_says(refusal(points, flat), "no area");
  expect_says(refusal(points, {}), "no triangles");
}

TEST(ClosedSurface, TwoSkinsThatTouchInAPointAreRefused) {
  Points points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  const Triangles triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}, {0, 4, 5}, {0, 6, 4}, {0, 5, 6}, {4, 6, 5}};
  expect_says(refusal(points, triangles), "touch in a point");
}
