// Uniaxial, equibiaxial and simple shear of an incompressible block, every law, against the closed form.
// With principal stretches: nominal stress of a uniaxial test P = (σ1 − σ2)/λ, of an equibiaxial test P = (σ1 − σ3)/λ, where
// σi − σj = λi ∂W/∂λi − λj ∂W/∂λj (Ogden 1984, eq. 4.3.47).
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <solver/implicit/equilibrium.hpp>
#include <tests/verify/shapes.hpp>

using namespace palpate;
using namespace palpate::verify;

namespace {

struct ClosedForm {
  const char* law;
  std::vector<double> parameters;
  double (*uniaxial)(double, const std::vector<double>&);
  double (*equibiaxial)(double, const std::vector<double>&);
  double (*shear)(double, const std::vector<double>&);  ///< Cauchy shear stress at amount of shear k
};

const double E_mu = 3;  // E = 3 μ for ν = ½

std::vector<ClosedForm> closed_forms() {
  using V = const std::vector<double>&;
  return {
      {"neo_hookean", {0.0067}, [](double l, V p) { return p[0] * (l - 1 / (l * l)); },
       [](double l, V p) { return p[0] * (l - std::pow(l, -5)); }, [](double k, V p) { return p[0] * k; }},
      {"mooney_rivlin", {0.083, 0.0565}, [](double l, V p) { return 2 * (p[0] + p[1] / l) * (l - 1 / (l * l)); },
       [](double l, V p) { return 2 * (p[0] + p[1] * l * l) * (l - std::pow(l, -5)); }, [](double k, V p) { return 2 * (p[0] + p[1]) * k; }},
      {"fung_demiray", {0.0067, 1.3},
       [](double l, V p) { return p[0] * std::exp(p[1] * (l * l + 2 / l - 3)) * (l - 1 / (l * l)); },
       [](double l, V p) { return p[0] * std::exp(p[1] * (2 * l * l + std::pow(l, -4) - 3)) * (l - std::pow(l, -5)); },
       [](double k, V p) { return p[0] * std::exp(p[1] * k * k) * k; }},
      {"hooke", {0.02, 0.5}, [](double l, V p) { return p[0] * std::log(l) / l; },
       [](double l, V p) { return 2 * p[0] * std::log(l) / l; },
       // Hencky in simple shear: principal stretch λ with λ − 1/λ = k; σ1 − σ2 = 2 μ (ln λ1 − ln λ2) = 4 μ ln λ, and the principal
       // axes of b give σ12 = ½ (σ1 − σ2) sin 2θ with sin 2θ = 2/√(4 + k²).
       [](double k, V p) { return 4 * p[0] / E_mu * std::asinh(k / 2) / std::sqrt(4 + k * k); }},
      {"hooke_linear", {0.02, 0.5}, [](double l, V p) { return p[0] * (l - 1); }, [](double l, V p) { return 2 * p[0] * (l - 1); },
       [](double k, V p) { return p[0] / E_mu * k; }},
  };
}

/// Unit block; reaction of the nodes at x = 1 in direction `component`.
struct Block {
  implicit::Model model = brick(uniform(0, 1, 2), uniform(0, 1, 2), uniform(0, 1, 2));
  void symmetric() {
    for (int c = 0; c < 3; ++c) hold(model, c, [c](const Vector3d& x) { return x(c) < 1e-9; });
  }
  double reaction(const ClosedForm& form, int component) {
    model.materials = {material(form.law, form.parameters)};
    implicit::NewtonLimits limits;
    limits.tolerance = 1e-12;
    implicit::Equilibrium equilibrium(model, 1, limits);
    implicit::State state = implicit::rest_state(model);
    std::optional<implicit::Found> found;
    for (double load : {0.25, 0.5, 0.75, 1.0}) {
      found = equilibrium.find(state, load);
      if (!found) throw std::runtime_error(equilibrium.trouble().cause);
    }
    double sum = 0;
    for (std::size_t i = 0; i < model.points.size(); ++i)
      if (model.points[i].x() > 1 - 1e-9) sum += found->equations.residual(4 * i + component);
    return sum;
  }
};

}  // namespace

TEST(Homogeneous, Uniaxial) {
  for (const auto& form : closed_forms())
    for (double stretch : {0.6, 0.9, 1.2, 1.6}) {
      Block block;
      block.symmetric();
      hold(block.model, 0, [](const Vector3d& x) { return x.x() > 1 - 1e-9; }, stretch - 1);
      const double P = form.uniaxial(stretch, form.parameters);
      EXPECT_LE(std::abs(block.reaction(form, 0) - P), 1e-8 * std::abs(P)) << form.law << " " << stretch;
    }
}

TEST(Homogeneous, Equibiaxial) {
  for (const auto& form : closed_forms())
    for (double stretch : {0.8, 1.1, 1.35}) {
      Block block;
      block.symmetric();
      for (int c : {0, 1}) hold(block.model, c, [c](const Vector3d& x) { return x(c) > 1 - 1e-9; }, stretch - 1);
      const double P = form.equibiaxial(stretch, form.parameters);
      EXPECT_LE(std::abs(block.reaction(form, 0) - P), 1e-8 * std::abs(P)) << form.law << " " << stretch;
    }
}

TEST(Homogeneous, SimpleShear) {  // displacement prescribed on the whole boundary, so σ12 is read from a face of unit area normal to y
  for (const auto& form : closed_forms())
    for (double k : {0.1, 0.5, 0.9}) {
      Block block;
      auto& model = block.model;
      for (std::size_t i = 0; i < model.points.size(); ++i) {
        const auto& x = model.points[i];
        const bool inside = (x.array() > 1e-9).all() && (x.array() < 1 - 1e-9).all();
        if (!inside)
          for (int c = 0; c < 3; ++c) model.prescribed.push_back({int(i), c, c == 1 ? k * x.x() : 0});
      }
      const double shear = form.shear(k, form.parameters);
      // All of the boundary is prescribed: a finite bulk modulus fixes the pressure's constant and, at J = 1, changes nothing else.
      elements::Material m = material(form.law, form.parameters);
      m.bulk_modulus = 100 * m.shear_modulus();
      model.materials = {m};
      implicit::NewtonLimits limits;
      limits.tolerance = 1e-12;
      implicit::Equilibrium equilibrium(model, 1, limits);
      implicit::State state = implicit::rest_state(model);
      std::optional<implicit::Found> found;
      for (double load : {0.5, 1.0}) ASSERT_TRUE(found = equilibrium.find(state, load)) << form.law;
      // Force in y on the face x = 1; the interior of the face's edge nodes is shared with other faces, so integrate by virtual work:
      // u_y = k x is conjugate to P_21, whose power over the unit cube is Σ f_y x.
      double power = 0;
      for (std::size_t i = 0; i < model.points.size(); ++i) power += found->equations.residual(4 * i + 1) * model.points[i].x();
      EXPECT_LE(std::abs(power - shear), 1e-8 * shear) << form.law << " " << k;
    }
}
