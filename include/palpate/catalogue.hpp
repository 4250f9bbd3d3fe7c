// What a program offers by name: laws, elements, tools, methods. `palpate list` prints all of them; the loop reads that list.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <limits>
#include <string>
#include <vector>

#include <palpate/json.hpp>

namespace palpate {

/// Closed interval of allowed values.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool contains(double x) const { return x >= min && x <= max; }
};

/// One number a catalogue entry takes. `typical` lies in `range`.
struct Parameter {
  std::string name;
  std::string unit;
  Range range;
  double typical = 0;
  std::string meaning;
};

struct CatalogueEntry {
  std::string kind;       ///< material, element, contact, tool, segmentation, repair, …
  std::string name;       ///< the name a file uses
  std::string sentence;   ///< what it is, in one sentence
  std::string reference;  ///< author, year, equation
  std::vector<Parameter> parameters;
};

Json to_json(const CatalogueEntry& entry);

/// A number as JSON writes it; infinite bounds become null.
Json finite_or_null(double x);

}  // namespace palpate
