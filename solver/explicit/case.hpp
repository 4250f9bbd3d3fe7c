// A case of the explicit scheme (scheme = "explicit"): a thin wall between two jaws.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>

#include <palpate/json.hpp>
#include <palpate/settings.hpp>
#include <solver/explicit/beds.hpp>
#include <solver/explicit/jaws.hpp>

namespace palpate::explicit_shell {

struct Case {
  std::filesystem::path mesh_path;
  ShellMesh mesh;
  Wall wall;
  Holds holds;
  Clamp clamp;
  Tissue tissue;            ///< what effects add to the law
  std::vector<Bed> beds;    ///< effects on the forces
  Json law;                 ///< name and parameters, for the summary
  double duration = 0;      ///< s; 0: the closing and a tenth more
  double safety = 0.7;      ///< of the stable step: what is left carries the contact's penalties
  double damping = 10;      ///< 1/s, of all velocities of the wall
  double self_friction = 0;
  double least_step = 0;    ///< s: nodes get mass until every triangle is stable with it; 0: none
  double rest_part = 0;     ///< of the internal energy, that the kinetic one is brought below at the end; 0: it is not
  double kinetic_part = 0;  ///< of the internal energy, that the jaws wait for; 0: they do not
  double settle = 0;        ///< s before the jaws begin: layers' tensions grow, the wall comes to rest
  int frames = 10, rows = 200;
  int works = 0;            ///< moments of the closing for stress_works.csv
  bool keep_partial = false;
};

/// Throws Failure(misuse) for keys, values and names, with line; Failure(unreadable) for the mesh.
Case read_case(const std::filesystem::path& path, const std::filesystem::path& mesh_override);

}  // namespace palpate::explicit_shell
