// Effect `thickness` on solids in closed form: a column that is (1 + excess) times as long along the axis has λ = 1 + d/((1 + excess) H), across it
// has (1 + excess) times the section. Neo-Hookean. Sides free, ν = ½: N/A = μ (λ − 1/λ²). Confined, J = λ:
// N/A = ⅔ μ (λ^⅓ − λ^(−5/3)) + κ (λ − 1), of W = μ/2 (J^(−⅔) I1 − 3) + κ/2 (J − 1)². (Ogden 1997, Non-linear Elastic Deformations, section 4.2.)
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <tests/verify/case_runs.hpp>

using namespace palpate;
using namespace palpate::verify;

namespace {

constexpr double mu = 0.0067, kappa = 0.03, excess = 0.35;
const Vector3d sides(2, 3, 4);

class ThickerColumn : public CaseRuns {
 protected:
  /// The model of a case on a block of 2 × 3 × 4 mm that says it is thicker along an axis; its supports are still to be given.
  implicit::Model model(const std::string& along, const std::string& more) {
    write("[material]\nlaw = \"neo_hookean\"\nmu = 0.0067\n" + more + "[base]\nplane = { point_mm = [0.0, 0.0, 0.01], normal = [0.0, 0.0, 1.0] }\n"
          "[[displacement]]\nmotion_mm = [0, 0, -1]\nplane = { point_mm = [0.0, 0.0, 3.99], normal = [0.0, 0.0, -1.0] }\n"
          "[[effect]]\nname = \"thickness\"\nexcess = 0.35\n" + along + "x_mm = 0.4\ny_mm = 0.2\nz_mm = 1.0\n",
          mesh_of(brick(uniform(0, sides.x(), 2), uniform(0, sides.y(), 3), uniform(0, sides.z(), 3))));
    auto model = read_case(Settings::read(folder / "case.toml"), "").model;
    model.prescribed.clear();
    model.amplitudes.resize(1);
    Vector3d low = model.points.front();
    for (const auto& x : model.points) low = low.cwiseMin(x);
    for (auto& x : model.points) x -= low;
    return model;
  }

  /// Force along z on the top when that moves by `d` mm; `confined`: no side moves.
  static double force(implicit::Model model, double d, bool confined) {
    Vector3d high = Vector3d::Zero();
    for (const auto& x : model.points) high = high.cwiseMax(x);
    for (int c = 0; c < 3; ++c) {
      hold(model, c, [c](const Vector3d& x) { return x(c) < 1e-9; });
      if (confined && c < 2) hold(model, c, [c, high](const Vector3d& x) { return x(c) > high(c) - 1e-9; });
    }
    hold(model, 2, [high](const Vector3d& x) { return x.z() > high.z() - 1e-9; }, d);
    implicit::NewtonLimits limits;
    limits.tolerance = 1e-12;
    implicit::Equilibrium equilibrium(model, 1, limits);
    auto state = implicit::rest_state(model);
    std::optional<implicit::Found> found;
    for (double t : {0.25, 0.5, 0.75, 1.0})
      if (!(found = equilibrium.find(state, t))) throw std::runtime_error(equilibrium.trouble().cause);
    double sum = 0;
    for (std::size_t i = 0; i < model.points.size(); ++i)
      if (model.points[i].z() > high.z() - 1e-9) sum += found->equations.residual(4 * i + 2);
    return sum;
  }
};

const std::string along_z = "axis_x = 0\naxis_y = 0\naxis_z = -2\n", along_x = "axis_x = 1\naxis_y = 0\naxis_z = 0\n";

double free_column(double stretch) { return mu * (stretch - 1 / (stretch * stretch)); }
double confined_column(double stretch) { return 2 * mu / 3 * (std::cbrt(stretch) - std::pow(stretch, -5.0 / 3)) + kappa * (stretch - 1); }

}  // namespace

TEST_F(ThickerColumn, WithFreeSides) {
  const double area = sides.x() * sides.y(), height = sides.z();
  for (double d : {-1.2, 1.5}) {
    const double longer = area * free_column(1 + d / ((1 + excess) * height)), wider = (1 + excess) * area * free_column(1 + d / height);
    EXPECT_LE(std::abs(force(model(along_z, ""), d, false) / longer - 1), 1e-8) << d;
    EXPECT_LE(std::abs(force(model(along_x, ""), d, false) / wider - 1), 1e-8) << d;
  }
}

TEST_F(ThickerColumn, Confined) {
  const double area = sides.x() * sides.y(), height = sides.z();
  for (double d : {-1.2, 1.5}) {
    const double longer = area * confined_column(1 + d / ((1 + excess) * height)), wider = (1 + excess) * area * confined_column(1 + d / height);
    EXPECT_LE(std::abs(force(model(along_z, "kappa = 0.03\n"), d, true) / longer - 1), 1e-8) << d;
    EXPECT_LE(std::abs(force(model(along_x, "kappa = 0.03\n"), d, true) / wider - 1), 1e-8) << d;
  }
}
