// Edit distance by dynamic programming: d(i,j) = min(d(i−1,j)+1, d(i,j−1)+1, d(i−1,j−1)+[a_i ≠ b_j]).
// SPDX-License-Identifier: GPL-3.0-or-later
#include <palpate/nearest.hpp>

#include <algorithm>
#include <numeric>

namespace palpate {
namespace {

std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t substitute = diagonal + (a[i] != b[j]);
      diagonal = row[j + 1];
      row[j + 1] = std::min({row[j] + 1, diagonal + 1, substitute});
    }
  }
  return row[b.size()];
}

}  // namespace

std::string nearest_name(const std::string& name, const std::vector<std::string>& known) {
  const auto best = std::min_element(
      known.begin(), known.end(), [&](const auto& a, const auto& b) { return edit_distance(name, a) < edit_distance(name, b); });
  return best == known.end() ? "" : *best;
}

}  // namespace palpate
