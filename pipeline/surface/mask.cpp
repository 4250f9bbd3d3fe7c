// Pieces by flood fill over voxel faces.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/surface/mask.hpp>

#include <algorithm>
#include <string>

#include <palpate/errors.hpp>

namespace palpate {
namespace {

/// Pieces of equal mask value, in scan order; `piece_of` gets the index of each voxel's piece, -1 where the value differs.
std::vector<Piece> pieces_of(const Mask& mask, std::uint8_t value, std::vector<int>& piece_of) {
  const auto& size = mask.grid.size;
  const std::array<std::ptrdiff_t, 3> stride{1, size[0], std::ptrdiff_t(size[0]) * size[1]};
  piece_of.assign(mask.voxels.size(), -1);
  std::vector<Piece> pieces;
  std::vector<std::size_t> front;
  for (std::size_t seed = 0; seed < mask.voxels.size(); ++seed) {
    if (mask.voxels[seed] != value || piece_of[seed] >= 0) continue;
    Piece piece;
    Vec3 sum{0, 0, 0};
    front.assign(1, seed);
    piece_of[seed] = static_cast<int>(pieces.size());
    while (!front.empty()) {
      const std::size_t at = front.back();
      front.pop_back();
      const std::array<int, 3> ijk{int(at % size[0]), int(at / size[0] % size[1]), int(at / stride[2])};
      ++piece.voxels;
      sum = sum + Vec3{double(ijk[0]), double(ijk[1]), double(ijk[2])};
      for (int axis = 0; axis < 3; ++axis)
        for (int step : {-1, 1}) {
          if (ijk[axis] + step < 0 || ijk[axis] + step >= size[axis]) continue;
          const std::size_t next = at + step * stride[axis];
          if (mask.voxels[next] != value || piece_of[next] >= 0) continue;
          piece_of[next] = static_cast<int>(pieces.size());
          front.push_back(next);
        }
    }
    piece.mm3 = piece.voxels * mask.grid.voxel_mm3();
    piece.centre_mm = mask.grid.lps_from_voxel((1.0 / piece.voxels) * sum);
    pieces.push_back(piece);
  }
  return pieces;
}

void sort_largest_first(std::vector<Piece>& pieces) {
  std::stable_sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.voxels > b.voxels; });
}

void set_pieces(Mask& mask, const std::vector<int>& piece_of, const std::vector<bool>& chosen, std::uint8_t value) {
  for (std::size_t v = 0; v < mask.voxels.size(); ++v)
    if (piece_of[v] >= 0 && chosen[piece_of[v]]) mask.voxels[v] = value;
}

void drop_small_pieces(Mask& mask, const MaskOptions& options, MaskLedger& ledger) {
  std::vector<int> piece_of;
  const auto pieces = pieces_of(mask, 1, piece_of);
  std::vector<std::size_t> order(pieces.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return pieces[a].voxels > pieces[b].voxels; });
  std::vector<bool> dropped(pieces.size(), false);
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    const Piece& piece = pieces[order[rank]];
    const bool keep =
        options.largest > 0 ? rank < std::size_t(options.largest) : piece.voxels >= options.min_piece * pieces[order[0]].voxels;
    (keep ? ledger.kept : ledger.dropped).push_back(piece);
    dropped[order[rank]] = !keep;
  }
  set_pieces(mask, piece_of, dropped, 0);
}

/// Background that does not reach the empty border is a cavity.
void fill_cavities(Mask& mask, MaskLedger& ledger) {
  std::vector<int> piece_of;
  const auto pieces = pieces_of(mask, 0, piece_of);
  std::vector<bool> cavity(pieces.size(), true);
  cavity[piece_of[0]] = false;  // the border is one piece, and voxel 0 lies on it
  for (std::size_t i = 0; i < pieces.size(); ++i)
    if (cavity[i]) ledger.filled.push_back(pieces[i]);
  sort_largest_first(ledger.filled);
  set_pieces(mask, piece_of, cavity, 1);
}

std::string list(const std::set<int>& labels) {
  std::string text;
  for (int label : labels) text += (text.empty() ? "" : ", ") + std::to_string(label);
  return text;
}

}  // namespace

std::set<int> labels_present(const Labels& labels) {
  std::vector<bool> seen(65536, false);
  for (auto label : labels.voxels) seen[label] = true;
  std::set<int> present;
  for (int label = 1; label < 65536; ++label)
    if (seen[label]) present.insert(label);
  return present;
}

bool cut_by_border(const Labels& labels) {
  const auto& size = labels.grid.size;
  for (int k = 0; k < size[2]; ++k)
    for (int j = 0; j < size[1]; ++j) {
      const bool face = k == 0 || k == size[2] - 1 || j == 0 || j == size[1] - 1;
      for (int i = 0; i < size[0]; i += face ? 1 : std::max(1, size[0] - 1))
        if (labels(i, j, k) != 0) return true;
    }
  return false;
}

Labels crop(const Labels& labels) {
  const auto& size = labels.grid.size;
  std::array<int, 3> low = size, high{-1, -1, -1};
  for (int k = 0; k < size[2]; ++k)
    for (int j = 0; j < size[1]; ++j)
      for (int i = 0; i < size[0]; ++i) {
        if (labels(i, j, k) == 0) continue;
        const std::array<int, 3> ijk{i, j, k};
        for (int axis = 0; axis < 3; ++axis) {
          low[axis] = std::min(low[axis], ijk[axis]);
          high[axis] = std::max(high[axis], ijk[axis]);
        }
      }
  if (high[0] < 0)
    throw Failure(ExitCode::check_failed, "the labels are empty: no voxel above zero", "",
                  "look at the labels' contact sheet; segment again with other thresholds or seeds");
  Labels box;
  for (int axis = 0; axis < 3; ++axis) box.grid.size[axis] = high[axis] - low[axis] + 3;
  box.grid.lps_from_voxel = labels.grid.lps_from_voxel;
  box.grid.lps_from_voxel.origin = labels.grid.lps_from_voxel({low[0] - 1.0, low[1] - 1.0, low[2] - 1.0});
  box.voxels.assign(box.grid.count(), 0);
  for (int k = low[2]; k <= high[2]; ++k)
    for (int j = low[1]; j <= high[1]; ++j)
      for (int i = low[0]; i <= high[0]; ++i) box(i - low[0] + 1, j - low[1] + 1, k - low[2] + 1) = labels(i, j, k);
  return box;
}

Mask organ_mask(const Labels& labels, const MaskOptions& options, MaskLedger& ledger) {
  const std::set<int> present = labels_present(labels);
  for (int label : options.labels)
    if (!present.contains(label))
      throw Failure(ExitCode::misuse, "no voxel has the label " + std::to_string(label), "--labels",
                    "present are: " + list(present));
  Mask mask{labels.grid, std::vector<std::uint8_t>(labels.voxels.size(), 0)};
  for (std::size_t v = 0; v < mask.voxels.size(); ++v)
    mask.voxels[v] = labels.voxels[v] != 0 && (options.labels.empty() || options.labels.contains(labels.voxels[v]));
  drop_small_pieces(mask, options, ledger);
  if (!options.keep_cavities) fill_cavities(mask, ledger);
  for (auto voxel : mask.voxels) ledger.mm3 += voxel * mask.grid.voxel_mm3();
  return mask;
}

}  // namespace palpate
