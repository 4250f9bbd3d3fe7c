// Reading who may touch whom: [[contact]] between = ["a", "b"], or self = "a"; and how rough they are to each other.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <set>

#include <palpate/errors.hpp>
#include <solver/case_parts.hpp>

namespace palpate {
namespace {

/// The surface of a region's tetrahedra.
std::vector<int> faces_of(const std::string& region, const Case& c, const std::vector<int>& tets, const std::string& where) {
  std::vector<int> faces;
  for (int f = 0; f < static_cast<int>(tets.size()); ++f) {
    const auto name = c.mesh.region_names.find(c.mesh.tet_region[tets[f]]);
    if (name != c.mesh.region_names.end() && name->second == region) faces.push_back(f);
  }
  if (faces.empty()) throw Failure(ExitCode::misuse, "no face of the surface belongs to \"" + region + "\"", where, "name a region of tetrahedra");
  return faces;
}

bool hang_together(const implicit::Model& model, const std::vector<int>& a, const std::vector<int>& b) {
  std::set<int> nodes;
  for (int f : a) nodes.insert(model.faces[f].begin(), model.faces[f].end());
  return std::any_of(b.begin(), b.end(), [&](int f) {
    return std::any_of(model.faces[f].begin(), model.faces[f].end(), [&](int node) { return nodes.contains(node); });
  });
}

std::vector<std::string> pair_of_names(const Settings& table, const std::vector<std::string>& known) {
  const Json value = table.value("between");
  std::vector<std::string> names;
  if (value.is_array())
    for (const auto& name : value)
      if (name.is_string()) names.push_back(name.get<std::string>());
  if (names.size() != 2 || names[0] == names[1])
    throw Failure(ExitCode::misuse, "between takes the names of two regions", table.where("between"), "between = [\"uterus\", \"tube\"]");
  for (const auto& name : names)
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw Failure(ExitCode::misuse, "the mesh has no region \"" + name + "\"", table.where("between"), "one of its regions");
  return names;
}

}  // namespace

void read_contacts(const Settings& settings, Case& c) {
  const auto tables = settings.tables("contact");
  if (tables.empty()) return;
  const auto tets = implicit::tets_of_faces(c.model);
  std::set<std::vector<std::string>> seen;
  for (const auto& table : tables) {
    if (table.has("between") == table.has("self"))
      throw Failure(ExitCode::misuse, "a contact is between two regions or of one with itself", table.where(), "between = [\"a\", \"b\"] or self = \"a\"");
    const auto known = region_names(c.mesh);
    const auto names = table.has("self") ? std::vector{table.choice("self", known)} : pair_of_names(table, known);
    auto sorted = names;
    std::sort(sorted.begin(), sorted.end());
    if (!seen.insert(sorted).second)
      throw Failure(ExitCode::misuse, "this contact is given twice: it would press and rub twice", table.where(), "one [[contact]] for the two");
    std::vector<std::vector<int>> faces(2);
    for (std::size_t i = 0; i < names.size(); ++i) faces[i] = faces_of(names[i], c, tets, table.where());
    const double friction = coulombs_coefficient(table);
    for (auto& pass : contact::passes_between(faces[0], faces[1], hang_together(c.model, faces[0], faces[1]), static_cast<int>(c.contacts.size()), friction))
      c.model.passes.push_back(std::move(pass));
    c.contacts.push_back(names);
  }
}

}  // namespace palpate
