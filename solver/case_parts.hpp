// Parts of a case that are read one by one, and how names are looked up in the registers.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <algorithm>
#include <string>
#include <vector>

#include <solver/case.hpp>

namespace palpate {

/// The entry of a register that a key names, or an error with the nearest name.
template <class Entry>
const Entry& named(const std::vector<Entry>& entries, const Settings& settings, const std::string& key) {
  std::vector<std::string> names;
  for (const auto& e : entries) names.push_back(e.entry.name);
  const std::string name = settings.choice(key, names);
  return *std::find_if(entries.begin(), entries.end(), [&](const Entry& e) { return e.entry.name == name; });
}

/// Its parameters, in the entry's order.
inline std::vector<double> parameters(const CatalogueEntry& entry, const Settings& settings) {
  std::vector<double> values;
  for (const auto& p : entry.parameters) values.push_back(settings.real(p.name, p.range));
  return values;
}

std::string text_mm(const Eigen::Vector3d& v);

/// Names of the mesh's regions.
std::vector<std::string> region_names(const TetMesh& mesh);

/// [base], [[displacement]], [[force]], [[pressure]], [[spring]], [gravity] into the model.
void read_loads(const Settings& settings, Case& c);

/// What acts before the tools come grows from t = −1 to 0.
void plan_settling(Case& c, int steps);

/// Name and numbers of one [[effect]]. Throws Failure(misuse).
effects::Active read_effect(const Settings& table);

/// `friction`, or infinite with `sticking`, of a [[tool]] or a [[contact]].
double coulombs_coefficient(const Settings& table);

/// [[effect]] into the model; what is on tools waits for them in Case::effects.
void read_effects(const Settings& settings, Case& c);

/// [tool] or [[tool]] into the model, at first contact with the organ at rest.
void read_tools(const Settings& settings, Case& c);

/// [[contact]] into the model.
void read_contacts(const Settings& settings, Case& c);

/// Time at which the last load or tool stops changing, s.
double end_of_loads(const implicit::Model& model);

}  // namespace palpate
