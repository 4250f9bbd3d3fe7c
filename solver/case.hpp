// A case file (TOML, schema palpate-case/1): mesh, materials, what holds, loads and presses, steps; and the model it describes.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <palpate/mesh_files.hpp>
#include <palpate/settings.hpp>
#include <solver/implicit/model.hpp>
#include <solver/implicit/steps.hpp>
#include <solver/remesh_marks.hpp>

namespace palpate {

/// A patch of surface with a prescribed motion.
struct Moved {
  std::set<int> nodes;
  Eigen::Vector3d motion_mm;  ///< times the amplitude
  int amplitude = 0;
};

/// Nodes that stay on a plane of symmetry: their component `axis` is zero.
struct Symmetry {
  std::set<int> nodes;
  int axis = 0;
};

/// A table [[effect]]: of the tissue, or of the region that it names.
struct GivenEffect : effects::Active {
  std::string region;  ///< or empty: everywhere
  std::string where;   ///< "file:line", for people
  int tool = 0;        ///< of a traction: whose, from 1; 0: every tool's
};

struct Case {
  std::filesystem::path mesh_path;
  TetMesh mesh;                 ///< as its file has it; effects may have changed the rest shape, which is the model's
  implicit::Model model;
  implicit::StepPlan settling;  ///< steps of gravity and of layers, from t = −1 to 0, before the tools come; no times without them
  implicit::StepPlan steps;
  int count = 20;               ///< of steps
  int frames = 5;            ///< besides the one at rest
  std::optional<RemeshRules> remesh;
  bool keep_partial = false; ///< deliver what was reached when the full depth is not
  std::set<int> base;        ///< nodes that are held
  std::vector<std::string> material_regions;  ///< of each material: a region's name, or empty: all of the mesh
  std::vector<GivenEffect> effects;
  std::vector<Moved> moved;
  std::vector<Symmetry> symmetries;
  std::vector<std::vector<std::string>> contacts;  ///< names of the two regions, or of the one that touches itself
  std::vector<Eigen::Vector3d> aims_mm;  ///< of the tools
  std::vector<std::filesystem::path> tool_files;  ///< of the tools that have one
};

/// The mesh in the model's rest shape.
TetMesh rest_mesh(const Case& c);

/// The surface, at rest or deformed by `state`, mm.
std::vector<std::array<Eigen::Vector3d, 3>> surface_triangles(const Case& c, const implicit::State* state);

/// Reads a case; `mesh_override` replaces its mesh unless empty. Throws Failure(misuse) for keys, values and names, with line;
/// Failure(unreadable) for the mesh; Failure(misuse) when the base holds nothing or the tool misses the organ.
Case read_case(const std::filesystem::path& path, const std::filesystem::path& mesh_override);
Case read_case(const Settings& settings, const std::filesystem::path& mesh_override);

/// Part of `palpate list`: loads and supports with tables of their own.
std::vector<CatalogueEntry> load_entries();

/// While gravity grows the tools are out of reach.
void take_tools_away(Case& c);
/// Where they first touch the organ in `state`. Throws Failure(misuse) when one of them misses it.
void bring_tools(Case& c, const implicit::State& state);

}  // namespace palpate
