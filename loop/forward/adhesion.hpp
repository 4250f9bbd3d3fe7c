// Adhesion of a row of springs. Of a contact of radius a that is drawn back by Δ from where it would be without adhesion, ½ Δ² K′(a) is set free per length of its edge's way, K(a) the stiffness of a flat
// punch of that radius; it holds on while that is less than 2π a w, the work of adhesion: Δ = √(4π a w/K′(a)) (Shull 2002; on a half-space √(2π a w/E*), Johnson, Kendall and Roberts 1971, Heß 2011 ch. 3).
// K = F′ along the elastic curve; at finite strain K′/K is as at small strain: dK/da along the curve is too small there by what K loses with depth (decision 040).
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <vector>

#include <loop/forward/backbone.hpp>
#include <loop/forward/row.hpp>

namespace palpate::loop {

/// Area of a ball's contact without friction or adhesion, mm²: πRδ times the exact one of the layer over that of a half-space; at finite strains the radius is 1 − 0.090 x − 0.308 x χ − 0.047 x² of that,
/// x = δ/R, χ = √(Rδ)/h, fitted to GetFEM (bench/hidden/adhesion.py) for a neo-Hookean bonded layer at R/h = 1/8 and 1/4, x from 0.08 to 1.2: within 0.8 % of it.
double contact_area(const Site& site, const Tissue& tissue, double depth_mm);

/// Sets what each spring bears before it lets go: a ball's, Δ at the radius where it starts, and it is let go between the tool's places at which its neighbours are. Flat punch: all let go at once.
/// `depths`: where the springs start, and the end of the last one.
void add_adhesion(std::vector<Spring>& springs, std::span<const double> depths_mm, const Site& site, const Tissue& tissue);

}  // namespace palpate::loop
