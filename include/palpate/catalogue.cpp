// Catalogue entries as JSON.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <palpate/catalogue.hpp>

#include <cmath>

namespace palpate {

Json finite_or_null(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json to_json(const CatalogueEntry& entry) {
  Json parameters = Json::array();
  for (const Parameter& p : entry.parameters)
    parameters.push_back({{"name", p.name},
                          {"unit", p.unit},
                          {"min", finite_or_null(p.range.min)},
                          {"max", finite_or_null(p.range.max)},
                          {"typical", p.typical},
                          {"meaning", p.meaning}});
  return {{"kind", entry.kind},
          {"name", entry.name},
          {"sentence", entry.sentence},
          {"reference", entry.reference},
          {"parameters", parameters}};
}

}  // namespace palpate
