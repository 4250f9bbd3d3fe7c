// What is so from the start: pre-stress in a uniaxial test and at rest, a ball that is stiffer (Eshelby 1957), an organ that is thinner.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <solver/implicit/steps.hpp>
#include <tests/verify/shapes.hpp>

using namespace palpate;
using namespace palpate::verify;

namespace {

const double mu = 0.0067;

/// As a case begins: every sub-tetrahedron at its centroid.
void begin(implicit::Model& model, const std::string& name, const std::vector<double>& parameters) {
  const auto effect = effect_named(name);
  model.starts.resize(model.tets.size());
  for (std::size_t t = 0; t < model.tets.size(); ++t) {
    const auto centroids = elements::sub_centroids(implicit::corners(model, model.tets[t]));
    for (int s = 0; s < 4; ++s) effect.start.begin(centroids.col(s), parameters, model.starts[t][s]);
  }
}

implicit::State solve(const implicit::Model& model, int steps, Eigen::VectorXd& residual) {
  implicit::NewtonLimits limits;
  limits.tolerance = 1e-11;
  implicit::Equilibrium equilibrium(model, 1, limits);
  implicit::State state = implicit::rest_state(model);
  for (int i = 1; i <= steps; ++i) {
    const auto found = equilibrium.find(state, double(i) / steps);
    if (!found) throw std::runtime_error(equilibrium.trouble().cause);
    residual = found->equations.residual;
  }
  return state;
}

/// Nominal stress of a unit block at a stretch along x.
double pulled(implicit::Model model, double stretch) {
  for (int c = 0; c < 3; ++c) hold(model, c, [c](const Vector3d& x) { return x(c) < 1e-9; });
  hold(model, 0, [](const Vector3d& x) { return x.x() > 1 - 1e-9; }, stretch - 1);
  Eigen::VectorXd residual;
  solve(model, 4, residual);
  double sum = 0;
  for (std::size_t i = 0; i < model.points.size(); ++i)
    if (model.points[i].x() > 1 - 1e-9) sum += residual(4 * i);
  return sum;
}

implicit::Model unit_block(const char* law, std::vector<double> parameters) {
  auto model = brick(uniform(0, 1, 2), uniform(0, 1, 2), uniform(0, 1, 2));
  model.materials = {material(law, std::move(parameters))};
  return model;
}

}  // namespace

/// P = (μ exp(b (I1 − 3)) + p)(λ − 1/λ²): with F S0 of the initial stress S0 = p I and the fluid's pressure −p cof F, the sides free.
TEST(Prestress, UniaxialAddsPTimesTheStretch) {
  const double b = 1.3;
  for (double p_kPa : {0.0, 2.0, 10.0})
    for (double l : {0.7, 1.5}) {
      auto model = unit_block("fung_demiray", {mu, b});
      begin(model, "prestress", {p_kPa});
      const double expected = (mu * std::exp(b * (l * l + 2 / l - 3)) + 1e-3 * p_kPa) * (l - 1 / (l * l));
      EXPECT_LE(std::abs(pulled(model, l) / expected - 1), 1e-8) << p_kPa << " kPa at " << l;
    }
}

/// With the geometry not updated: E = 3 (μ + p) for an incompressible law.
TEST(Prestress, SmallStrain) {
  auto model = unit_block("hooke_linear", {3 * mu, 0.5});
  begin(model, "prestress", {4});
  EXPECT_LE(std::abs(pulled(model, 1.1) / (3 * (mu + 0.004) * 0.1) - 1), 1e-8);
}

TEST(Prestress, NothingMovesAtRest) {
  auto model = unit_block("neo_hookean", {mu});
  model.materials[0].bulk_modulus = 0.02;  // of a law that could give way
  begin(model, "prestress", {50});
  hold(model, 2, [](const Vector3d& x) { return x.z() < 1e-9; });
  for (int c : {0, 1}) hold(model, c, [c](const Vector3d& x) { return x(c) < 1e-9; });
  Eigen::VectorXd residual;
  EXPECT_LE(solve(model, 1, residual).nodal.norm(), 1e-12);
}

/// Strain inside a ball r times as stiff over the strain far away, ν = ½: 1/(1 + ⅖ (r − 1)) (Eshelby 1957, eq. 3.16: β = ⅖). An eighth of
/// a cube, ball of radius 1 in half a side of 5: what is left of the boundary's influence is of the order of the volume's part, 0.4 %.
double strain_inside(double ratio, int fine, int coarse) {
  const auto line = graded(1.2, fine, 5, coarse);
  auto model = brick(line, line, line);
  model.materials = {material("hooke_linear", {3 * mu, 0.5})};
  begin(model, "inclusion", {ratio - 1, 0, 0, 0, 1, 0.4 / fine});
  const Vector3d strain(1e-3, -0.5e-3, -0.5e-3);
  for (std::size_t i = 0; i < model.points.size(); ++i)
    for (int c = 0; c < 3; ++c)
      if (model.points[i](c) < 1e-9 || (model.points[i].array() > 5 - 1e-9).any()) model.prescribed.push_back({int(i), c, strain(c) * model.points[i](c)});
  model.prescribed.push_back({int(model.points.size()) - 1, 3, 0});  // all of the boundary is prescribed: the pressure has a constant
  Eigen::VectorXd residual;
  const auto state = solve(model, 1, residual);
  double sum = 0, volume = 0;
  for (std::size_t t = 0; t < model.tets.size(); ++t) {
    if (implicit::centroid(model, t).norm() > 0.6) continue;
    const auto rest = elements::tetrahedron(implicit::corners(model, model.tets[t]));
    for (int a = 0; a < 4; ++a) sum += rest.volume * state.displacement(model.tets[t][a]).x() * rest.gradients(0, a);
    volume += rest.volume;
  }
  return sum / volume / strain.x();
}

TEST(Inclusion, ABallStrainsAsEshelbySays) {
  for (double ratio : {0.2, 3.0, 20.0}) {
    const double expected = 1 / (1 + 0.4 * (ratio - 1));
    const double coarse = strain_inside(ratio, 4, 4), fine = strain_inside(ratio, 8, 6);
    std::printf("  ratio %g: strain inside %.4f, finer %.4f, Eshelby %.4f\n", ratio, coarse, fine, expected);
    EXPECT_LE(std::abs(fine / expected - 1), 0.05);  // the ball is a staircase of tetrahedra of 0.15 of its radius
  }
}
