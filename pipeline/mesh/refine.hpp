// Finer tetrahedra where they are asked for, by longest-edge bisection: surface and volume are kept exactly, shapes nearly.
// (Rivara 1997, New longest-edge algorithms for the refinement and/or improvement of unstructured triangulations, Int. J. Numer. Meth. Eng. 40:3313.)
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include <pipeline/mesh/carried_mesh.hpp>

namespace palpate {

/// Tetrahedra of the first mesh with a target (mm, 0: none) are bisected until no edge of theirs, as it is now, is longer than that. Neighbours
/// are bisected as far as a mesh without hanging nodes needs it.
void refine(CarriedMesh& mesh, const std::vector<double>& target_mm);

}  // namespace palpate
