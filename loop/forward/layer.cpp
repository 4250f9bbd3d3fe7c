// The Fredholm equation of a layer, solved with 24 Gauss points for 60 contact radii.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/layer.hpp>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <array>
#include <memory>
#include <mutex>

namespace palpate::loop {
namespace {

/// Gauss-Legendre points and weights on [0, 1] (Golub and Welsch 1969).
struct GaussRule {
  Eigen::VectorXd x, w;
  explicit GaussRule(int n) {
    Eigen::MatrixXd T = Eigen::MatrixXd::Zero(n, n);
    for (int i = 1; i < n; ++i) T(i, i - 1) = T(i - 1, i) = i / std::sqrt(4.0 * i * i - 1);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(T);
    x = 0.5 * (eigen.eigenvalues().array() + 1);
    w = eigen.eigenvectors().row(0).cwiseAbs2().transpose();
  }
};

/// 1 − M(α), with e = exp(−2α) so that nothing overflows.
double one_minus_compliance(double alpha, bool bonded, double kappa) {
  const double e = std::exp(-2 * alpha);
  if (!bonded) return alpha < 1e-6 ? 1 : 1 - (1 - e) * (1 - e) / (1 - e * e + 4 * alpha * e);
  if (alpha < 1e-3 && kappa - 1 < 1e-9) return 1 - 2.0 / 3 * alpha * alpha * alpha;
  return 1 - (kappa * (1 - e * e) - 4 * alpha * e) / (kappa * (1 + e * e) + e * (1 + kappa * kappa + 4 * alpha * alpha));
}

/// The same on a bed of springs of stiffness 1/softness, for ν = ½; with μ = 1.
double one_minus_compliance_on_bed(double alpha, double softness) {
  const double a = std::max(alpha, 1e-3);
  const auto derivatives = [&](double z) {  // of the four parts of W, the k-th in row k
    const double y = 1 - z, f = std::exp(-a * y), g = std::exp(-a * z);
    Eigen::Matrix4d d;
    d << f, y * f, g, z * g,                                                              //
        a * f, (a * y - 1) * f, -a * g, (1 - a * z) * g,                                  //
        a * a * f, (a * a * y - 2 * a) * f, a * a * g, (a * a * z - 2 * a) * g,           //
        a * a * a * f, (a * a * a * y - 3 * a * a) * f, -a * a * a * g, (3 * a * a - a * a * a * z) * g;
    return d;
  };
  const auto normal = [&](const Eigen::Matrix4d& d) { return Eigen::RowVector4d(3 * d.row(1) - d.row(3) / (a * a)); };  // −p + 2 W′
  const auto shear = [&](const Eigen::Matrix4d& d) { return Eigen::RowVector4d(-d.row(2) / a - a * d.row(0)); };
  const Eigen::Matrix4d top = derivatives(1), base = derivatives(0);
  Eigen::Matrix4d A;
  A << normal(top), shear(top), softness * normal(base) - base.row(0), softness * shear(base) + base.row(1) / a;
  return 1 + 2 * a * (top.row(0) * A.partialPivLu().solve(Eigen::Vector4d(-1, 0, 0, 0)))(0);
}

/// K(x) tabulated on [0, 2 end] and read by cubic interpolation.
class Kernel {
 public:
  Kernel(const std::function<double(double)>& one_minus_compliance, double end) : step_(2 * end / (count - 3)) {
    static const GaussRule rule(400);
    constexpr double last = 40;  // 1 − M falls as α² e^(−2α)
    std::vector<double> part;
    for (int i = 0; i < rule.x.size(); ++i) part.push_back(last * rule.w(i) * one_minus_compliance(last * rule.x(i)));
    for (int j = 0; j < count; ++j) {
      double sum = 0;
      for (int i = 0; i < rule.x.size(); ++i) sum += part[i] * std::cos(last * rule.x(i) * j * step_);
      table_.push_back(sum);
    }
  }
  double operator()(double x) const {
    const double s = std::abs(x) / step_;
    const int i = std::min(static_cast<int>(s), count - 3);
    const double t = s - i, before = i > 0 ? table_[i - 1] : table_[1];  // K is even
    const double a = table_[i], b = table_[i + 1], c = table_[i + 2];
    return a + t * (0.5 * (b - before) + t * (before - 2.5 * a + 2 * b - 0.5 * c + t * (1.5 * (a - b) + 0.5 * (c - before))));
  }

 private:
  static constexpr int count = 600;
  double step_;
  std::vector<double> table_;
};

/// Cubic through the four nearest points (Lagrange); beyond the last as at it. Straight lines would bend at every point by more than noise.
double interpolated(const std::vector<double>& x, const std::vector<double>& y, double at) {
  if (at >= x.back()) return y.back();
  const std::size_t next = std::upper_bound(x.begin(), x.end(), at) - x.begin();
  const std::size_t first = std::min(next > 2 ? next - 2 : 0, x.size() - 4);
  double sum = 0;
  for (std::size_t i = first; i < first + 4; ++i) {
    double term = y[i];
    for (std::size_t j = first; j < first + 4; ++j)
      if (j != i) term *= (at - x[j]) / (x[i] - x[j]);
    sum += term;
  }
  return sum;
}

}  // namespace

LayerFactors::LayerFactors(const std::function<double(double)>& one_minus_compliance) : a_{0}, chi_{0}, ball_{1}, punch_{1}, area_{1} {
  constexpr double end = 3;
  constexpr int radii = 120;
  const Kernel kernel(one_minus_compliance, end);
  static const GaussRule rule(24);
  const int n = rule.x.size();
  for (int k = 1; k <= radii; ++k) {
    const double a = end * k / radii;
    Eigen::MatrixXd A = Eigen::MatrixXd::Identity(n, n), b(n, 2);
    for (int i = 0; i < n; ++i) {
      const double t = a * rule.x(i);
      b.row(i) << 1, t * t;
      for (int j = 0; j < n; ++j) A(i, j) -= a * rule.w(j) / M_PI * (kernel(t + a * rule.x(j)) + kernel(t - a * rule.x(j)));
    }
    const Eigen::MatrixXd phi = A.partialPivLu().solve(b);
    Eigen::RowVector2d edge(1, a * a), integral = a * rule.w.transpose() * phi;
    for (int j = 0; j < n; ++j) edge += a * rule.w(j) / M_PI * (kernel(a + a * rule.x(j)) + kernel(a - a * rule.x(j))) * phi.row(j);
    const double delta = edge(1) / edge(0);  // R = h = 1: φ = δ φ1 − φ2 vanishes at the edge
    a_.push_back(a);
    punch_.push_back(integral(0) / a);
    chi_.push_back(std::sqrt(delta));
    area_.push_back(a * a / delta);
    ball_.push_back((delta * integral(0) - integral(1)) / (2.0 / 3 * std::pow(delta, 1.5)));
  }
}

double LayerFactors::ball(double chi) const { return interpolated(chi_, ball_, chi); }
double LayerFactors::punch(double a_over_h) const { return interpolated(a_, punch_, a_over_h); }
double LayerFactors::area(double chi) const { return interpolated(chi_, area_, chi); }

namespace {

constexpr int tabulated = 17;  ///< ν = 0.5, 0.48, … 0.18

const LayerFactors& kept_factors(bool bonded, int index) {
  static std::array<std::once_flag, 2 * tabulated> once;
  static std::array<std::unique_ptr<const LayerFactors>, 2 * tabulated> kept;
  const int at = 2 * index + bonded;
  std::call_once(once[at], [&] {
    const double kappa = 3 - 4 * (0.5 - 0.02 * index);
    kept[at] = std::make_unique<const LayerFactors>([=](double alpha) { return one_minus_compliance(alpha, bonded, kappa); });
  });
  return *kept[at];
}

constexpr int beds = 13;  ///< of softness (i/12)²

const LayerFactors& kept_bed(int index) {
  static std::array<std::once_flag, beds> once;
  static std::array<std::unique_ptr<const LayerFactors>, beds> kept;
  std::call_once(once[index], [&] {
    const double root = index / (beds - 1.0);
    kept[index] = std::make_unique<const LayerFactors>([=](double alpha) { return one_minus_compliance_on_bed(alpha, root * root); });
  });
  return *kept[index];
}

double between_tables(double (LayerFactors::*factor)(double) const, bool bonded, double nu, double at) {
  const double place = bonded ? std::clamp((0.5 - nu) / 0.02, 0.0, 15.0) : 0;  // a sliding layer's M knows no ν
  const int index = static_cast<int>(place);
  const auto of = [&](int i) { return (kept_factors(bonded, i).*factor)(at); };
  const double t = place - index;
  return t > 0 ? (1 - t) * of(index) + t * of(index + 1) : of(index);
}

}  // namespace

double layer_factor(bool flat, bool bonded, double nu, double at) { return between_tables(flat ? &LayerFactors::punch : &LayerFactors::ball, bonded, nu, at); }
double bed_factor(bool flat, double softness, double at) {
  std::vector<double> roots, factors;
  for (int i = 0; i < beds; ++i) {
    roots.push_back(i / (beds - 1.0));
    factors.push_back(flat ? kept_bed(i).punch(at) : kept_bed(i).ball(at));
  }
  return interpolated(roots, factors, std::sqrt(std::max(softness, 0.0))) / factors.front();
}
double layer_area(bool bonded, double nu, double chi) { return between_tables(&LayerFactors::area, bonded, nu, chi); }

double dimitriadis_factor(bool bonded, double nu, double chi) {
  const double alpha = bonded ? -(1.2876 - 1.4678 * nu + 1.3442 * nu * nu) / (1 - nu) : -0.347 * (3 - 2 * nu) / (1 - nu);
  const double beta = bonded ? (0.6387 - 1.0277 * nu + 1.5164 * nu * nu) / (1 - nu) : 0.056 * (5 - 2 * nu) / (1 - nu);
  const double a = 2 * alpha / M_PI, a3 = alpha * alpha * alpha, pi2 = M_PI * M_PI;
  return 1 + chi * (-a + chi * (a * a + chi * (-8 / (pi2 * M_PI) * (a3 + 4 * pi2 / 15 * beta) + chi * 16 * alpha / (pi2 * pi2) * (a3 + 3 * pi2 / 5 * beta))));
}

}  // namespace palpate::loop
