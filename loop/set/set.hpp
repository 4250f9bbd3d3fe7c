// A measured set: specimen, rig, tools and runs, as set.toml and its CSV files say it (schema palpate-set/1).
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <palpate/vec3.hpp>
#include <loop/methods/thresholds.hpp>

namespace palpate::loop {

/// What a run is. The homogeneous tests come after the indentation.
enum class Test { indentation, uniaxial, equibiaxial, pure_shear, simple_shear };

/// A quantity of the rig: not mentioned, known, known with a standard deviation (a prior), or declared unknown (a candidate).
struct Known {
  enum class State { absent, given, prior, unknown } state = State::absent;
  double value = 0, sd = 0;
  bool is_candidate() const { return state == State::absent || state == State::unknown; }
};

struct Tool {
  std::string kind;  ///< ball or flat_punch for the closed forms; any tool of palpate-solve for a case
  double radius_mm = 0;
  double width_mm = 40, length_mm = 10;  ///< of a clamp's jaws ("jaws"), across the tube and along it
  bool is_flat() const { return kind.starts_with("flat"); }
};

struct Specimen {
  std::string id;
  std::filesystem::path case_file;  ///< empty: a simple shape, or homogeneous tests alone
  std::filesystem::path search_mesh;  ///< of a case: a coarser mesh of the same organ, on which what changes its curve is solved; empty: the case's own
  std::string shape;                ///< block, cylinder, ellipsoid, tube (for a clamp) or empty
  Vec3 size_mm{0, 0, 0};            ///< block: edges; cylinder, tube: diameter, diameter, height; ellipsoid: axes
  double wall_mm = 0;               ///< of a tube, as declared
  double edge_mm = 3;               ///< of the meshes a tube is solved on, at the jaws
  std::string ends = "section";     ///< of a tube, how they are held: palpate-solve's word
  bool bonded = true;               ///< the base; false: it slides without friction
  bool ring = false;                ///< the side is held by a ring
  std::string law = "neo_hookean";  ///< the null; "unknown": chosen by leave-one-run-out error
  std::map<std::string, double> parameters;  ///< start values that the set or its case gives
};

enum class Role { fit, holdout, calibration };

/// One file of measurements. Indentation: u in mm into the tissue, F in N, compression positive; so is a clamp's closing (test = "clamp"), u = declared outer diameter
/// less the gap between the jaws, point_mm the middle between them. Homogeneous tests: u is the
/// stretch (amount of shear for simple_shear), F the nominal stress in MPa, tension positive. Without a column t, t counts samples.
struct Run {
  std::string id, tool, zero = "geometry", replicate;
  std::filesystem::path file;
  Test test = Test::indentation;
  Role role = Role::fit;
  Vec3 point_mm{0, 0, 0}, axis{0, 0, -1};
  double zero_force_N = 0;  ///< of zero = "first_contact_…N"
  double zero_sd_mm = 0, rest_before_s = 0, rate_mm_s = 0;
  double session_s = 0;  ///< time from the session's begin to the run's: earlier runs and rests, by `order`
  int order = 0;
  bool timed = true;
  std::vector<double> t, u, F, Fx, Fy;
  std::vector<std::string> phase;  ///< of each sample: as written, or derived from u
  std::vector<int> cycle;
  std::vector<int> line;           ///< of each sample, in the file
  double turn_deg = 0;             ///< of the tool about its own axis
  std::vector<double> averaged;    ///< samples of the file behind each of ours (thinned)
  double fast_sd_N = 0;            ///< of one sample of the file
  std::string unused;              ///< why the loop cannot use it; empty: it can
  bool is_air() const { return all_are("air"); }
  bool is_block() const { return all_are("block"); }

 private:
  bool all_are(const char* name) const {
    return !phase.empty() && std::all_of(phase.begin(), phase.end(), [&](const std::string& p) { return p == name; });
  }
};

struct Set {
  std::filesystem::path file;
  Specimen specimen;
  Known compliance_mm_per_N, gain;
  double sync_error_s = 0;
  Known sensor_sd_N;  ///< absent: from air
  double curve_sd = thresholds::form_sd;            ///< what the elastic curve's shape over depth is off by, relative; a case's is told by its meshes (loop/forward/solved_curves.hpp),
  double tool_curve_sd = thresholds::form_tool_sd;  ///< the same from tool to tool,
  double tool_size_sd = thresholds::form_sd;        ///< and its size from tool to tool;
  double mesh_sd = 0, mesh_apart = 0;               ///< what a case's two meshes differ by in shape, rms, relative, and of how much of that its curve is still off by
  int clamp_forms = 0;                ///< ways in which a clamp's solved curves are off, as its solves tell (loop/forward/clamp_errors.hpp)
  double clamp_form_sd = 0;           ///< by how much, relative, mean over their places
  double clamp_correlation = 0;       ///< of what they are off by between these, from one block to the next
  std::map<std::string, Tool> tools;
  std::vector<Run> runs;
  std::vector<std::string> unknown_keys;  ///< "set.toml:12: key", read over
};

std::string test_name(Test test);
/// u of a specimen at rest: 1 where it is a stretch, otherwise 0.
double motion_at_rest(Test test);
/// Median speed of loading, of u per second; 0 where it cannot be told.
double loading_rate(const Run& run);

/// Reads a set and its files. Throws Failure(misuse) for keys of set.toml, by line; Failure(unreadable) for a missing file, a missing
/// column, a wrong unit or text where a number is due.
Set read_set(const std::filesystem::path& path);

/// Everything that makes the numbers unfit for the loop, in words, by file and line; empty when there is nothing.
std::vector<std::string> faults(const Set& set);

/// Things a person should know that do not stop the loop: no replicates, no air run, no sealed run.
std::vector<std::string> remarks(const Set& set);

}  // namespace palpate::loop
