// Thick sphere of incompressible neo-Hookean, inner wall pushed out: P = 2μ[1/λb + 1/(4λb⁴) − 1/λa − 1/(4λa⁴)] taken positive,
// λb³ = 1 + (λa³ − 1)(A/B)³. (Green and Zerna 1968, §3.10.)
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <solver/implicit/equilibrium.hpp>
#include <tests/verify/shapes.hpp>

using namespace palpate;
using namespace palpate::verify;

namespace {

constexpr double mu = 0.01, A = 1, B = 2;

double exact_pressure(double la) {
  const double lb = std::cbrt(1 + (la * la * la - 1) * std::pow(A / B, 3));
  return 2 * mu * std::abs(1 / lb + 1 / (4 * std::pow(lb, 4)) - 1 / la - 1 / (4 * std::pow(la, 4)));
}

/// Largest relative error of the inner pressure up to λa = 1.8. The pressure is the virtual work of the inner wall's reaction over
/// the rate of the swept volume: with every inner node moving radially by X/A, Σ f·X/A = P dV/dλ' and V = (π/6) a³ of the octant.
double worst_error(int n, int layers) {
  auto model = thick_sphere_octant(A, B, n, layers);
  model.materials = {material("neo_hookean", {mu})};
  for (int c = 0; c < 3; ++c)
    hold(model, c, [c](const Vector3d& x) { return std::abs(x(c)) < 1e-9 && x.norm() > A * (1 + 1e-9); });
  std::vector<int> inner;
  for (std::size_t i = 0; i < model.points.size(); ++i)
    if (model.points[i].norm() < A * (1 + 1e-9)) {
      inner.push_back(i);
      for (int c = 0; c < 3; ++c) model.prescribed.push_back({int(i), c, 0.8 * model.points[i](c)});
    }
  // The discrete cavity is a polyhedron: its volume over a³ is what the pressure works on.
  double cavity = 0;
  for (const auto& f : model.faces) {
    bool wall = true;
    for (int node : f) wall = wall && model.points[node].norm() < A * (1 + 1e-9);
    if (wall) cavity += std::abs(model.points[f[0]].cross(model.points[f[1]]).dot(model.points[f[2]])) / 6;
  }
  implicit::Equilibrium equilibrium(model, 2);
  implicit::State state = implicit::rest_state(model);
  double worst = 0;
  for (int step = 1; step <= 8; ++step) {
    const double load = step / 8.0, la = 1 + 0.8 * load;
    const auto found = equilibrium.find(state, load);
    if (!found) throw std::runtime_error(equilibrium.trouble().cause);
    double work = 0;
    for (int node : inner) work += found->equations.residual.segment<3>(4 * node).dot(model.points[node]);
    const double pressure = work / (3 * la * la * cavity);
    const double error = std::abs(pressure / exact_pressure(la) - 1);
    if (!(error <= worst)) worst = error;
  }
  return worst;
}

}  // namespace

TEST(ThickSphere, PressureWithinOnePercentAndFalling) {
  const double coarse = worst_error(4, 4), middle = worst_error(8, 8), fine = worst_error(14, 12);
  std::printf("  worst error of the pressure: %.3f %%, %.3f %%, %.3f %%\n", 100 * coarse, 100 * middle, 100 * fine);
  EXPECT_LE(fine, 0.01);
  EXPECT_LT(fine, middle);
  EXPECT_LT(middle, coarse);
}
