// Reading [[effect]]: what the model is given besides its laws, one table per effect; on the stress the first one is innermost.
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

/// Whether it is meant for the material with this number.
bool covers(const GivenEffect& given, const Case& c, int material) { return given.region.empty() || given.region == c.material_regions[material]; }

/// The rest shape as maps of it say.
void reshape(Case& c) {
  for (const auto& given : c.effects)
    if (given.effect.start.shape)
      for (auto& x : c.model.points) x = given.effect.start.shape(x, given.parameters);
  for (const auto& tet : c.model.tets) {
    const auto X = implicit::corners(c.model, tet);
    if (!((X.col(1) - X.col(0)).cross(X.col(2) - X.col(0)).dot(X.col(3) - X.col(0)) > 0))
      throw Failure(ExitCode::misuse, "the map of the rest shape turns a tetrahedron inside out", "at " + text_mm(X.rowwise().mean()), "a wider edge, or less excess");
  }
}

/// What is so of the tissue from the start, place by place.
void begin_tissue(Case& c) {
  std::vector<const GivenEffect*> list;
  for (const auto& given : c.effects)
    if (given.effect.start.begin) list.push_back(&given);
  if (list.empty()) return;
  c.model.starts.resize(c.model.tets.size());
  for (const auto* given : list) {
    bool counts = given->parameters[0] == 0;
    for (std::size_t t = 0; t < c.model.tets.size(); ++t) {
      if (!covers(*given, c, c.model.tet_material[t])) continue;
      const auto centroids = elements::sub_centroids(implicit::corners(c.model, c.model.tets[t]));
      for (int s = 0; s < 4; ++s) {
        auto& start = c.model.starts[t][s];
        const effects::Start before = start;
        given->effect.start.begin(centroids.col(s), given->parameters, start);
        counts = counts || start.modulus != before.modulus || start.turgor != before.turgor;
      }
    }
    if (!counts)
      throw Failure(ExitCode::misuse, given->effect.entry.name + " changes nothing: it lies outside of the organ, or between its points", given->where, "another place, or a finer mesh there");
  }
}

}  // namespace

void read_effects(const Settings& settings, Case& c) {
  for (const auto& table : settings.tables("effect")) {
    const effects::Effect effect = named(effects::all(), table, "name");
    const auto values = effect.many_terms ? term_parameters(effect.entry, table) : parameters(effect.entry, table);
    if (effect.objection)
      if (const std::string objection = effect.objection(values); !objection.empty()) throw Failure(ExitCode::misuse, objection, table.where());
    c.effects.push_back({{effect, values}, "", table.where()});
    const bool of_tissue = effect.stress.respond || effect.start.begin;
    if (of_tissue && table.has("region")) c.effects.back().region = table.choice("region", region_names(c.mesh));
    if (!effect.stress.respond) continue;
    for (std::size_t m = 0; m < c.model.materials.size(); ++m)
      if (covers(c.effects.back(), c, static_cast<int>(m))) c.model.materials[m].add(effect, values);
  }
  reshape(c);
  begin_tissue(c);
}

}  // namespace palpate
