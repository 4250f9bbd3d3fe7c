// Rigid tools on a bonded incompressible layer at small strain, a quarter by symmetry, against the exact force (bonded_layer.hpp).
// Dimitriadis et al. 2002 (Biophys. J. 82:2798, eq. 14) is printed beside it: 8 % too soft at χ = 0.5 (docs/decisions/020).
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <solver/implicit/equilibrium.hpp>
#include <tests/verify/bonded_layer.hpp>
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

double hertz(double R, double delta) { return 16.0 / 9 * E * std::sqrt(R) * std::pow(delta, 1.5); }
double dimitriadis_factor(double x) { return 1 + 1.133 * x + 1.283 * x * x + 0.769 * x * x * x + 0.0975 * std::pow(x, 4); }

/// Force of the whole tool at each of `steps` equal depths.
std::vector<double> forces(const implicit::Model& model, int steps) {
  implicit::Equilibrium equilibrium(model, 2);
  implicit::State state = implicit::rest_state(model);
  std::vector<double> list;
  for (int i = 1; i <= steps; ++i) {
    const auto found = equilibrium.find(state, double(i) / steps);
    if (!found) throw std::runtime_error(equilibrium.trouble().cause);
    list.push_back(-4 * found->equations.contact.tools[0].force.z());
  }
  return list;
}

}  // namespace

TEST(BondedLayer, ExactForceOfThickLayersIsTheFirstImages) {  // Dimitriadis' and Garcia and Garcia's common first term, 1.133 χ
  EXPECT_NEAR((ball_on_layer_factor(0.01) - 1) / 0.01, 1.133, 0.02);
  EXPECT_NEAR((punch_on_layer_factor(0.01) - 1) / 0.01, 1.133, 0.02);
}

TEST(BondedLayer, ExactForceOfABallIsGarciasFit) {  // Garcia and Garcia 2018, Biophys. J. 114:2923: a fit of the same problem
  for (double x : {0.1, 0.3, 0.5})
    EXPECT_NEAR(ball_on_layer_factor(x) / (1 + 1.133 * x + 1.497 * x * x + 1.469 * x * x * x + 0.755 * std::pow(x, 4)), 1, 0.01);
}

TEST(Indentation, BallOnABondedLayer) {
  const double h = 1, R = 50, deepest = 0.25 * h * h / R;  // χ = 0.5
  auto model = quarter_layer(graded(0.8, 16, 4, 8), graded(0.5, 10, 1, 5));
  model.tools = {contact::Tool{tool_named("ball"), {R}, -Vector3d::UnitZ(), Vector3d::Zero(), deepest, {}}};
  const int steps = 2;
  const auto measured = forces(model, steps);
  for (int i = 0; i < steps; ++i) {
    const double delta = deepest * (i + 1) / steps, chi = std::sqrt(R * delta) / h, factor = measured[i] / hertz(R, delta);
    const double exact = ball_on_layer_factor(chi);
    std::printf("  chi %.3f: force/Hertz %.4f, exact %.4f (%+.2f %%), Dimitriadis %.4f\n", chi, factor, exact, 100 * (factor / exact - 1),
                dimitriadis_factor(chi));
    EXPECT_LE(std::abs(factor / exact - 1), 0.02);
  }
}

TEST(Indentation, FlatPunch) {
  const double a = 1, h = 20, delta = 1e-4, mu = E / 3;
  const auto force = [&](int n) {
    auto model = quarter_layer(graded(a, n, h, n + 2), graded(a, n, h, n + 2));
    model.tools = {contact::Tool{tool_named("flat_punch"), {a, 1e-3}, -Vector3d::UnitZ(), Vector3d::Zero(), delta, {}}};
    return forces(model, 1).back() / (8 * a * mu * delta * punch_on_layer_factor(a / h));
  };
  // Meshes in the ratio 2 : 3 : 4.5; the error falls like some power of the edge length (the pressure is singular at the punch's
  // edge), which the three of them tell: Aitken 1926.
  const double coarse = force(4), middle = force(6), fine = force(9);
  const double extrapolated = fine - (middle - fine) * (middle - fine) / ((coarse - middle) - (middle - fine));
  std::printf("  punch over exact: %.4f %.4f %.4f, extrapolated %.4f, order %.2f\n", coarse, middle, fine, extrapolated,
              std::log((coarse - middle) / (middle - fine)) / std::log(1.5));
  EXPECT_LE(std::abs(extrapolated - 1), 0.03);
}
