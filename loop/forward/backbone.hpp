// The elastic force over depth of one site and tool, for closed forms; the backbone that the row of springs is cut from.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <loop/forward/tissue.hpp>

namespace palpate::loop {

/// How a ball's force departs from Hertz' at depth.
enum class Strains {
  finite,  ///< as a neo-Hookean layer does that is solved at finite strain
  small,   ///< not at all, but for the law's own curve and the layer's exact factor: what small-strain theory says
  series   ///< the same with the layer's factor from Dimitriadis' series, up to 8 % softer at χ = ½ (decision 020): what is commonly fitted
};

/// As reports name it.
const char* name_of(Strains strains);

/// Where a tool presses.
struct Site {
  Tool tool;
  Vec3 point_mm{0, 0, 0};
  double thickness_mm = 1e4;
  bool bonded = true;
  Strains strains = Strains::finite;
};

/// F(δ) in N. Ball: Hertz 16/3 μ √R δ^1.5 over 2 (1 − ν), times the exact factor of the layer at ν (`series`: Dimitriadis'); at finite strains times neo_hookean_depth and
/// compressible_depth; times the law's stress over the neo-Hookean one at the uniaxial stretch 1 − y, y = a/R representative_strain, a = √(Rδ), at finite strains over
/// 1 + 0.34 ln of that ratio. Flat punch: 8 a μ δ, likewise at 1 − δ/(5a), without a factor for depth. Inclusion: F (1 + e s/(1 + s)), s = a over its distance. Skin: its tension over
/// the deflection of Hertz' solution, 2 c1 T δ, and its stretch, S = E h δ²/R (0.2 + 5.2 √x χ) as S/√(1 + 8.8 S/F), within 11 % of GetFEM where it changes the force by 2 to 23 %.
/// On a bed of springs times the layer's exact factor of it (bed_factor), at finite strains to the power 1 − 0.27 x: within 0.15 % of GetFEM up to x = 0.9, where it changes the force by up to 9 %.
/// Sides of a block or cylinder are not seen.
double elastic_force(const Site& site, const Tissue& tissue, double depth_mm);

/// Force of a neo-Hookean bonded layer under a ball over its small-strain force: 1 − 0.068 √x − 0.092 x − 0.312 x χ − 0.012 x², x = δ/R, χ = √(Rδ)/h. Fitted to solutions by
/// GetFEM at R/h from 1/8 to 5/8, x up to 1.2 (decision 042); within 0.2 % of them from x = 0.2, 0.4 % from 0.1. Half-space: 1 − 0.15 x is Zhang et al. 2014
/// (Biomech. Model. Mechanobiol. 13:1), 2.5 % higher at x = 0.8.
double neo_hookean_depth(double x, double chi);

/// The same for ν < ½, over what the layer's factor at ν makes of it: 1 + n (1 − 1.26 n)(1.17 √x + 3.47 x χ), n = ½ − ν. Fitted to GetFEM down to ν = 0.4 at
/// R/h = 1/8 and 1/4: forces within 0.3 % of it.
double compressible_depth(double nu, double x, double chi);

/// What friction adds to the force of a ball going into an incompressible tissue, relative: x S u/(1 + u³)^⅓, u = 0.3 μ/S, S = 0.03 + 0.065 x what full stick brings. Fitted to
/// GetFEM (bench/hidden/friction.py) for μ = 0.1, 0.3, 1 and x = δ/R from 0.15 to 0.32, within 16 % of it, and to palpate-solve up to x = 0.9 (decision 043).
double solved_friction(double mu, double x);

/// Strain in units of a/R at which a law shows in the force of a ball: 0.2 at small strains (Lin, Dimitriadis and Horkay 2009, J. Biomech. Eng. 131:094502); `deep`:
/// 0.18 + 0.01 x + 0.5 √x χ for a small excess, fitted to Demiray's law by GetFEM at R/h = 1/8 and 1/4: the ratio of forces within 0.7 % for b up to 1, 3.3 % at b = 2.
double representative_strain(bool deep, double x, double chi);

}  // namespace palpate::loop
