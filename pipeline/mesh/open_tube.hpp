// An open tube from a closed surface: flat ends taken off, or cut away between two planes; moved outward to the wall's mid-surface.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <palpate/mesh_files.hpp>
#include <pipeline/mesh/centre_line.hpp>

namespace palpate {

/// Without the triangles of regions named "end…", and without the points only they use.
Surface without_ends(const Surface& surface);

/// Every point moved by `distance` (mm, negative inward) along the mean normal of its triangles, weighted by their angles there.
Surface moved_outward(const Surface& surface, double distance);

/// What lies between the planes at right angles to the centre line at arc lengths `from` and `to`. Points within a tenth of the edge
/// length of a plane are put on it. Throws Failure(misuse) when nothing is left.
Surface cut_between(const Surface& surface, const CentreLine& line, double from, double to);

/// The rims: loops of points on open edges, each in the order of its edges, the one with the smallest point first.
std::vector<std::vector<int>> rims(const std::vector<std::array<int, 3>>& triangles);

}  // namespace palpate
