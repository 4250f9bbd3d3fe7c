// Tables of a case, taken out and written.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/case_words.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string_view>

#include <palpate/errors.hpp>
#include <palpate/mesh_files.hpp>
#include <palpate/settings.hpp>

namespace palpate::loop {

namespace fs = std::filesystem;

constexpr double never_slips = 1e6;        // of palpate-solve's support
constexpr double adhesion_range_mm = 0.3;  // forces do not hang on it where it is small beside the tool, and smaller than faces it makes them jump

bool has_one_material(const fs::path& case_file) { return Settings::read(case_file).tables("material").size() == 1; }

bool remembers(const fs::path& case_file) {
  constexpr std::string_view still[] = {"schema", "title", "mesh", "base", "symmetry", "spring", "material", "effect", "tool", "steps"}, elastic[] = {"capsule", "thickness", "prestress", "inclusion", "support"};
  const auto among = [](const auto& names, const std::string& name) { return std::find(std::begin(names), std::end(names), name) != std::end(names); };
  const Settings settings = Settings::read(case_file);
  const auto keys = settings.keys();
  const auto effects = settings.tables("effect"), tools = settings.tables("tool");
  return !std::all_of(keys.begin(), keys.end(), [&](const std::string& key) { return among(still, key); }) ||
         !std::all_of(effects.begin(), effects.end(), [&](const Settings& effect) { return among(elastic, effect.text("name")) && effect.real("friction", never_slips) >= never_slips; }) || tools.size() != 1 || tools[0].has("friction") ||
         tools[0].has("sticking") || tools[0].has("control") || tools[0].has("turn");
}

fs::path mesh_of_case(const fs::path& file) { return file.parent_path() / Settings::read(file).text("mesh", "mesh.vtu"); }

std::string case_without(const std::string& text, const std::vector<std::string>& tables) {
  std::istringstream in(text);
  std::string kept;
  bool keep = true;
  for (std::string line; std::getline(in, line);) {
    const auto first = line.find_first_not_of(" \t");
    if (first != std::string::npos && line[first] == '[')
      keep = std::none_of(tables.begin(), tables.end(), [&](const std::string& name) { return line.find(name) != std::string::npos; });
    if (keep) kept += line + "\n";
  }
  return kept;
}

std::string thickness_words(const fs::path& file, double excess) {
  const Settings settings = Settings::read(file);
  if (!settings.has("base") || !settings.table("base").has("plane"))
    throw Failure(ExitCode::refused, "the case does not say from where thickness counts", file.string(), "[base] plane = { point_mm, normal }");
  const Settings plane = settings.table("base").table("plane");
  const Vec3 n = plane.vec3("normal"), x0 = plane.vec3("point_mm");
  std::ostringstream out;
  out.precision(12);
  out << "[[effect]]\nname = \"thickness\"\nexcess = " << excess << "\naxis_x = " << n[0] << "\naxis_y = " << n[1] << "\naxis_z = " << n[2] << "\nx_mm = " << x0[0]
      << "\ny_mm = " << x0[1] << "\nz_mm = " << x0[2] << "\n";
  return out.str();
}

double representative_strain_at(double deepest, double R) { return 0.2 * std::sqrt(std::min(deepest / R, 1.0)); }

std::string memory_words(const std::string& name, double e, const std::vector<double>& shape, double mu, double strain) {
  std::ostringstream out;
  out.precision(8);
  out << "[[effect]]\nname = \"" << name << "\"\n";
  if (name == "prony") out << "g = " << e << "\ntau_s = " << shape[0] << "\n";
  else if (name == "mullins") out << "inverse_r = " << e << "\nm = " << 2 * shape[0] * shape[0] * 1.5 * mu * strain * strain << "\n";  // ½ e² of a spring at the deepest point stands for the energy 3/2 μ ε²
  else if (name == "rate") out << "m = " << e << "\nrate_0 = " << shape[0] * strain << "\n";
  else if (name == "permanent_set") out << "fraction = " << e << "\nyield = " << shape[0] * strain << "\n";
  else if (name == "friction") out << "mu = " << e << "\n";
  else if (name == "adhesion") out << "work = " << e << "\nrange_mm = " << adhesion_range_mm << "\n";
  else return "";
  return out.str();
}

double surface_along(const fs::path& file, const Vec3& point, const Vec3& axis, double around) {
  const Vec3 n = (1 / norm(axis)) * axis;
  double first = std::numeric_limits<double>::infinity();
  for (const Vec3& p : read_mesh(file).points) {
    const double along = dot(p - point, n);
    if (norm(p - point - along * n) < around) first = std::min(first, along);
  }
  if (!(first < 1e300)) throw Failure(ExitCode::refused, "the mesh has nothing under the tool", file.string(), "point_mm and axis of the run");
  return first;
}

std::string inclusion_words(const Vec3& surface, const Vec3& axis, double depth, double excess) {
  const Vec3 middle = surface + (depth / norm(axis)) * axis;
  std::ostringstream out;
  out.precision(12);
  out << "[[effect]]\nname = \"inclusion\"\nexcess = " << excess << "\nx_mm = " << middle[0] << "\ny_mm = " << middle[1] << "\nz_mm = " << middle[2] << "\nradius_mm = " << depth / 2
      << "\n";
  return out.str();
}

}  // namespace palpate::loop
