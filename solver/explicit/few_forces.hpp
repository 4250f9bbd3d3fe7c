// Forces on a few of the wall's nodes: only those are cleared and read, so that what nothing touches stays where it is in both cores' caches.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include <solver/explicit/wall.hpp>

namespace palpate::explicit_shell {

class FewForces {
 public:
  explicit FewForces(std::size_t nodes) : force_(nodes, Lanes{}), has_(nodes, 0) {}
  void add(int node, const Lanes& force) {
    if (!has_[node]) nodes_.push_back(node), has_[node] = 1;
    force_[node] += force;
  }
  void clear() {
    for (int i : nodes_) force_[i] = Lanes{}, has_[i] = 0;
    nodes_.clear();
  }
  const std::vector<int>& nodes() const { return nodes_; }
  const Lanes& operator[](std::size_t node) const { return force_[node]; }

 private:
  std::vector<Lanes> force_;
  std::vector<char> has_;
  std::vector<int> nodes_;
};

}  // namespace palpate::explicit_shell
