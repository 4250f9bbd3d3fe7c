// What is exactly known of a phantom: volumes by integration of the implicit shapes, surface, and points for whoever writes a case.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <palpate/json.hpp>
#include <palpate/mesh_files.hpp>
#include <pipeline/image/phantom_spec.hpp>

namespace palpate {

struct Moments {
  double volume_mm3 = 0;
  Vec3 centroid_mm{0, 0, 0};
};

/// ∫ over f < 0 by halving cells of the box `depth` times where f = 0 may pass. Error falls with 4^−depth; depth ≥ 2.
Moments integrate(const Implicit& f, const Box& box, int depth, int threads);

/// The part `index` alone: inside the organ and outside the parts before it.
Implicit part_alone(const Organ& organ, int index);

/// The organ's boundary, region 1, triangles about 1/180 of the box's diagonal.
Surface truth_surface(const Organ& organ, int threads);

/// Volumes with error estimate, area, box, centroid, seed, and where a tool along the organ's thickness enters and leaves.
Json truth_facts(const PhantomSpec& spec, const Grid& grid, const Surface& surface, int threads);

}  // namespace palpate
