// Reading set.toml: specimen, rig, tools, noise, runs.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <numeric>

#include <palpate/errors.hpp>
#include <palpate/settings.hpp>
#include <loop/set/csv.hpp>
#include <loop/set/phases.hpp>
#include <loop/set/set.hpp>

namespace palpate::loop {
namespace {

const std::vector<std::string> test_names = {"indentation", "uniaxial", "equibiaxial", "pure_shear", "simple_shear"};
const std::vector<std::string> phase_names = {"approach", "load", "hold", "unload", "rest", "air", "block"};

Known read_known(const Settings& settings, const std::string& key, Range range) {
  if (!settings.has(key)) return {};
  const Json json = settings.value(key);
  if (json.is_string()) {
    const std::string word = settings.choice(key, {"unknown", "from_air"});
    return word == "unknown" ? Known{Known::State::unknown} : Known{};
  }
  if (json.is_number()) return {Known::State::given, settings.real(key, range)};
  const Settings table = settings.table(key);
  return {Known::State::prior, table.real("value", range), table.real("sd", {1e-12, 1e6})};
}

Vec3 read_size(const Settings& s, const std::string& shape) {
  const Range mm{1e-3, 1e4};
  if (shape == "cylinder") {
    const double d = 2 * s.real("radius_mm", mm);
    return {d, d, s.real("height_mm", mm)};
  }
  if (shape == "tube") {
    const double d = s.real("diameter_mm", mm);
    return {d, d, s.real("length_mm", mm)};
  }
  if (shape == "ellipsoid") return 2.0 * s.vec3("radii_mm");
  if (s.has("size_mm")) return s.vec3("size_mm");
  const double height = s.real("height_mm", mm);
  return {s.real("length_mm", 1e4, mm), s.real("width_mm", 1e4, mm), height};  // wide unless told otherwise
}

/// The law of a case and its numbers, so that the loop starts where the case stands.
void read_case_material(const Settings& the_case, Specimen& specimen) {
  const auto materials = the_case.tables("material");
  if (materials.empty()) the_case.table("material");
  specimen.law = materials.front().text("law");
  for (const std::string& key : materials.front().keys())
    if (materials.front().value(key).is_number()) specimen.parameters[key] = materials.front().real(key);
}

Specimen read_specimen(const Settings& s, const std::filesystem::path& folder) {
  Specimen specimen;
  specimen.id = s.text("id", "");
  if (s.has("case")) {
    specimen.case_file = folder / s.text("case");
    read_case_material(Settings::read(specimen.case_file), specimen);
    if (s.has("search_mesh")) {
      specimen.search_mesh = folder / s.text("search_mesh");
      if (!std::filesystem::is_regular_file(specimen.search_mesh))
        throw Failure(ExitCode::unreadable, "no such file: " + specimen.search_mesh.string(), s.where("search_mesh"), "a mesh of palpate-mesh of the same organ, or leave the key out");
    }
  } else if (s.has("shape")) {
    specimen.shape = s.choice("shape", {"block", "cylinder", "ellipsoid", "tube"});
    specimen.size_mm = read_size(s, specimen.shape);
    if (specimen.shape == "tube") {
      specimen.wall_mm = s.real("wall_mm", {1e-3, specimen.size_mm[0] / 4});
      specimen.edge_mm = s.real("edge_mm", 3, {0.2, specimen.size_mm[0] / 4});
      if (s.has("ends")) specimen.ends = s.choice("ends", {"section", "fixed", "free"});
    }
    for (double edge : specimen.size_mm)
      if (!(edge > 0)) throw Failure(ExitCode::misuse, "the specimen has an edge that is not positive", s.where("shape"));
    if (s.has("base")) specimen.bonded = s.choice("base", {"bonded", "sliding"}) == "bonded";
    if (s.has("side")) specimen.ring = s.choice("side", {"free", "ring"}) == "ring";
  }
  if (s.has("law")) specimen.law = s.text("law");
  if (s.has("parameters")) {
    const Settings table = s.table("parameters");
    for (const std::string& key : table.keys()) specimen.parameters[key] = table.real(key);
  }
  return specimen;
}

/// "geometry", "tool_start", "first_contact_0.01N".
void read_zero(const Settings& s, Run& run) {
  run.zero = s.text("zero", "geometry");
  run.zero_sd_mm = s.real("zero_sd_mm", 0, {0, 100});
  const std::string start = "first_contact_";
  if (run.zero == "geometry" || run.zero == "tool_start") return;
  if (run.zero.starts_with(start) && run.zero.ends_with("N")) {
    char* end = nullptr;
    const std::string number = run.zero.substr(start.size(), run.zero.size() - start.size() - 1);
    run.zero_force_N = std::strtod(number.c_str(), &end);
    if (end && *end == 0 && run.zero_force_N >= 0) return;
  }
  throw Failure(ExitCode::misuse, "unknown zero: " + run.zero, s.where("zero"), "geometry, tool_start, or first_contact_0.01N");
}

/// Stretch and nominal stress of a homogeneous test, as they are or from extension, force and gauge.
void read_homogeneous(const Settings& s, const CsvTable& table, Run& run) {
  if (table.has("stretch") || table.has("shear")) {
    run.u = table.numbers(table.has("stretch") ? "stretch" : "shear", "1");
    run.F = table.numbers("P", "MPa");
    return;
  }
  const Range mm{1e-6, 1e6};
  const double length = s.real("gauge_length_mm", mm);
  const double area = s.has("area_mm2") ? s.real("area_mm2", mm) : s.real("width_mm", mm) * s.real("thickness_mm", mm);
  const double rest = motion_at_rest(run.test);
  for (double u : table.numbers("u", "mm")) run.u.push_back(rest + u / length);
  for (double F : table.numbers("F", "N")) run.F.push_back(F / area);
}

void read_columns(const Settings& s, Run& run) {
  const CsvTable table = read_csv(run.file);
  run.line = table.line;
  run.timed = run.test == Test::indentation || table.has("t");
  if (run.timed)
    run.t = table.numbers("t", "s");
  else
    for (std::size_t i = 0; i < table.line.size(); ++i) run.t.push_back(i);
  if (run.test == Test::indentation) {
    run.u = table.numbers("u", "mm");
    run.F = table.numbers("F", "N");
    if (table.has("Fx")) run.Fx = table.numbers("Fx", "N");
    if (table.has("Fy")) run.Fy = table.numbers("Fy", "N");
  } else {
    read_homogeneous(s, table, run);
  }
  if (table.has("phase")) {
    run.phase = table.text.at("phase");
    for (std::size_t i = 0; i < run.phase.size(); ++i)
      if (std::find(phase_names.begin(), phase_names.end(), run.phase[i]) == phase_names.end())
        throw Failure(ExitCode::unreadable, "unknown phase: " + run.phase[i], run.file.string() + ":" + std::to_string(run.line[i]),
                      "approach, load, hold, unload, rest, air or block");
  }
  if (table.has("cycle"))
    for (double c : table.numbers("cycle", table.unit.at("cycle"))) run.cycle.push_back(static_cast<int>(c));
}

int edits(const std::string& a, const std::string& b) {
  std::vector<int> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    int corner = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const int changed = corner + (a[i] != b[j]);
      corner = row[j + 1];
      row[j + 1] = std::min({changed, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

/// Keys that nobody asks for are read over and told, unless they look like a misspelt one of `known`.
void read_over(const Settings& s, const std::vector<std::string>& known, Set& set) {
  static const std::vector<std::string> elsewhere = {"id", "gauge_length_mm", "area_mm2", "width_mm", "thickness_mm", "temperature_degC", "control", "note", "site"};
  for (const std::string& key : s.keys()) {
    const auto near = [&](const std::string& name) { return edits(key, name) <= 2; };
    if (std::any_of(known.begin(), known.end(), near) || std::any_of(elsewhere.begin(), elsewhere.end(), near)) continue;
    s.has(key);
    set.unknown_keys.push_back(s.where(key) + ": " + key);
  }
}

Tool read_tool(const Settings& s) {
  const std::string kind = s.text("kind");
  for (const std::string name : {"ball", "flat_punch", "jaws"})
    if (kind != name && edits(kind, name) <= 2) throw Failure(ExitCode::misuse, "no tool is called " + kind, s.where("kind"), "did you mean " + name + "?");
  if (kind == "jaws") return {kind, 0, s.real("width_mm", 40, {1e-3, 1e3}), s.real("length_mm", 10, {1e-3, 1e3})};
  return {kind, s.real("radius_mm", {1e-3, 1e3})};
}

/// Tools that no closed form knows.
void mark_unusable(Set& set) {
  for (Run& run : set.runs) {
    if (run.test != Test::indentation || run.is_air() || run.is_block() || !set.specimen.case_file.empty() || set.specimen.shape == "tube") continue;
    const std::string& kind = set.tools.at(run.tool).kind;
    if (kind == "ball" || kind.starts_with("flat")) continue;
    run.role = Role::calibration;
    run.unused = "a closed form is known for a ball and a flat punch, not for the tool \"" + kind + "\"";
  }
}

Run read_run(const Settings& s, Set& set, int number) {
  Run run;
  run.file = set.file.parent_path() / s.text("file");
  run.id = s.text("id", run.file.stem().string());
  if (s.has("test")) {
    std::vector<std::string> names = test_names;
    names.push_back("clamp");  // pressed like an indentation; the specimen is a tube
    const std::string name = s.choice("test", names);
    if ((name == "clamp") != (set.specimen.shape == "tube"))
      throw Failure(ExitCode::misuse, "a clamp closes on a tube, and nothing else does", s.where("test"), "[specimen] shape = \"tube\", diameter_mm, length_mm, wall_mm");
    if (name != "clamp") run.test = static_cast<Test>(std::find(test_names.begin(), test_names.end(), name) - test_names.begin());
  }
  if (run.test == Test::indentation) {
    std::vector<std::string> names;
    for (const auto& [name, tool] : set.tools) names.push_back(name);
    if (names.empty()) throw Failure(ExitCode::misuse, "an indentation without a tool", s.where(), "[tool.NAME] kind = \"ball\", radius_mm");
    run.tool = s.has("tool") || names.size() > 1 ? s.choice("tool", names) : names.front();
    if (set.specimen.shape == "tube" && set.tools.at(run.tool).kind != "jaws")
      throw Failure(ExitCode::misuse, "a tube is clamped by jaws, not by a " + set.tools.at(run.tool).kind, s.where(), "[tool.NAME] kind = \"jaws\"");
    run.point_mm = s.vec3("point_mm", {0, 0, set.specimen.size_mm[2]});
    const Vec3 axis = s.vec3("axis", set.specimen.shape == "tube" ? Vec3{0, -1, 0} : Vec3{0, 0, -1});
    if (!(norm(axis) > 0)) throw Failure(ExitCode::misuse, "an axis without direction", s.where("axis"), "the way that the tool goes, such as [0, 0, -1]");
    run.axis = unit(axis);
    read_zero(s, run);
  }
  run.order = static_cast<int>(s.integer("order", number, {0, 1e6}));
  run.rest_before_s = s.real("rest_before_s", 0, {0, 1e9});
  run.turn_deg = s.real("turn_deg", 0, {-360, 360});
  run.rate_mm_s = s.real("rate_mm_s", 0, {0, 1e6});
  run.replicate = s.text("replicate", "");
  for (const char* remark : {"control", "note", "site"}) s.has(remark);
  if (s.has("role")) {
    const std::string role = s.choice("role", {"fit", "holdout", "calibration"});
    run.role = role == "fit" ? Role::fit : role == "holdout" ? Role::holdout : Role::calibration;
  }
  read_over(s, {"rest_before_s", "replicate", "rate_mm_s", "zero_sd_mm", "point_mm", "axis", "zero", "tool", "order", "role", "file", "test", "turn_deg"}, set);
  read_columns(s, run);
  if (run.phase.empty()) run.phase = derived_phases(run);
  if (run.is_air() || run.is_block()) run.role = Role::calibration;
  s.has("temperature_degC");
  return run;
}

}  // namespace

std::string test_name(Test test) { return test_names[static_cast<int>(test)]; }

double motion_at_rest(Test test) { return test == Test::indentation || test == Test::simple_shear ? 0 : 1; }

double loading_rate(const Run& run) {
  std::vector<double> rates;
  for (std::size_t i = 1; i < run.u.size(); ++i)
    if (run.phase[i] == "load") rates.push_back((run.u[i] - run.u[i - 1]) / (run.t[i] - run.t[i - 1]));
  if (rates.size() < 3) return 0;
  std::nth_element(rates.begin(), rates.begin() + rates.size() / 2, rates.end());
  return rates[rates.size() / 2];
}

Set read_set(const std::filesystem::path& path) {
  const Settings s = Settings::read(path);
  if (s.text("schema") != "palpate-set/1")
    throw Failure(ExitCode::misuse, "not a set this version reads", s.where("schema"), "schema = \"palpate-set/1\"");
  Set set;
  set.file = path;
  if (s.has("title")) s.text("title");
  if (s.has("specimen")) set.specimen = read_specimen(s.table("specimen"), path.parent_path());
  if (s.has("rig")) {
    const Settings rig = s.table("rig");
    set.compliance_mm_per_N = read_known(rig, "compliance_mm_per_N", {0, 1e3});
    set.gain = read_known(rig, "gain", {0.1, 10});
    set.sync_error_s = rig.real("sync_error_s", 0, {0, 10});
  }
  if (s.has("tool")) {
    const Settings tools = s.table("tool");
    for (const std::string& name : tools.keys()) set.tools[name] = read_tool(tools.table(name));
  }
  if (s.has("noise")) set.sensor_sd_N = read_known(s.table("noise"), "sensor_sd_N", {1e-12, 1e3});
  for (const Settings& table : s.tables("run")) {
    Run run = read_run(table, set, static_cast<int>(set.runs.size()) + 1);
    if (std::any_of(set.runs.begin(), set.runs.end(), [&](const Run& other) { return other.id == run.id; }))
      throw Failure(ExitCode::misuse, "two runs are called " + run.id, table.where(table.has("id") ? "id" : "file"), "an id of its own for each");
    set.runs.push_back(std::move(run));
  }
  if (set.runs.empty()) throw Failure(ExitCode::misuse, "a set without runs", s.where(), "[[run]] with id and file");
  for (Run& run : set.runs)
    for (const Run& other : set.runs)
      if (other.order < run.order) run.session_s += other.t.back() - other.t.front() + run.rest_before_s;
  const bool indents = std::any_of(set.runs.begin(), set.runs.end(), [](const Run& r) { return r.test == Test::indentation; });
  if (indents && set.specimen.case_file.empty() && set.specimen.shape.empty())
    throw Failure(ExitCode::misuse, "an indentation of a specimen without shape", s.where("specimen"),
                  "[specimen] case = \"case.toml\", or shape = \"block\" and its size");
  s.expect_all_read();
  mark_unusable(set);
  return set;
}

}  // namespace palpate::loop
