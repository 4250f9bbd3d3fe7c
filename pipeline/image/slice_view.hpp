// How a slice is hung on the wall: patient right on the left, anterior or head on top, as radiologists do.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <palpate/volume.hpp>

namespace palpate {

/// Voxel axes of a slice as shown. Patient directions are those nearest to the axes: of an oblique scan, roughly.
struct SliceView {
  int through = 2;                                        ///< voxel axis along which slices follow one another
  int across = 0;                                         ///< voxel axis shown from left to right
  int down = 1;                                           ///< voxel axis shown from top to bottom
  bool flip_across = false, flip_down = false;            ///< shown against the direction of the index
  char left = 'R', right = 'L', top = 'A', bottom = 'P';  ///< patient directions at the edges; H head, F feet
  int normal = 2;                                         ///< nearest patient axis of the slices' normal: 0 x, 1 y, 2 z (LPS)
  int patient_across = 0, patient_down = 1;               ///< nearest patient axes of `across` and `down`
};

/// The view of the slices that follow one another along the voxel axis `through`.
SliceView view_through(const Grid& grid, int through);

/// Index along a voxel axis of what is shown at place `n` (a place may lie between voxels).
inline double index_shown_at(double n, int voxels, bool flip) { return flip ? voxels - 1 - n : n; }

/// The voxel axis whose slices show most: the one with the largest spacing; of equal ones the last.
int coarsest_axis(const Grid& grid);

}  // namespace palpate
