// Which voxels are the organ: chosen labels, cropped, without small pieces and closed cavities.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <set>
#include <vector>

#include <palpate/volume.hpp>

namespace palpate {

/// 1 inside, 0 outside.
using Mask = Volume<std::uint8_t>;

/// One piece of foreground or cavity.
struct Piece {
  std::size_t voxels = 0;
  double mm3 = 0;
  Vec3 centre_mm{0, 0, 0};  ///< mean of its voxel centres, LPS
};

/// What was done to get from labels to mask.
struct MaskLedger {
  std::vector<Piece> kept, dropped;  ///< largest first
  std::vector<Piece> filled;         ///< cavities closed on all sides, largest first
  double mm3 = 0;                    ///< of the mask: kept plus filled
};

struct MaskOptions {
  std::set<int> labels;     ///< empty: every label above zero
  int largest = 0;          ///< keep this many pieces, the largest; 0: all that reach `min_piece`
  double min_piece = 0.01;  ///< fraction of the largest piece
  bool keep_cavities = false;
};

/// All labels above zero that occur.
std::set<int> labels_present(const Labels& labels);

/// True when a voxel above zero lies on the outermost layer: the scan cuts the organ.
bool cut_by_border(const Labels& labels);

/// The labels in their bounding box (of all voxels above zero), padded by one empty voxel on every side; a whole organ stays
/// whole. Throws Failure(check_failed) when there is none.
Labels crop(const Labels& labels);

/// The mask of the chosen labels: pieces joined over faces. `labels` must have an empty border (see crop).
/// Throws Failure(misuse) for a label that is absent, naming those present.
Mask organ_mask(const Labels& labels, const MaskOptions& options, MaskLedger& ledger);

}  // namespace palpate
