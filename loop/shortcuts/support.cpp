// Support: what carries the specimen gives way, as a whole (u − F/k), or as a bed of springs under a wide layer (bed_factor).
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/register.hpp>
#include <loop/forward/solved_curves.hpp>

namespace palpate::shortcuts {

namespace {
constexpr double bed_area_mm2 = 100;  ///< of the bed, to which its compliance is said
}

Effect support() {
  Effect effect;
  effect.entry = {"force", "support", "what carries the specimen gives way", "Johnson 1985, Contact Mechanics, §1 (stiffnesses in series); Winkler 1867 (bed of springs)",
                  {{"compliance", "mm/N", {0, 20}, 0.02, "compliance of the support; of a bed, that of a square centimetre of it"},
                     {"bed", "1", {0, 1}, 0, "0: the specimen gives way as a whole; 1: a bed of springs under a wide layer"}}};
  effect.grid_of = [](const Set& set) { return is_wide_layer(set) ? std::vector<std::vector<double>>{{0}, {1}} : std::vector<std::vector<double>>{{0}}; };
  effect.refines = false;
  effect.accuracy = 0.02;
  effect.separates = "glue the specimen down; press on a rigid block (phase = block)";
  effect.needs_contact = true;
  effect.tissue = [](double e, std::span<const double> shape, Tissue& tissue) { (shape[0] == 0 ? tissue.support_mm_per_N : tissue.bed_mm_per_MPa) += shape[0] == 0 ? e : e * bed_area_mm2; };
  return effect;
}

}  // namespace palpate::shortcuts
