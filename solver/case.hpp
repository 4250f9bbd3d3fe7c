// A case file (TOML, schema palpate-case/1): mesh, material, base, tool, steps; and the model it describes.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>

#include <palpate/mesh_files.hpp>
#include <palpate/settings.hpp>
#include <solver/implicit/model.hpp>
#include <solver/implicit/steps.hpp>

namespace palpate {

struct Case {
  std::filesystem::path mesh_path;
  TetMesh mesh;
  implicit::Model model;
  implicit::StepPlan steps;
  double speed_mm_s = 1;
  int frames = 5;            ///< besides the one at rest
  bool keep_partial = false; ///< deliver what was reached when the full depth is not
  int base_nodes = 0;
  Eigen::Vector3d aim_mm;
};

/// Reads a case; `mesh_override` replaces its mesh unless empty. Throws Failure(misuse) for keys, values and names, with line;
/// Failure(unreadable) for the mesh; Failure(misuse) when the base holds nothing or the tool misses the organ.
Case read_case(const std::filesystem::path& path, const std::filesystem::path& mesh_override);

}  // namespace palpate
