// The candidates of a set: every effect of the catalogue over its grid, or the reason why it is left out (sieves that cost no fit).
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <loop/methods/problem.hpp>

namespace palpate::loop {

struct Candidate {
  const Effect* effect = nullptr;
  std::vector<std::vector<double>> grid;
  double probe = 0;    ///< amplitude of secants
  std::string pruned;  ///< why it is left out; empty: it is not
  bool is_signed() const { return effect->entry.parameters[0].range.min < 0; }
  double largest() const;  ///< the largest size of the amplitude that is plausible
};

/// Effects that are absent come too, with their reason.
std::vector<Candidate> candidates_of(const Set& set);

/// A candidate's columns under a model: one per grid point.
struct Column {
  int candidate = 0, grid = 0;
};
std::vector<Column> columns_of(const std::vector<Candidate>& candidates);
/// Secants of all columns.
Stacked secants(const Problem& problem, Model& model, const std::vector<Candidate>& candidates, const std::vector<Column>& columns);

}  // namespace palpate::loop
