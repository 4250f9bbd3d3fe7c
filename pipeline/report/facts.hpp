// What a study says in numbers: its result in one sentence, the figures on top, the table of solves.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include <pipeline/report/drawings.hpp>
#include <pipeline/report/study.hpp>

namespace palpate {

struct SolveFacts {
  double peak_force_N = 0, depth_at_peak_mm = 0, depth_reached_mm = 0, depth_asked_mm = 0;  ///< asked is 0 when unknown
  double contact_area_mm2 = 0;                                                              ///< the largest
  long steps = 0, iterations = 0;
  double smallest_J = 0;  ///< 0 when unknown
  std::string law;        ///< "neo_hookean: mu 0.00667"; empty when unknown
};
SolveFacts facts_of(const Solve& solve);

/// Newtons, or millinewtons where all forces are small.
struct ForceUnit {
  double per_newton = 1;
  std::string name = "N";
};
ForceUnit force_unit(const Study& study);

struct CheckCount {
  long passed = 0, failed = 0;
};
CheckCount checks_of(const Json& card);
CheckCount checks_of(const Study& study);

/// The study's result as a sentence, plain text.
std::string result_sentence(const Study& study);

struct Tile {
  std::string label, value, unit;
};
std::vector<Tile> tiles(const Study& study);

}  // namespace palpate
