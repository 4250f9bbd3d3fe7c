// What meshes differ by, as directions of the curve's own error, and where it goes in the curve of a clamp at rest.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include <loop/forward/clamp.hpp>
#include <loop/forward/clamp_errors.hpp>
#include <loop/forward/laws.hpp>

using Eigen::MatrixXd, Eigen::VectorXd;
using namespace palpate::loop;

namespace {

/// Three meshes at one site: their size differs by 4 %, and each is bent over the closure a little.
MatrixXd three_meshes() {
  MatrixXd apart(forms_of_site, 3);
  for (Eigen::Index i = 0; i < apart.rows(); ++i) {
    const double x = form_places[i % form_places.size()];
    apart.row(i) << 0.04 + 0.01 * std::sin(6 * x), -0.01 - 0.01 * x, 0;
    apart(i, 2) = -apart(i, 0) - apart(i, 1);
  }
  return apart;
}

/// Squares of the unit deviations that make `form`.
double cost(const MatrixXd& directions, const VectorXd& form) {
  const VectorXd z = directions.completeOrthogonalDecomposition().solve(form);
  EXPECT_LE((directions * z - form).norm(), 0.05 * form.norm());
  return z.squaredNorm();
}

}  // namespace

TEST(ClampErrors, WhatMeshesDifferByIsLikely) {
  const MatrixXd apart = three_meshes(), directions = own_errors(apart);
  for (Eigen::Index mesh = 0; mesh < 3; ++mesh) EXPECT_LE(cost(directions, apart.col(mesh)), 3) << mesh;
  VectorXd jagged = apart.col(0);  // as large, but no mesh does it
  for (Eigen::Index i = 0; i < jagged.size(); ++i) jagged(i) *= i % 2 ? 1 : -1;
  EXPECT_GT((directions.completeOrthogonalDecomposition().solve(jagged)).squaredNorm(), 10 * cost(directions, apart.col(0)));
}

TEST(ClampErrors, DeviationsAreThoseOfTheMeshes) {
  const MatrixXd apart = three_meshes();
  const VectorXd told = own_errors(apart).rowwise().squaredNorm(), own = apart.rowwise().squaredNorm() / 2;
  for (Eigen::Index i = 0; i < told.size(); ++i) EXPECT_NEAR(told(i), 4.0 / 3 * (0.75 * own(i) + 0.25 * own.mean()), 0.03 * own.mean()) << i;
}

TEST(ClampErrors, DragGoesAtRestAndFrictionStays) {
  ClampCurves curves;
  curves.deepest_mm = 10, curves.small_N = 1e-6;
  curves.parameters = {0.25};
  ClampSite site;
  site.force = {{0, 10, {0, 11}}, {0, 10, {0, 9}}};
  site.friction = {{1}, {{{0, 10, {0.2, 0.2}}, {0, 10, {-0.2, -0.2}}}}};
  Tissue tissue;
  tissue.law = &law_named("neo_hookean");
  tissue.parameters = {0.25};
  const std::vector<double> t = {0, 1, 2, 3, 4, 5}, u = {0, 3, 6, 6, 6, 2};
  const auto frictionless = clamp_force(curves, site, tissue, {}, {t, u});
  EXPECT_NEAR(frictionless[2], 6.6, 1e-4);
  EXPECT_NEAR(frictionless[4], 6.0, 1e-4);
  EXPECT_NEAR(frictionless[5], 1.8, 1e-4);
  tissue.friction = 1;
  EXPECT_NEAR(clamp_force(curves, site, tissue, {}, {t, u})[4], 6.0 * std::exp(0.2), 1e-4);
}
