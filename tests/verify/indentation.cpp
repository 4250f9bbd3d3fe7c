// Rigid tools on a bonded incompressible layer at small strain, a quarter by symmetry.
//  ball:  F = 16/9 E √R δ^1.5 (1 + 1.133χ + 1.283χ² + 0.769χ³ + 0.0975χ⁴), χ = √(Rδ)/h (Dimitriadis et al. 2002, Biophys. J. 82:2798, eq. 14)
//  punch: F = 8 a μ δ on a half-space (Sneddon 1965); a bonded layer of height h stiffens it: the far field of the same image as
//         in Dimitriadis' first term gives F = 8 a μ δ/(1 − 1.133 a/h).
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <solver/implicit/equilibrium.hpp>
#include <tests/verify/shapes.hpp>

using namespace palpate;
using namespace palpate::verify;

namespace {

constexpr double E = 0.02;

/// Quarter of a layer, its top at z = 0, bonded below, symmetric at x = 0 and y = 0, free at the far sides.
implicit::Model quarter_layer(const std::vector<double>& along, const std::vector<double>& down) {
  std::vector<double> z;
  for (auto it = down.rbegin(); it != down.rend(); ++it) z.push_back(-*it);
  auto model = brick(along, along, z);
  model.materials = {material("hooke_linear", {E, 0.5})};
  const double bottom = z.front();
  for (int c = 0; c < 3; ++c) hold(model, c, [bottom](const Vector3d& x) { return x.z() < bottom + 1e-9; });
  for (int c : {0, 1}) hold(model, c, [c, bottom](const Vector3d& x) { return x(c) < 1e-9 && x.z() > bottom + 1e-9; });
  std::erase_if(model.faces, [&](const auto& f) {
    return std::any_of(f.begin(), f.end(), [&](int node) { return model.points[node].z() < -1e-9; });
  });
  return model;
}

double dimitriadis(double R, double delta, double h) {
  const double x = std::sqrt(R * delta) / h;
  return 16.0 / 9 * E * std::sqrt(R) * std::pow(delta, 1.5) * (1 + 1.133 * x + 1.283 * x * x + 0.769 * x * x * x + 0.0975 * std::pow(x, 4));
}

/// Force of the whole tool at each of `steps` equal depths.
std::vector<double> forces(const implicit::Model& model, int steps) {
  implicit::Equilibrium equilibrium(model, 2);
  implicit::State state = implicit::rest_state(model);
  std::vector<double> list;
  for (int i = 1; i <= steps; ++i) {
    const auto found = equilibrium.find(state, double(i) / steps);
    if (!found) throw std::runtime_error(equilibrium.trouble().cause);
    list.push_back(-4 * found->equations.contact.force.z());
  }
  return list;
}

}  // namespace

TEST(Indentation, BallOnABondedLayer) {
  const double h = 1, R = 50, deepest = 0.25 * h * h / R;  // χ = 0.5
  auto model = quarter_layer(graded(0.6, 14, 4, 7), graded(0.5, 7, 1, 3));
  model.tool = contact::Tool{tool_named("ball"), {R}, -Vector3d::UnitZ(), Vector3d::Zero(), deepest};
  const int steps = 4;
  const auto measured = forces(model, steps);
  for (int i = 0; i < steps; ++i) {
    const double delta = deepest * (i + 1) / steps, exact = dimitriadis(R, delta, h), chi = std::sqrt(R * delta) / h;
    std::printf("  chi %.3f: force %.6e, Dimitriadis %.6e, %+.2f %%\n", chi, measured[i], exact, 100 * (measured[i] / exact - 1));
    if (i > 0) {
      EXPECT_LE(std::abs(measured[i] / exact - 1), 0.02);
    }
  }
}

TEST(Indentation, FlatPunch) {
  const double a = 1, h = 20, delta = 1e-4, mu = E / 3;
  const auto force = [&](int n) {
    auto model = quarter_layer(graded(a, n, h, n + 2), graded(a, n, h, n + 2));
    model.tool = contact::Tool{tool_named("flat_punch"), {a, 1e-3}, -Vector3d::UnitZ(), Vector3d::Zero(), delta};
    return forces(model, 1).back();
  };
  const double exact = 8 * a * mu * delta / (1 - 1.133 * a / h);
  const double coarse = force(3), middle = force(5), fine = force(7);
  // First-order in the mesh size (the pressure is singular at the edge): F(h) = F + c/n.
  const double extrapolated = (7 * fine - 5 * middle) / 2;
  std::printf("  punch: %.4f %.4f %.4f of Sneddon's, extrapolated %.4f\n", coarse / exact, middle / exact, fine / exact, extrapolated / exact);
  EXPECT_LE(std::abs(extrapolated / exact - 1), 0.03);
}
