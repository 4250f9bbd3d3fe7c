// The graph of nodes, and METIS on it.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/implicit/ordering.hpp>

#include <metis.h>

#include <algorithm>
#include <stdexcept>

namespace palpate::implicit {
namespace {

constexpr int per_node = 4;

}  // namespace

std::vector<int> nested_dissection(int unknowns, const std::vector<int>& rows, const std::vector<int>& columns) {
  idx_t nodes = unknowns / per_node;
  std::vector<std::vector<idx_t>> around(nodes);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const int i = (rows[k] - 1) / per_node, j = (columns[k] - 1) / per_node;
    if (i == j || (!around[i].empty() && around[i].back() == j)) continue;  // a block's entries come one after the other
    around[i].push_back(j);
    around[j].push_back(i);
  }
  std::vector<idx_t> starts{0}, neighbours;
  for (auto& list : around) {
    std::sort(list.begin(), list.end());
    neighbours.insert(neighbours.end(), list.begin(), std::unique(list.begin(), list.end()));
    starts.push_back(static_cast<idx_t>(neighbours.size()));
  }
  std::vector<idx_t> nodes_in_order(nodes), places(nodes);
  if (METIS_NodeND(&nodes, starts.data(), neighbours.data(), nullptr, nullptr, nodes_in_order.data(), places.data()) != METIS_OK)
    throw std::logic_error("METIS could not order the equations");
  std::vector<int> order(unknowns);
  for (int k = 0; k < unknowns; ++k) order[k] = per_node * static_cast<int>(places[k / per_node]) + k % per_node + 1;
  return order;
}

}  // namespace palpate::implicit
