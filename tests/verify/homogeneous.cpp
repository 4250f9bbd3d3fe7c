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

using V = const std::vector<double>&;

/// ∂W/∂I1 of Yeoh's law at I1 − 3 = t.
double yeoh_slope(double t, V p) { return p[0] + 2 * p[1] * t + 3 * p[2] * t * t; }

/// Σ 2 μ/α (a^α − b^α): the difference of two principal Cauchy stresses of Ogden's law with stretches a and b.
double ogden_difference(double a, double b, V p) {
  double sum = 0;
  for (int i : {0, 2, 4})
    if (p[i] != 0) sum += 2 * p[i] / p[i + 1] * (std::pow(a, p[i + 1]) - std::pow(b, p[i + 1]));
  return sum;
}

/// 2 ∂W/∂I4 of a fibre family whose squared stretch is I4: its Cauchy stress is that times (Fa) ⊗ (Fa).
double hgo_tension(double I4, V p) { return I4 > 1 ? 2 * p[1] * (I4 - 1) * std::exp(p[2] * (I4 - 1) * (I4 - 1)) : 0; }

/// Families at ± p[3] from x in the plane of x and y, stretch l along x: the stretch m along y where σ_y = σ_z = 0, by bisection
/// of σ_y − σ_z = μ (m² − 1/(l m)²) + 2 T(I4) m² sin²; then P_x = (σ_x − σ_z)/l.
double hgo_uniaxial(double l, V p) {
  const double angle = p[3] * std::acos(-1.0) / 180, cos2 = std::cos(angle) * std::cos(angle), sin2 = 1 - cos2;
  double low = 0.1, high = 10;
  for (int i = 0; i < 200; ++i) {
    const double m = 0.5 * (low + high), T = hgo_tension(l * l * cos2 + m * m * sin2, p);
    (p[0] * (m * m - 1 / (l * l * m * m)) + 2 * T * m * m * sin2 > 0 ? high : low) = m;
  }
  const double m = low, T = hgo_tension(l * l * cos2 + m * m * sin2, p);
  return (p[0] * (l * l - 1 / (l * l * m * m)) + 2 * T * l * l * cos2) / l;
}

double hgo_equibiaxial(double l, V p) {  // I4 = l², whatever the angle
  const double c = std::cos(p[3] * std::acos(-1.0) / 180);
  return p[0] * (l - std::pow(l, -5)) + 2 * hgo_tension(l * l, p) * l * c * c;
}

double hgo_shear(double k, V p) {  // u_y = k x: Fa = (c, ±s + k c), the two families differ
  const double angle = p[3] * std::acos(-1.0) / 180, c = std::cos(angle);
  double stress = p[0] * k;
  for (double s : {std::sin(angle), -std::sin(angle)})
    stress += hgo_tension(c * c + (s + k * c) * (s + k * c), p) * c * (s + k * c);
  return stress;
}

std::vector<ClosedForm> closed_forms() {
  return {
      {"neo_hookean",
       {0.0067},
       [](double l, V p) { return p[0] * (l - 1 / (l * l)); },
       [](double l, V p) { return p[0] * (l - std::pow(l, -5)); },
       [](double k, V p) { return p[0] * k; }},
      {"mooney_rivlin",
       {0.083, 0.0565},
       [](double l, V p) { return 2 * (p[0] + p[1] / l) * (l - 1 / (l * l)); },
       [](double l, V p) { return 2 * (p[0] + p[1] * l * l) * (l - std::pow(l, -5)); },
       [](double k, V p) { return 2 * (p[0] + p[1]) * k; }},
      {"fung_demiray",
       {0.0067, 1.3},
       [](double l, V p) { return p[0] * std::exp(p[1] * (l * l + 2 / l - 3)) * (l - 1 / (l * l)); },
       [](double l, V p) { return p[0] * std::exp(p[1] * (2 * l * l + std::pow(l, -4) - 3)) * (l - std::pow(l, -5)); },
       [](double k, V p) { return p[0] * std::exp(p[1] * k * k) * k; }},
      {"hooke",
       {0.02, 0.5},
       [](double l, V p) { return p[0] * std::log(l) / l; },
       [](double l, V p) { return 2 * p[0] * std::log(l) / l; },
       // Hencky in simple shear: principal stretch λ with λ − 1/λ = k; σ1 − σ2 = 2 μ (ln λ1 − ln λ2) = 4 μ ln λ, and the
       // principal axes of b give σ12 = ½ (σ1 − σ2) sin 2θ with sin 2θ = 2/√(4 + k²).
       [](double k, V p) { return 4 * p[0] / E_mu * std::asinh(k / 2) / std::sqrt(4 + k * k); }},
      {"hooke_linear",
       {0.02, 0.5},
       [](double l, V p) { return p[0] * (l - 1); },
       [](double l, V p) { return 2 * p[0] * (l - 1); },
       [](double k, V p) { return p[0] / E_mu * k; }},
      {"yeoh",
       {0.0034, -0.0006, 0.0009},
       [](double l, V p) { return 2 * yeoh_slope(l * l + 2 / l - 3, p) * (l - 1 / (l * l)); },
       [](double l, V p) { return 2 * yeoh_slope(2 * l * l + std::pow(l, -4) - 3, p) * (l - std::pow(l, -5)); },
       [](double k, V p) { return 2 * yeoh_slope(k * k, p) * k; }},
      {"ogden",
       {0.004, 3.3, 0.002, -4, 0.0007, 8},
       [](double l, V p) { return ogden_difference(l, 1 / std::sqrt(l), p) / l; },
       [](double l, V p) { return ogden_difference(l, 1 / (l * l), p) / l; },
       // Principal stretches λ, 1/λ, 1 with λ − 1/λ = k, axes as for Hencky above.
       [](double k, V p) {
         const double l = k / 2 + std::sqrt(1 + k * k / 4);
         return ogden_difference(l, 1 / l, p) / std::sqrt(4 + k * k);
       }},
      {"ogden",
       {0.0067, -2.5, 0, 1, 0, 1},
       [](double l, V p) { return ogden_difference(l, 1 / std::sqrt(l), p) / l; },
       [](double l, V p) { return ogden_difference(l, 1 / (l * l), p) / l; },
       [](double k, V p) {
         const double l = k / 2 + std::sqrt(1 + k * k / 4);
         return ogden_difference(l, 1 / l, p) / std::sqrt(4 + k * k);
       }},
      {"hgo", {0.0067, 0.01, 0.8, 35, 1, 0, 0, 0, 1, 0}, hgo_uniaxial, hgo_equibiaxial, hgo_shear},
      {"hgo", {0.0067, 0.003, 2, 65, 2, 0, 0, -1, 3, 0}, hgo_uniaxial, hgo_equibiaxial, hgo_shear},
      {"hgo",
       {0.0067, 0.003, 1, 0, 1, 0, 0, 0, 1, 0},  // fibres along x: no root to find
       [](double l, V p) { return p[0] * (l - 1 / (l * l)) + 2 * hgo_tension(l * l, p) * l; },
       hgo_equibiaxial,
       hgo_shear},
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
