// Connected pieces by flooding.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/components.hpp>

#include <algorithm>

namespace palpate {
namespace {

template <class Keep>
Mask pieces_where(const Components& components, Keep&& keep) {
  Mask kept{components.piece.grid, std::vector<std::uint8_t>(components.piece.voxels.size(), 0)};
  for (std::size_t p = 0; p < kept.voxels.size(); ++p) {
    const int piece = components.piece.voxels[p];
    kept.voxels[p] = piece > 0 && keep(piece);
  }
  return kept;
}

std::vector<VoxelIndex> border_voxels(const Grid& grid) {
  std::vector<VoxelIndex> border;
  const auto& n = grid.size;
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j) {
      const bool whole_row = k == 0 || k == n[2] - 1 || j == 0 || j == n[1] - 1;
      for (int i = 0; i < n[0]; i += whole_row ? 1 : std::max(1, n[0] - 1)) border.push_back({i, j, k});
    }
  return border;
}

}  // namespace

Components components_of(const Mask& mask) {
  Components found{{mask.grid, std::vector<int>(mask.voxels.size(), 0)}, {}};
  std::vector<std::size_t> front;
  for (std::size_t start = 0; start < mask.voxels.size(); ++start) {
    if (!mask.voxels[start] || found.piece.voxels[start]) continue;
    const int piece = static_cast<int>(found.voxels.size()) + 1;
    std::size_t count = 0;
    const auto enter = [&](std::size_t p) {
      if (!mask.voxels[p] || found.piece.voxels[p]) return;
      found.piece.voxels[p] = piece;
      ++count;
      front.push_back(p);
    };
    enter(start);
    while (!front.empty()) {
      const std::size_t p = front.back();
      front.pop_back();
      for_each_face_neighbour(mask.grid, p, enter);
    }
    found.voxels.push_back(count);
  }
  return found;
}

Mask largest_piece(const Mask& mask) {
  const Components found = components_of(mask);
  const auto largest = std::max_element(found.voxels.begin(), found.voxels.end());
  const int piece = static_cast<int>(largest - found.voxels.begin()) + 1;
  return pieces_where(found, [&](int p) { return p == piece; });
}

Mask pieces_with(const Mask& mask, const std::vector<VoxelIndex>& seeds) {
  return flooded(mask.grid, seeds, [&](std::size_t p) { return mask.voxels[p] != 0; });
}

Mask pieces_of_at_least(const Mask& mask, std::size_t voxels) {
  const Components found = components_of(mask);
  return pieces_where(found, [&](int p) { return found.voxels[p - 1] >= voxels; });
}

Mask holes_filled(const Mask& mask) {
  Mask outside = flooded(mask.grid, border_voxels(mask.grid), [&](std::size_t p) { return mask.voxels[p] == 0; });
  for (auto& v : outside.voxels) v = !v;
  return outside;
}

}  // namespace palpate
