// Area Σ|a×b|/2, volume Σ a·(b×c)/6 (a tube's lumen with its rims closed to their centres), work ∫ F du by trapezoids.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/compare/measures.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include <palpate/errors.hpp>
#include <palpate/mesh_files.hpp>
#include <pipeline/mesh/boundary.hpp>
#include <pipeline/mesh/centre_line.hpp>
#include <pipeline/mesh/quality.hpp>
#include <pipeline/mesh/shell_quality.hpp>

namespace palpate {
namespace {

using Triangles = std::vector<std::array<int, 3>>;

double area_of(const std::vector<Vec3>& x, const std::array<int, 3>& t) { return norm(cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]])) / 2; }

/// Edges of one triangle only, turned around: with them and the rim's centre the surface is closed.
double lumen_volume(const std::vector<Vec3>& x, const Triangles& triangles, const std::vector<int>& end) {
  double volume = 0;
  std::map<std::pair<int, int>, int> once;
  std::map<int, std::pair<Vec3, int>> centre;
  for (const auto& t : triangles) {
    volume += dot(x[t[0]], cross(x[t[1]], x[t[2]])) / 6;
    for (int k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      if (const auto other = once.find({b, a}); other != once.end()) once.erase(other);
      else once[{a, b}] = 1;
    }
  }
  for (std::size_t i = 0; i < x.size(); ++i)
    if (end[i] > 0) centre[end[i]].first = centre[end[i]].first + x[i], ++centre[end[i]].second;
  for (const auto& [edge, count] : once) {
    const auto& [sum, nodes] = centre[end[edge.first]];
    if (nodes > 0) volume += dot(x[edge.second], cross(x[edge.first], (1.0 / nodes) * sum)) / 6;
  }
  return std::abs(volume);
}

/// The value below which a part `q` of the weight lies.
double quantile(const std::vector<double>& values, const std::vector<double>& weights, double q) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  double below = 0;
  for (std::size_t i : order)
    if ((below += weights[i]) >= q * total) return values[i];
  return values[order.back()];
}

void measure_wall(Measured& m, const ShellMesh& mesh, std::vector<double>& weights) {
  const ShellQuality quality = shell_quality(mesh);
  double volume = 0;
  for (const auto& t : mesh.triangles) {
    weights.push_back(area_of(mesh.points, t));
    volume += weights.back() * (mesh.thickness_mm[t[0]] + mesh.thickness_mm[t[1]] + mesh.thickness_mm[t[2]]) / 3;
  }
  const Surface tube{mesh.points, mesh.triangles, mesh.triangle_region, mesh.region_names};
  const CentreLine line = centre_line(tube, std::max(1.0, quality.mean_edge));
  m.arc_mm = line.arc, m.diameter_mm = line.diameter;
  std::vector<double> inside;  // sections that no rim cuts off
  const double margin = *std::max_element(line.diameter.begin(), line.diameter.end()) / 2;
  for (std::size_t i = 0; i < line.arc.size(); ++i)
    if (line.arc[i] >= margin && line.arc[i] <= line.length() - margin) inside.push_back(line.diameter[i]);
  if (inside.empty()) inside = line.diameter;
  const auto [least, most] = std::minmax_element(inside.begin(), inside.end());
  const auto [thin, thick] = std::minmax_element(mesh.thickness_mm.begin(), mesh.thickness_mm.end());
  const double mean = std::accumulate(inside.begin(), inside.end(), 0.0) / inside.size();
  for (const auto& [quantity, unit, value] : std::initializer_list<std::tuple<const char*, const char*, double>>{
           {"thickness", "mm", *thin == *thick ? *thin : volume / quality.area_mm2}, {"least thickness", "mm", *thin}, {"largest thickness", "mm", *thick},
           {"area", "mm²", quality.area_mm2}, {"wall's volume", "mm³", volume}, {"enclosed volume", "mm³", lumen_volume(mesh.points, mesh.triangles, mesh.end)},
           {"length", "mm", line.length()}, {"mean diameter", "mm", mean}, {"least diameter", "mm", *least}, {"largest diameter", "mm", *most}})
    m.measures.push_back({"geometry", quantity, unit, value});
  const TriangleShape& worst = quality.worst;
  for (const auto& [quantity, unit, value] : std::initializer_list<std::tuple<const char*, const char*, double>>{
           {"nodes", "1", mesh.points.size()}, {"triangles", "1", mesh.triangles.size()}, {"mean edge", "mm", quality.mean_edge},
           {"shortest edge", "mm", worst.shortest_edge}, {"longest edge", "mm", worst.longest_edge}, {"largest skew", "°", worst.skew_deg},
           {"largest equiangular skew", "1", worst.equiangular_skew}, {"least Jacobian", "1", worst.jacobian}})
    m.measures.push_back({"mesh", quantity, unit, value});
}

void measure_solid(Measured& m, const TetMesh& mesh, std::vector<double>& weights) {
  const QualityTable quality = quality_of(mesh);
  double volume = 0, area = 0, widest = 0;
  for (int t = 0; t < mesh.tets.size(); ++t) volume += weights.emplace_back(jacobian(corners_of(mesh, t)) / 6);
  std::vector<int> outside;
  for (const auto& face : boundary_faces(mesh)) {
    area += area_of(mesh.points, face);
    outside.insert(outside.end(), face.begin(), face.end());
  }
  std::sort(outside.begin(), outside.end());
  outside.erase(std::unique(outside.begin(), outside.end()), outside.end());
  for (std::size_t i = 0; i < outside.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) widest = std::max(widest, norm(mesh.points[outside[i]] - mesh.points[outside[j]]));
  for (const auto& [quantity, unit, value] :
       std::initializer_list<std::tuple<const char*, const char*, double>>{{"area", "mm²", area}, {"volume", "mm³", volume}, {"largest diameter", "mm", widest}})
    m.measures.push_back({"geometry", quantity, unit, value});
  for (const auto& [quantity, unit, value] : std::initializer_list<std::tuple<const char*, const char*, double>>{
           {"nodes", "1", mesh.points.size()}, {"tetrahedra", "1", mesh.tets.size()}, {"least dihedral angle", "°", quality.smallest_dihedral_deg.min},
           {"median of least dihedral angles", "°", quality.smallest_dihedral_deg.median}, {"least radius ratio", "1", quality.radius_ratio.min},
           {"least scaled Jacobian", "1", quality.scaled_jacobian.min}})
    m.measures.push_back({"mesh", quantity, unit, value});
}

void measure_forces(Measured& m) {
  const auto &force = m.solve.history.column("F[N]"), &depth = m.solve.history.column("depth[mm]"), &area = m.solve.history.column("contact_area[mm2]");
  const std::size_t peak = std::max_element(force.begin(), force.end()) - force.begin();
  const bool of_means = !m.solve.history.column("gap[mm]").empty();  // a clamp's row has the mean force since the row before
  double work = 0;
  for (std::size_t i = 1; i < force.size(); ++i) work += (of_means ? force[i] : (force[i] + force[i - 1]) / 2) * (depth[i] - depth[i - 1]);
  const auto add = [&](const char* quantity, const char* unit, double value) { m.measures.push_back({"maxima", quantity, unit, value}); };
  add("peak force", "N", force[peak]);
  add("depth at peak force", "mm", depth[peak]);
  add("last force", "N", force.back());
  add("depth reached", "mm", *std::max_element(depth.begin(), depth.end()));
  add("work of the force", "mJ", work);
  if (area.empty()) return;
  add("largest contact area", "mm²", *std::max_element(area.begin(), area.end()));
  if (area.back() > 0) add("mean contact pressure at the end", "MPa", force.back() / area.back());
}

void measure_fields(Measured& m, const MeshFields& fields, const std::vector<double>& weights) {
  const auto add = [&](const std::string& quantity, const char* unit, double value) { m.measures.push_back({"maxima", quantity, unit, value}); };
  for (const Field& field : fields.on_points) {
    double most = 0;
    for (std::size_t i = 0; i + field.components <= field.values.size(); i += field.components)
      most = std::max(most, std::sqrt(std::inner_product(field.values.begin() + i, field.values.begin() + i + field.components, field.values.begin() + i, 0.0)));
    if (field.name == "displacement") add("largest displacement", "mm", most);
    if (field.name == "contact_pressure") add("peak contact pressure", "MPa", most);
  }
  for (const auto& [name, quantity, unit] : {std::tuple{"von_mises", "von Mises stress", "MPa"}, std::tuple{"strain", "strain", "1"}})
    for (const auto* list : {&fields.on_tets, &fields.on_faces})
      for (const Field& field : *list)
        if (field.name == name && field.values.size() == weights.size() && !weights.empty()) {
          add(std::string("largest ") + quantity, unit, quantile(field.values, weights, 1));
          add(std::string("99.5 % ") + quantity, unit, quantile(field.values, weights, 0.995));
        }
}

/// What says how far to trust the result, where the solver told it.
void measure_trust(Measured& m) {
  for (const auto& [key, quantity, unit, scale] :
       {std::tuple{"kinetic_part", "kinetic over internal energy", "%", 100.0}, std::tuple{"energy_imbalance_part", "energy imbalance", "%", 100.0},
        std::tuple{"added_mass_part", "added mass", "%", 100.0}, std::tuple{"crossing_triangle_pairs", "crossing triangle pairs", "1", 1.0}})
    if (m.solve.summary.contains(key) && m.solve.summary[key].is_number()) m.measures.push_back({"trust", quantity, unit, scale * m.solve.summary[key].get<double>()});
}

}  // namespace

Measured measure(const std::string& name, Solve solve) {
  Measured m{name, std::move(solve), {}, {}, {}};
  const Frame* deepest = deepest_frame(m.solve);
  if (!deepest) throw Failure(ExitCode::unreadable, "the result has no frames", (m.solve.folder / "frames.pvd").string(), "run palpate-solve again; it writes them");
  std::vector<double> weights;
  const auto& rest = m.solve.frames.front().file;
  const auto on_points = read_mesh_fields(rest).on_points;
  if (std::any_of(on_points.begin(), on_points.end(), [](const Field& field) { return field.name == "thickness"; })) measure_wall(m, read_shells(rest), weights);
  else measure_solid(m, read_mesh(rest), weights);
  measure_forces(m);
  measure_fields(m, read_mesh_fields(deepest->file), weights);
  measure_trust(m);
  return m;
}

}  // namespace palpate
