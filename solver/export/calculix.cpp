// CalculiX' input, block by block. Numbers have at most 20 characters: more are cut off when CalculiX reads them.
// (Dhondt, CalculiX CrunchiX user's manual 2.20, §7: *HYPERELASTIC, *BOUNDARY, *NODE PRINT.)
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/export/calculix.hpp>

#include <algorithm>
#include <array>
#include <iomanip>
#include <map>
#include <sstream>

#include <palpate/errors.hpp>
#include <solver/case_parts.hpp>

namespace palpate::calculix {
namespace {

constexpr int edge_ends[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};  // in C3D10's order

using Edge = std::array<int, 2>;

Edge edge(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

/// Nodes in the middle of edges, numbered behind the mesh's, in the order of their ends.
std::map<Edge, int> middle_nodes(const implicit::Model& model) {
  std::map<Edge, int> middle;
  for (const auto& tet : model.tets)
    for (const auto& [a, b] : edge_ends) middle[edge(tet[a], tet[b])] = 0;
  int next = static_cast<int>(model.points.size());
  for (auto& [ends, node] : middle) node = next++;
  return middle;
}

/// Adds the nodes in the middle of edges whose ends both belong.
std::set<int> with_middles(std::set<int> nodes, const std::map<Edge, int>& middle) {
  std::set<int> all = nodes;
  for (const auto& [ends, node] : middle)
    if (nodes.contains(ends[0]) && nodes.contains(ends[1])) all.insert(node);
  return all;
}

void write_nodes(std::ostream& out, const implicit::Model& model, const std::map<Edge, int>& middle) {
  const auto line = [&](int node, const Eigen::Vector3d& x) {
    out << node + 1 << ", " << x.x() << ", " << x.y() << ", " << x.z() << "\n";
  };
  std::vector<Eigen::Vector3d> points = model.points;
  points.resize(points.size() + middle.size());
  for (const auto& [ends, node] : middle) points[node] = (points[ends[0]] + points[ends[1]]) / 2;
  out << "*NODE, NSET=ALL\n";
  for (std::size_t i = 0; i < points.size(); ++i) line(static_cast<int>(i), points[i]);
}

/// Region by region, as the mesh names them: set REGION_<number>.
void write_elements(std::ostream& out, const Case& c, const std::map<Edge, int>& middle) {
  std::map<int, std::vector<int>> of_region;
  for (std::size_t t = 0; t < c.model.tets.size(); ++t) of_region[c.mesh.tet_region[t]].push_back(static_cast<int>(t));
  for (const auto& [region, tets] : of_region) {
    const auto name = c.mesh.region_names.find(region);
    if (name != c.mesh.region_names.end()) out << "** region " << region << " is " << name->second << "\n";
    out << "*ELEMENT, TYPE=C3D10, ELSET=REGION_" << region << "\n";
    for (int t : tets) {
      const auto& tet = c.model.tets[t];
      out << t + 1;
      for (int corner : tet) out << ", " << corner + 1;
      for (const auto& [a, b] : edge_ends) out << ", " << middle.at(edge(tet[a], tet[b])) + 1;
      out << "\n";
    }
    out << "*SOLID SECTION, ELSET=REGION_" << region << ", MATERIAL=MATERIAL_" << c.model.tet_material[tets.front()] + 1 << "\n";
  }
}

void write_set(std::ostream& out, const std::string& name, const std::set<int>& nodes) {
  out << "*NSET, NSET=" << name << "\n";
  for (int node : nodes) out << node + 1 << ",\n";
}

/// D1 = 2/κ; D2 and D3, which CalculiX replaces by values of its own where they are 0, so large that their terms vanish.
std::array<double, 3> volume_constants(const elements::Material& m, double bulk_ratio) {
  constexpr double no_term = 1e20;
  const double kappa = std::isfinite(m.bulk_modulus) ? m.bulk_modulus : bulk_ratio * m.shear_modulus();
  const auto [s2, s3] = m.volume_stiffening;
  return {2 / kappa, s2 > 0 ? 1 / s2 : no_term, s3 > 0 ? 1 / s3 : no_term};
}

std::string join(const std::vector<double>& numbers) {
  std::ostringstream out;
  out << std::setprecision(12);
  for (std::size_t i = 0; i < numbers.size(); ++i) out << (i ? ", " : "") << numbers[i];
  return out.str() + "\n";
}

using Constants = std::array<double, 3>;

std::string neo_hookean(const std::vector<double>& p, const Constants& D) { return "NEO HOOKE\n" + join({p[0] / 2, D[0]}); }
std::string mooney_rivlin(const std::vector<double>& p, const Constants& D) { return "MOONEY-RIVLIN\n" + join({p[0], p[1], D[0]}); }
std::string yeoh(const std::vector<double>& p, const Constants& D) { return "YEOH\n" + join({p[0], p[1], p[2], D[0], D[1], D[2]}); }

/// Terms without stiffness are left out; of three terms D3 has a line of its own.
std::string ogden(const std::vector<double>& p, const Constants& D) {
  std::vector<double> line;
  for (int term = 0; term < 3; ++term)
    if (p[2 * term] > 0) line.insert(line.end(), {p[2 * term], p[2 * term + 1]});
  const std::size_t terms = line.size() / 2;
  line.insert(line.end(), D.begin(), D.begin() + std::min<std::size_t>(terms, 2));
  return "OGDEN, N=" + std::to_string(terms) + "\n" + join(line) + (terms == 3 ? join({D[2]}) : "");
}

/// How a law is written behind *HYPERELASTIC.
const std::map<std::string, std::string (*)(const std::vector<double>&, const Constants&)> laws = {
    {"mooney_rivlin", mooney_rivlin}, {"neo_hookean", neo_hookean}, {"ogden", ogden}, {"yeoh", yeoh}};

void write_materials(std::ostream& out, const implicit::Model& model, double bulk_ratio) {
  for (std::size_t i = 0; i < model.materials.size(); ++i) {
    const auto& m = model.materials[i];
    out << "*MATERIAL, NAME=MATERIAL_" << i + 1 << "\n";
    if (!std::isfinite(m.bulk_modulus)) out << "** incompressible in the case: here kappa = " << bulk_ratio << " times the initial shear modulus\n";
    out << "*HYPERELASTIC, " << laws.at(m.law.entry.name)(m.parameters, volume_constants(m, bulk_ratio));
  }
}

void write_amplitudes(std::ostream& out, const implicit::Model& model, double end) {
  for (std::size_t i = 0; i < model.amplitudes.size(); ++i) {
    auto points = model.amplitudes[i].points;
    if (points.empty()) points = {{0, 0}, {end, end}};
    out << "*AMPLITUDE, NAME=AMPLITUDE_" << i << "\n";
    for (const auto& [time, factor] : points) out << time << ", " << factor << "\n";
  }
}

struct Motion {
  double value = 0;
  int amplitude = 0;
};

/// Components of nodes, amplitude by amplitude; in the middle of edges too, whose ends belong to the same base, patch or plane.
void write_boundary(std::ostream& out, const Case& c, const std::map<Edge, int>& middle) {
  std::map<std::array<int, 2>, Motion> motions;
  const auto add = [&](const std::set<int>& nodes, int component, const Motion& motion) {
    for (int node : with_middles(nodes, middle)) motions.try_emplace({node, component}, motion);
  };
  for (int component = 0; component < 3; ++component) {
    add(c.base, component, {});
    for (const auto& moved : c.moved) add(moved.nodes, component, {moved.motion_mm(component), moved.amplitude});
  }
  for (const auto& symmetry : c.symmetries) add(symmetry.nodes, symmetry.axis, {});
  for (std::size_t amplitude = 0; amplitude < c.model.amplitudes.size(); ++amplitude) {
    std::ostringstream lines;
    lines << std::setprecision(12);
    for (const auto& [at, motion] : motions)
      if (motion.amplitude == static_cast<int>(amplitude))
        lines << at[0] + 1 << ", " << at[1] + 1 << ", " << at[1] + 1 << ", " << motion.value << "\n";
    if (!lines.str().empty()) out << "*BOUNDARY, AMPLITUDE=AMPLITUDE_" << amplitude << "\n" << lines.str();
  }
}

/// The sets whose forces are asked for: each patch that is moved, then what is held.
std::vector<std::pair<std::string, std::set<int>>> printed_sets(const Case& c) {
  std::vector<std::pair<std::string, std::set<int>>> sets;
  for (std::size_t i = 0; i < c.moved.size(); ++i) sets.push_back({"MOVED" + std::to_string(i + 1), c.moved[i].nodes});
  if (!c.base.empty()) sets.push_back({"BASE", c.base});
  return sets;
}

}  // namespace

void refuse_what_cannot_be_said(const std::filesystem::path& file, const Case& c) {
  const Settings settings = Settings::read(file);
  const std::set<std::string> known = {"schema", "mesh", "material", "base", "displacement", "symmetry", "steps"};
  for (const auto& key : settings.keys())
    if (!known.contains(key))
      throw Failure(ExitCode::refused, "the file for CalculiX cannot say [" + key + "]", settings.where(key),
                    "leave it out; [base], [[displacement]], [[symmetry]] and [material] are carried");
  const auto tables = settings.tables("material");
  for (std::size_t i = 0; i < c.model.materials.size(); ++i) {
    const auto& m = c.model.materials[i];
    std::string names;
    for (const auto& [name, write] : laws) names += (names.empty() ? "" : ", ") + name;
    if (!laws.contains(m.law.entry.name))
      throw Failure(ExitCode::refused, "the file for CalculiX cannot say law = \"" + m.law.entry.name + "\"", tables.at(i).where("law"), "one of " + names);
    for (int term = 0; term < 3 && m.law.entry.name == "ogden"; ++term)
      if (const std::string key = "alpha" + std::to_string(term + 1); m.parameters[2 * term] > 0 && m.parameters[2 * term + 1] == 0)
        throw Failure(ExitCode::refused, "the file for CalculiX cannot say " + key + " = 0", tables.at(i).where(key), "a power near 0: 0.001");
  }
}

std::string input(const Case& c, double bulk_ratio) {
  const auto middle = middle_nodes(c.model);
  const auto sets = printed_sets(c);
  const double end = c.steps.times.back(), step = end / c.count;
  std::ostringstream out;
  out << std::setprecision(12);
  out << "** Written by palpate-export. Units mm, N, MPa, s; space LPS\n";
  write_nodes(out, c.model, middle);
  write_elements(out, c, middle);
  for (const auto& [name, nodes] : sets) write_set(out, name, with_middles(nodes, middle));
  write_materials(out, c.model, bulk_ratio);
  write_amplitudes(out, c.model, end);
  out << "*STEP, NLGEOM, INC=100000\n*STATIC\n" << step << ", " << end << ", " << 1e-6 * end << ", " << step << "\n";
  write_boundary(out, c, middle);
  for (const auto& [name, nodes] : sets) out << "*NODE PRINT, NSET=" << name << ", TOTALS=ONLY\nRF\n";
  out << "*END STEP\n";
  return out.str();
}

}  // namespace palpate::calculix
