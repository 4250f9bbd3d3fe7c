// Manufactured solution: incompressible, u = curl-like sines, p = cosine; orders of the mini-element: L2(u) 2, H1(u) 1, L2(p) 1.
// (Arnold, Brezzi, Fortin 1984, theorem 2.1; Roache 2002, J. Fluids Eng. 124:4, for the method.)
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include <solver/implicit/equilibrium.hpp>
#include <tests/verify/shapes.hpp>

using namespace palpate;
using namespace palpate::verify;

namespace {

constexpr double pi = M_PI, mu = 1.0;

/// u = (sin πy sin πz, sin πz sin πx, sin πx sin πy)/π², divergence free; −μ ∇²u = 2 μ π² u.
Vector3d exact_u(const Vector3d& x) {
  const Eigen::Array3d s = (pi * x.array()).sin();
  return Vector3d(s(1) * s(2), s(2) * s(0), s(0) * s(1)) / (pi * pi);
}
Eigen::Matrix3d exact_gradient(const Vector3d& x) {
  const Eigen::Array3d s = (pi * x.array()).sin(), c = (pi * x.array()).cos();
  Eigen::Matrix3d g;
  g << 0, c(1) * s(2), s(1) * c(2), c(0) * s(2), 0, s(0) * c(2), c(0) * s(1), s(0) * c(1), 0;
  return g / pi;
}
double exact_p(const Vector3d& x) { return std::cos(pi * x.x()) * std::cos(pi * x.y()) * x.z(); }
/// f = −div(2 μ sym ∇u + p I) = 2 μ π² u − ∇p.
Vector3d force(const Vector3d& x) {
  const double cx = std::cos(pi * x.x()), cy = std::cos(pi * x.y()), sx = std::sin(pi * x.x()), sy = std::sin(pi * x.y());
  return 2 * mu * pi * pi * exact_u(x) - Vector3d(-pi * sx * cy * x.z(), -pi * cx * sy * x.z(), cx * cy);
}

struct Errors {
  double u = 0, gradient = 0, p = 0;
};

/// Four-point rule of degree 2 in each tetrahedron; the linear part is measured (the bubble is of higher order).
Errors errors(const implicit::Model& model, const implicit::State& state) {
  constexpr double a = 0.5854101966249685, b = 0.1381966011250105;
  double shift = 0, volume = 0;  // the pressure is known up to a constant: compare means
  Errors e;
  for (int pass = 0; pass < 2; ++pass)
    for (const auto& tet : model.tets) {
      Eigen::Matrix<double, 3, 4> X, U;
      Eigen::Vector4d P;
      for (int i = 0; i < 4; ++i) {
        X.col(i) = model.points[tet[i]];
        U.col(i) = state.displacement(tet[i]);
        P(i) = state.pressure(tet[i]);
      }
      const auto rest = elements::tetrahedron(X);
      const Eigen::Matrix3d G = U * rest.gradients.transpose();
      for (int q = 0; q < 4; ++q) {
        Eigen::Vector4d N = Eigen::Vector4d::Constant(b);
        N(q) = a;
        const double w = rest.volume / 4;
        const Vector3d x = X * N;
        if (pass == 0) {
          shift += w * (N.dot(P) - exact_p(x));
          volume += w;
          continue;
        }
        e.u += w * (U * N - exact_u(x)).squaredNorm();
        e.gradient += w * (G - exact_gradient(x)).squaredNorm();
        e.p += w * std::pow(N.dot(P) - exact_p(x) - shift / volume, 2);
      }
    }
  return {std::sqrt(e.u), std::sqrt(e.gradient), std::sqrt(e.p)};
}

Errors solve(int n) {
  auto model = brick(uniform(0, 1, n), uniform(0, 1, n), uniform(0, 1, n));
  model.materials = {material("hooke_linear", {3 * mu, 0.5})};
  model.body_force = force;
  for (std::size_t i = 0; i < model.points.size(); ++i) {
    const auto& x = model.points[i];
    if ((x.array() < 1e-9).any() || (x.array() > 1 - 1e-9).any())
      for (int c = 0; c < 3; ++c) model.prescribed.push_back({int(i), c, exact_u(x)(c)});
  }
  model.prescribed.push_back({0, 3, 0});  // the pressure's constant
  implicit::Equilibrium equilibrium(model, 2);
  implicit::State state = implicit::rest_state(model);
  EXPECT_TRUE(equilibrium.find(state, 1)) << equilibrium.trouble().cause;
  return errors(model, state);
}

}  // namespace

TEST(Manufactured, OrdersOfTheMiniElement) {
  const Errors coarse = solve(8), fine = solve(16);
  const double u = std::log2(coarse.u / fine.u), gradient = std::log2(coarse.gradient / fine.gradient), p = std::log2(coarse.p / fine.p);
  std::printf("  orders: L2(u) %.3f, H1(u) %.3f, L2(p) %.3f\n", u, gradient, p);
  EXPECT_GE(u, 2 - 0.15);
  EXPECT_GE(gradient, 1 - 0.15);
  EXPECT_GE(p, 1 - 0.15);
}
