// S = S_e + m s ln(1 + ε̇/ε̇0) ∂ε̇/∂Ė: an overstress along the rate of strain, in parts of the elastic stress s, that is gone at once when
// the motion stops. ε̇² = ⅔ tr(C⁻¹Ė C⁻¹Ė) with C of the last step; s is carried on from the last steps. The step's potential is
// dt m s φ(ε̇), convex: it only dissipates. (Overstress: Perzyna 1966, Adv. Appl. Mech. 9:243; logarithm: Johnson and Cook 1983.)
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/effects/second_stress.hpp>

namespace palpate::effects {
namespace {

// Memory: C − I (six numbers), s, ∂s/∂t. Parameters: m, ε̇0.
struct Memory {
  Mat3 strain;  ///< C − I, or F + Fᵀ − 2 I with the geometry not updated
  double size, growth;
};
Memory read(std::span<const double> m) { return {tensor(m.data()), m[6], m[7]}; }

Mat3 strain(const Point& point) {
  if (point.kinematics == materials::Kinematics::small) return point.F + point.F.transpose() - 2 * Mat3::Identity();
  return point.F.transpose() * point.F - Mat3::Identity();
}

/// √(3/2) |dev τ|, MPa.
double stress_size(const Point& point, const Mat3& P) {
  const Mat3 tau = point.kinematics == materials::Kinematics::small ? P : Mat3(P * point.F.transpose());
  return std::sqrt(1.5) * (tau - tau.trace() / 3 * Mat3::Identity()).norm();
}

Response respond(const Inner& inner, const Point& point, std::span<const double> memory, std::span<const double> p) {
  Response r = inner(point.F);
  if (point.dt == 0 || p[0] == 0) return r;
  const bool small = point.kinematics == materials::Kinematics::small;
  const Memory old = read(memory);
  const double s = p[0] * std::max(0.0, old.size + point.dt * old.growth);
  const Mat3 metric = small ? Mat3(Mat3::Identity()) : Mat3((Mat3::Identity() + old.strain).inverse());
  const Mat3 E = 0.5 / point.dt * (strain(point) - old.strain);  // Ė
  const Mat3 raised = 2.0 / 3 * metric * E * metric;
  const double rate = std::sqrt(raised.cwiseProduct(E).sum()), x = rate / p[1];
  const double over_rate = x == 0 ? 1 / p[1] : std::log1p(x) / rate;  // ln(1 + x)/ε̇
  const Mat3 S = s * over_rate * raised;
  add_second_stress(r, point, S);
  if (!point.wants_tangent()) return r;  // no tangent is asked for
  // ∂S/∂Ė = s [ln(1 + x)/ε̇ (⅔ C⁻¹⊙C⁻¹ − N⊗N) + N⊗N/(ε̇0 + ε̇)], N = ∂ε̇/∂Ė
  const Mat3 F = small ? Mat3(Mat3::Identity()) : point.F;
  const Mat3 FM = F * metric, FMF = FM * F.transpose();
  const double isotropic = s * over_rate * 2 / 3 / point.dt, along = rate == 0 ? 0 : s * (1 / (p[1] + rate) - over_rate) / point.dt;
  const Mat3 FN = rate == 0 ? Mat3(Mat3::Zero()) : Mat3(F * raised / rate);
  const Vec9 n = Eigen::Map<const Vec9>(FN.data());
  for (int l = 0; l < 3; ++l)
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i) r.A(i + 3 * j, k + 3 * l) += isotropic * 0.5 * (FMF(i, k) * metric(j, l) + FM(i, l) * FM(k, j));
  r.A += along * n * n.transpose();
  return r;
}

void remember(const Inner& inner, const Point& point, std::span<double> memory, std::span<const double>) {
  const Memory old = read(memory);
  const double size = stress_size(point, inner(point.F).P);
  Eigen::Map<Vec6>(memory.data()) = six(strain(point));
  memory[7] = point.dt > 0 ? (size - old.size) / point.dt : 0;
  memory[6] = size;
}

}  // namespace

Effect rate() {
  return {{"effect", "rate", "stiffer the faster: an overstress that grows with the logarithm of the strain rate and is gone at rest",
           "Perzyna 1966, Adv. Appl. Mech. 9:243, with the logarithm of Johnson and Cook 1983",
           {{"m", "1", {0, 0.3}, 0.05, "overstress in parts of the elastic stress, per unit of ln(1 + rate/rate_0)"},
            {"rate_0", "1/s", {1e-9, 1e6}, 0.01, "strain rate at which it begins to count"}}},
          false,
          {[](std::span<const double>) { return 8; }, respond, remember}};
}

}  // namespace palpate::effects
