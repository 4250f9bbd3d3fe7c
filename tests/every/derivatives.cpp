// Every law's numbers and every tool's shape and pose: derivatives of the force against central differences of whole runs over the same steps.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <solver/contact/tool.hpp>
#include <tests/verify/case_runs.hpp>

using namespace palpate;

// Beside the other tests of laws and tools: the name of a test shows these.
namespace palpate::materials {
void PrintTo(const Law& tested, std::ostream* out);
}
namespace palpate::tools {
void PrintTo(const Shape& tested, std::ostream* out);
}

namespace {

const std::string base = "[base]\nplane = { point_mm = [0.0, 0.0, 0.01], normal = [0.0, 0.0, 1.0] }\n";
/// `depth`: the deepest, mm.
std::string pose(const std::string& depth, int steps) {
  return "aim_mm = [0.3, 0.2, 5.0]\naxis = [0.1, 0.0, -1.0]\npath = [[0, 0], [1, " + depth + "], [2, 0.4]]\n[steps]\ncount = " + std::to_string(steps) + "\n";
}

class EveryLaw : public verify::CaseRuns, public testing::WithParamInterface<materials::Law> {
 protected:
  /// Its numbers as they are typical, directions away from what the block mirrors, ν away from the end of its range.
  std::string table(std::vector<std::string>& numbers) const {
    std::ostringstream out;
    out << "[material]\nlaw = \"" << GetParam().entry.name << "\"\n";
    const auto& parameters = GetParam().entry.parameters;
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      const bool direction = parameters[i].name.starts_with("axis_") || parameters[i].name.starts_with("side_");
      out << parameters[i].name << " = " << (parameters[i].name == "nu" ? 0.4 : parameters[i].typical + (direction ? 0.07 * i : 0)) << "\n";
      numbers.push_back("material." + parameters[i].name);
    }
    return out.str();
  }
};

}  // namespace

TEST_P(EveryLaw, EveryNumberHasItsDerivative) {
  std::vector<std::string> numbers;
  std::string law = table(numbers);
  if (GetParam().volume_terms == 0 && GetParam().bulk_modulus == materials::incompressible) {
    law += "kappa = 0.2\n";
    numbers.push_back("material.kappa");
  }
  std::vector<double> typical;
  for (const auto& p : GetParam().entry.parameters) typical.push_back(p.typical);
  const double parts[] = {2, 0.05, 1e-4};  // as soft in volume as in shear, so that the higher terms count
  for (int i = 1; i <= GetParam().volume_terms; ++i) {
    law += "D" + std::to_string(i) + " = " + std::to_string(parts[i - 1] / GetParam().shear_modulus(typical)) + "\n";
    numbers.push_back("material.D" + std::to_string(i));
  }
  write(law + base + "[tool]\nkind = \"ball\"\nradius_mm = 3.0\n" + pose("0.9", 5));
  expect_derivatives(numbers);
}

INSTANTIATE_TEST_SUITE_P(Catalogue, EveryLaw, testing::ValuesIn(materials::all()), [](const auto& tested) { return tested.param.entry.name; });

namespace {

/// Sizes for a block of 10 mm.
double size_of(const std::string& name, double typical) {
  if (name == "edge_radius_mm") return 0.6;
  if (name == "dome_radius_mm") return 8;
  if (name == "radius_mm") return 1.8;
  if (name == "width_mm") return 3;
  if (name == "length_mm") return 5;
  return typical;
}

class EveryShape : public verify::CaseRuns, public testing::WithParamInterface<tools::Shape> {};

std::vector<tools::Shape> analytic() {
  auto list = tools::all();
  std::erase_if(list, [](const tools::Shape& shape) { return shape.read != nullptr; });
  return list;
}

}  // namespace

TEST_P(EveryShape, SizePoseAndWayHaveTheirDerivatives) {
  std::ostringstream tool;
  std::vector<std::string> numbers = {"tool.path[1][1]", "tool.path[2][1]", "tool.axis[0]", "tool.axis[1]"};
  tool << "[tool]\nkind = \"" << GetParam().entry.name << "\"\n";
  for (const auto& p : GetParam().entry.parameters) {
    tool << p.name << " = " << size_of(p.name, p.typical) << "\n";
    if (p.name != "height_mm") numbers.push_back("tool." + p.name);  // of the far side
  }
  if (GetParam().entry.name != "plane") numbers.insert(numbers.end(), {"tool.aim_mm[0]", "tool.aim_mm[1]"});
  write("[material]\nlaw = \"neo_hookean\"\nmu = 0.0067\n" + base + tool.str() + pose("0.6", 6));
  expect_derivatives(numbers);
}

INSTANTIATE_TEST_SUITE_P(Catalogue, EveryShape, testing::ValuesIn(analytic()), [](const auto& tested) { return tested.param.entry.name; });
