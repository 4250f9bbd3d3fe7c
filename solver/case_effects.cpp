// Reading [[effect]]: what the model is given besides its laws, one table per effect; on the stress the first one is innermost.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/case_parts.hpp>

#include <limits>
#include <map>
#include <numeric>

#include <palpate/errors.hpp>
#include <solver/selection.hpp>

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

std::vector<double> effect_parameters(const effects::Effect& effect, const Settings& settings) {
  if (effect.many_terms) return term_parameters(effect.entry, settings);
  std::vector<double> values;
  for (std::size_t i = 0; i < effect.entry.parameters.size(); ++i) {
    const auto& p = effect.entry.parameters[i];
    const double* fallback = effects::fallback(effect, i);
    values.push_back(fallback ? settings.real(p.name, *fallback, p.range) : settings.real(p.name, p.range));
  }
  return values;
}

}  // namespace

double coulombs_coefficient(const Settings& table) {
  const bool sticks = table.flag("sticking", false);
  if (sticks && table.has("friction"))
    throw Failure(ExitCode::misuse, "friction is given, but what touches sticks", table.where("friction"), "leave out friction, or sticking = true");
  return sticks ? std::numeric_limits<double>::infinity() : table.real("friction", 0, effects::friction().entry.parameters.front().range);
}

effects::Active read_effect(const Settings& table) {
  const effects::Effect effect = named(effects::all(), table, "name");
  const auto values = effect_parameters(effect, table);
  if (effect.objection)
    if (const std::string objection = effect.objection(values); !objection.empty()) throw Failure(ExitCode::misuse, objection, table.where());
  return {effect, values};
}

namespace {

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

/// The region's nodes, each with its share of area and its normal at rest.
std::vector<implicit::RegionForce::Point> points_of(const std::vector<int>& faces, const implicit::Model& model) {
  std::map<int, Eigen::Vector3d> area_vectors;
  for (int f : faces) {
    const auto& [a, b, d] = model.faces[f];
    const Eigen::Vector3d sixth = (model.points[b] - model.points[a]).cross(model.points[d] - model.points[a]) / 6;
    for (int node : model.faces[f]) area_vectors.try_emplace(node, Eigen::Vector3d::Zero()).first->second += sixth;
  }
  std::vector<implicit::RegionForce::Point> points;
  for (const auto& [node, area] : area_vectors) points.push_back({node, area.norm(), area.normalized()});
  return points;
}

/// Its faces are those of plane, box or label; of a layer without one of these, all.
void lay_on_surface(const Settings& table, const GivenEffect& given, Case& c) {
  const auto& effect = given.effect;
  if (!effect.layer.respond && !effect.force.respond) return;
  const bool named = table.has("plane") || table.has("box") || table.has("label");
  std::vector<int> faces(c.model.faces.size());
  std::iota(faces.begin(), faces.end(), 0);
  if (named || effect.force.respond) faces = chosen_faces(table, c.mesh);
  if (effect.force.respond) {
    c.model.region_forces.push_back({given, points_of(faces, c.model)});
    return;
  }
  c.model.layers.push_back({given, faces});
  plan_settling(c, 4);
}

/// Its materials, and what they are made of.
void add_to_tissue(const Settings& table, GivenEffect& given, Case& c) {
  if (!given.effect.stress.respond && !given.effect.start.begin) return;
  if (table.has("region")) given.region = table.choice("region", region_names(c.mesh));
  if (!given.effect.stress.respond) return;
  for (std::size_t m = 0; m < c.model.materials.size(); ++m)
    if (covers(given, c, static_cast<int>(m))) c.model.materials[m].add(given.effect, given.parameters);
}

}  // namespace

void read_effects(const Settings& settings, Case& c) {
  const auto tables = settings.tables("effect");
  const double tools = static_cast<double>(settings.tables("tool").size());
  for (const auto& table : tables) {
    GivenEffect given{read_effect(table), "", table.where()};
    if (given.effect.traction.respond && table.has("tool")) given.tool = static_cast<int>(table.integer("tool", 0, {1, tools}));
    add_to_tissue(table, given, c);
    c.effects.push_back(std::move(given));
  }
  reshape(c);
  begin_tissue(c);
  for (std::size_t i = 0; i < tables.size(); ++i) lay_on_surface(tables[i], c.effects[i], c);
}

}  // namespace palpate
