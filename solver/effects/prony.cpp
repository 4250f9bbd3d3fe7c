// S = S_e − Σ g_i (S_e − q_i), q̇_i = (S_e − q_i)/τ_i: of the elastic stress S_e of every moment a part g_i fades with τ_i; the law is the
// instantaneous one. With Q_i = g_i ∫ exp(−(t − s)/τ_i) dS_e: S = (1 − Σ g_i) S_e + Σ Q_i. Exact for S_e linear in a step.
// (Simo 1987, Comput. Methods Appl. Mech. Eng. 60:153; Taylor, Pister, Goudreau 1970, Int. J. Numer. Meth. Eng. 2:45, eq. 21.)
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/effects/second_stress.hpp>

namespace palpate::effects {
namespace {

/// Of a term in a step: what is left of the old Q, and which part of g ΔS_e arrives.
struct Decay {
  double left, arrives;
};
Decay decay(double dt, double tau) {
  const double x = dt / tau;
  return {std::exp(-x), x == 0 ? 1 : -std::expm1(-x) / x};
}

// Memory: S_e, then Q_i term by term. Parameters: (g_i, τ_i) term by term.
Response respond(const Inner& inner, const Point& point, std::span<const double> memory, std::span<const double> p) {
  Response r = inner(point.F);
  double elastic = 1;
  Vec6 history = Vec6::Zero();
  const Eigen::Map<const Vec6> old_elastic(memory.data());
  for (std::size_t i = 0; i < p.size() / 2; ++i) {
    const double g = p[2 * i];
    const auto [left, arrives] = decay(point.dt, p[2 * i + 1]);
    elastic -= g * (1 - arrives);
    history += left * Eigen::Map<const Vec6>(&memory[6 * (i + 1)]) - g * arrives * old_elastic;
  }
  r.W *= elastic;
  r.P *= elastic;
  if (point.wants_tangent()) r.A *= elastic;
  add_second_stress(r, point, tensor(history.data()));
  return r;
}

void remember(const Inner& inner, const Point& point, std::span<double> memory, std::span<const double> p) {
  const Vec6 S = six(second_stress(point, inner(point.F).P));
  Eigen::Map<Vec6> old_elastic(memory.data());
  for (std::size_t i = 0; i < p.size() / 2; ++i) {
    const auto [left, arrives] = decay(point.dt, p[2 * i + 1]);
    Eigen::Map<Vec6> Q(&memory[6 * (i + 1)]);
    Q = left * Q + p[2 * i] * arrives * (S - old_elastic);
  }
  old_elastic = S;
}

std::string objection(std::span<const double> p) {
  double sum = 0;
  for (std::size_t i = 0; i < p.size(); i += 2) sum += p[i];
  return sum < 1 ? "" : "the g_i add up to 1 or more: nothing would be left of the stress";
}

}  // namespace

Effect prony() {
  return {{"effect", "prony", "viscoelastic: parts g of the isochoric stress fade with times tau; the law is the instantaneous one",
           "Simo 1987, Comput. Methods Appl. Mech. Eng. 60:153",
           {{"g", "1", {0, 0.999}, 0.2, "part of the instantaneous stress that fades; one or a list"},
            {"tau_s", "s", {1e-6, 1e9}, 1, "its relaxation time; one or a list"}}},
          true,
          {[](std::span<const double> p) { return 6 * (1 + static_cast<int>(p.size()) / 2); }, respond, remember},
          objection};
}

}  // namespace palpate::effects
