// gmsh's own options, set once for all that is asked of it.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/mesh/gmsh_session.hpp>

#include <gmsh.h>

namespace palpate {

GmshSession::GmshSession() {
  gmsh::initialize(0, nullptr, false);
  for (const char* off : {"General.Terminal", "General.AbortOnError", "Mesh.MeshSizeExtendFromBoundary", "Mesh.MeshSizeFromPoints",
                          "Mesh.MeshSizeFromCurvature", "Mesh.Renumber"})
    gmsh::option::setNumber(off, 0);
  for (const char* one : {"General.NumThreads", "Mesh.MaxNumThreads1D", "Mesh.MaxNumThreads2D", "Mesh.MaxNumThreads3D", "Mesh.Algorithm3D"})
    gmsh::option::setNumber(one, 1);
  gmsh::option::setNumber("Mesh.RandomFactor3D", 1e-12);
  gmsh::option::setNumber("Mesh.RandomSeed", 1);
  gmsh::logger::start();
  gmsh::model::add("palpate");
}

GmshSession::~GmshSession() {
  gmsh::logger::stop();
  gmsh::finalize();
}

std::vector<std::string> GmshSession::lines(const std::string& level) const {
  std::vector<std::string> log, chosen;
  gmsh::logger::get(log);
  for (const auto& line : log)
    if (line.starts_with(level)) chosen.push_back(line.substr(line.find(':') + 2));
  return chosen;
}

}  // namespace palpate
