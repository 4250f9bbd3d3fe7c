// Reading [[effect]]: what is added to the tissue's laws, one table per effect, the first one innermost.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/case_parts.hpp>

#include <palpate/errors.hpp>

namespace palpate {
namespace {

/// A number, or a list of them, each in the parameter's range.
std::vector<double> one_or_many(const Settings& settings, const Parameter& parameter) {
  if (!settings.value(parameter.name).is_array()) return {settings.real(parameter.name, parameter.range)};
  return settings.reals(parameter.name, parameter.range);
}

/// Term by term: (g1, tau1, g2, tau2, …).
std::vector<double> term_parameters(const CatalogueEntry& entry, const Settings& settings) {
  std::vector<std::vector<double>> lists;
  for (const auto& p : entry.parameters) {
    lists.push_back(one_or_many(settings, p));
    if (lists.back().empty()) throw Failure(ExitCode::misuse, p.name + " is an empty list", settings.where(p.name), "one value per term");
    if (lists.back().size() != lists.front().size())
      throw Failure(ExitCode::misuse, p.name + " has " + std::to_string(lists.back().size()) + " values, " + entry.parameters[0].name + " has " + std::to_string(lists.front().size()),
                    settings.where(p.name), "one value per term in each");
  }
  std::vector<double> values;
  for (std::size_t term = 0; term < lists.front().size(); ++term)
    for (const auto& list : lists) values.push_back(list[term]);
  return values;
}

}  // namespace

void read_effects(const Settings& settings, Case& c) {
  for (const auto& table : settings.tables("effect")) {
    const effects::Effect effect = named(effects::all(), table, "name");
    const auto values = effect.many_terms ? term_parameters(effect.entry, table) : parameters(effect.entry, table);
    if (effect.objection)
      if (const std::string objection = effect.objection(values); !objection.empty()) throw Failure(ExitCode::misuse, objection, table.where());
    const std::string region = table.has("region") ? table.choice("region", region_names(c.mesh)) : "";
    for (std::size_t m = 0; m < c.model.materials.size(); ++m)
      if (region.empty() || region == c.material_regions[m]) c.model.materials[m].add(effect, values);
  }
}

}  // namespace palpate
