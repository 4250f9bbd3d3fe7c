// Isotropic remeshing by CGAL.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/surface/remesh.hpp>

#include <CGAL/Polygon_mesh_processing/remesh.h>

#include <stdexcept>

#include <pipeline/surface/cgal_mesh.hpp>

namespace palpate {

Surface remesh(const Surface& surface, double edge_mm, int iterations) {
  auto mesh = to_cgal(surface);
  if (!mesh) throw std::logic_error("remesh: the surface is not an oriented manifold");
  CGAL::Polygon_mesh_processing::isotropic_remeshing(
      mesh->faces(), edge_mm, *mesh, CGAL::parameters::number_of_iterations(iterations).number_of_relaxation_steps(3));
  return from_cgal(*mesh);
}

}  // namespace palpate
