// What a contact's springs bear by adhesion.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/adhesion.hpp>

#include <algorithm>
#include <cmath>

#include <loop/forward/layer.hpp>

namespace palpate::loop {
namespace {

/// Of a contact of radius a and stiffness K, mm: √(4π a w/K′(a)), K′/K as on a layer at small strain.
double drawn_back(const Site& site, const Tissue& tissue, double a, double stiffness) {
  const double at = a / (site.thickness_mm * tissue.thickness_factor), step = 0.01 * at;
  const auto log_stiffness = [&](double x) { return std::log(x * layer_factor(true, site.bonded, tissue.nu, x)); };
  const double per_radius = (log_stiffness(at + step) - log_stiffness(at - step)) / (0.02 * a);
  return std::sqrt(4 * M_PI * a * 1e-3 * tissue.adhesion_J_per_m2 / (stiffness * per_radius));
}

}  // namespace

double contact_area(const Site& site, const Tissue& tissue, double depth) {
  if (!(depth > 0)) return 0;
  const double hertz = site.tool.radius_mm * depth, x = depth / site.tool.radius_mm, chi = std::sqrt(hertz) / (site.thickness_mm * tissue.thickness_factor);
  const bool deep = site.strains == Strains::finite && tissue.law->name != "hooke_linear";
  const double narrower = deep ? std::max(1 - 0.090 * x - 0.308 * x * chi - 0.047 * x * x, 0.3) : 1;
  return M_PI * hertz * layer_area(site.bonded, tissue.nu, chi) * narrower * narrower;
}

void add_adhesion(std::vector<Spring>& springs, std::span<const double> depths, const Site& site, const Tissue& tissue) {
  if (site.tool.is_flat()) {
    const double all = drawn_back(site, tissue, site.tool.radius_mm, springs.front().stiffness);
    for (Spring& spring : springs) spring.reach = spring.start + all;
    return;
  }
  double before = 0;
  for (std::size_t i = 0; i < springs.size(); ++i) {
    const double after = before + springs[i].stiffness, depth = i > 0 ? springs[i].start : 0.25 * depths[1];
    if (after > 0) springs[i].reach = drawn_back(site, tissue, std::sqrt(contact_area(site, tissue, depth) / M_PI), 0.5 * (before + after));
    before = after;
  }
  for (std::size_t i = 0; i + 1 < springs.size(); ++i)
    springs[i].fade = std::clamp(springs[i + 1].start - springs[i + 1].reach - springs[i].start + springs[i].reach, 0.0, springs[i].reach);
}

}  // namespace palpate::loop
