// Closed forms of the elastic force under a ball or a flat punch.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/backbone.hpp>

#include <cmath>

#include <loop/forward/layer.hpp>

namespace palpate::loop {
namespace {

/// Stress of the law over that of a neo-Hookean one at the representative stretch 1 − y.
double law_over_neo_hookean(const Tissue& tissue, double y) {
  y = std::min(y, 0.9);
  if (!(y > 1e-6) || tissue.law->name == "hooke_linear") return 1;
  const double mu = tissue.law->shear_modulus(tissue.parameters), stretch = 1 - y;
  return nominal_stress(Test::uniaxial, stretch, *tissue.law, tissue.parameters, tissue.stiffening) / (mu * (stretch - 1 / (stretch * stretch)));
}

/// The same where finite strain counts: tissue that stiffens spreads the strain, which is smaller then.
double law_over_neo_hookean_deep(const Tissue& tissue, double y) {
  const double first = law_over_neo_hookean(tissue, y);
  return first > 0 ? law_over_neo_hookean(tissue, y / std::max(1 + 0.34 * std::log(first), 0.5)) : first;
}

/// 2 c1, c1 = ∫ ½ w′² 2πr dr for w = Hertz' deflection in units of δ, r in units of a, out to ten contact radii: energy T c1 δ². (Johnson 1985, eq. 3.42)
double tension_constant() {
  constexpr int steps = 4000;
  constexpr double end = 10;
  double c1 = 0;
  for (int i = 0; i < steps; ++i) {
    const double r = end * (i + 0.5) / steps, dr = end / steps;
    const auto deflection = [](double x) { return x < 1 ? 1 - x * x / 2 : ((2 - x * x) * std::asin(1 / x) + std::sqrt(x * x - 1)) / M_PI; };
    const double slope = (deflection(r + 1e-4) - deflection(r - 1e-4)) / 2e-4;
    c1 += 0.5 * slope * slope * 2 * M_PI * r * dr;
  }
  return 2 * c1;
}

/// Force of tension and of a skin over a tissue that resists with `tissue_force`: a stiff skin spreads the load and is stretched less.
double skin_force(const Tissue& tissue, double R, double depth, double chi, double tissue_force) {
  static const double tension = tension_constant();
  const double skin = tissue.capsule_N_per_mm * depth * depth / R * (0.2 + 5.2 * std::sqrt(depth / R) * chi);
  return tension * tissue.tension_N_per_mm * depth + skin / std::sqrt(1 + 8.8 * skin / tissue_force);
}

/// Far from a small contact the load is a point force, whose stress falls with the square of distance whatever the contact: a compliance that does not depend on depth is lost in series, a
/// share a/d of the contact's own 1/(2 E* a) (energy of an inclusion in that field, Eshelby 1957). Beyond s = a/d ≈ 1 the tool feels the inclusion itself: s/(1 + s).
double inclusion_factor(const Site& site, const Tissue& tissue, double contact_mm) {
  double factor = 1;
  for (const Inclusion& inclusion : tissue.inclusions) {
    const Vec3 apart = site.point_mm - inclusion.point_mm;
    const double s = contact_mm / (inclusion.depth_mm + norm(apart));
    factor += inclusion.excess * s / (1 + s);
  }
  return factor;
}

}  // namespace

const char* name_of(Strains strains) {
  static constexpr const char* names[] = {"finite", "small", "series"};
  return names[static_cast<int>(strains)];
}

double representative_strain(bool deep, double x, double chi) { return deep ? 0.18 + 0.01 * x + 0.5 * std::sqrt(x) * chi : 0.2; }

double neo_hookean_depth(double x, double chi) { return std::max(1 - 0.068 * std::sqrt(x) - 0.092 * x - 0.312 * x * chi - 0.012 * x * x, 0.2); }

double compressible_depth(double nu, double x, double chi) {
  const double n = 0.5 - nu;
  return 1 + n * (1 - 1.26 * n) * (1.17 * std::sqrt(x) + 3.47 * x * chi);
}

double solved_friction(double mu, double x) {
  const double stuck = 0.03 + 0.065 * x, u = 0.3 * mu / stuck;
  return x * stuck * u / std::cbrt(1 + u * u * u);
}

double elastic_force(const Site& site, const Tissue& tissue, double depth) {
  if (!(depth > 0)) return 0;
  const double R = site.tool.radius_mm, h = site.thickness_mm * tissue.thickness_factor;
  const double mu = tissue.law->shear_modulus(tissue.parameters), from_nu = 1 / (2 * (1 - tissue.nu));
  const bool flat = site.tool.is_flat();
  const double a = flat ? R : std::sqrt(R * depth), x = depth / R, chi = a / h;
  const double half_space = flat ? 8 * R * mu * depth : 16.0 / 3 * mu * a * depth;
  const bool deep = site.strains == Strains::finite && !flat && tissue.law->name != "hooke_linear";
  const double y = flat ? depth / (5 * R) : a / R * representative_strain(deep, x, chi);
  const bool series = site.strains == Strains::series && !flat;
  double factor = (series ? dimitriadis_factor(site.bonded, tissue.nu, chi) : layer_factor(flat, site.bonded, tissue.nu, chi)) * (deep ? law_over_neo_hookean_deep(tissue, y) : law_over_neo_hookean(tissue, y));
  if (deep) factor *= neo_hookean_depth(x, chi) * compressible_depth(tissue.nu, x, chi);
  if (tissue.bed_mm_per_MPa > 0) factor *= std::pow(bed_factor(flat, mu * tissue.bed_mm_per_MPa / h, chi), deep ? std::max(1 - 0.27 * x, 0.0) : 1);
  const double bare = half_space * from_nu * factor * inclusion_factor(site, tissue, a);
  return bare + skin_force(tissue, R, depth, chi, bare);
}

}  // namespace palpate::loop
