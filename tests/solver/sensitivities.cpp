// Sensitivities against central differences of whole runs over the same steps: laws, effects with memory, tool, friction, loads.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <fstream>
#include <optional>

#include <palpate/errors.hpp>
#include <solver/results.hpp>
#include <solver/sensitivities.hpp>
#include <tests/verify/block_surface.hpp>
#include <tests/verify/shapes.hpp>
#include <tests/words/temporary_folder.hpp>

using namespace palpate;

namespace {

/// Rows of numbers of a CSV with a header.
std::vector<std::vector<double>> rows_of(const std::string& csv) {
  std::vector<std::vector<double>> rows;
  std::istringstream in(csv);
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(std::stod(cell));
  }
  return rows;
}

class SensitivitiesOfARun : public InFolder {
 protected:
  void write(const std::string& text) {
    write_mesh(folder / "mesh.vtu",
               verify::mesh_of(verify::brick(verify::uniform(-5, 5, 4), verify::uniform(-5, 5, 4), verify::uniform(0, 5, 2))));
    std::ofstream(folder / "case.toml") << "schema = \"palpate-case/1\"\n" << text;
  }

  /// Force along the motion at every reported step; with the table of its derivatives when `numbers` are given.
  std::vector<double> forces(const Settings& settings, const std::vector<std::string>& numbers = {}, std::string* table = nullptr) {
    Case c = read_case(settings, "");
    implicit::NewtonLimits limits;
    limits.tolerance = 1e-11;
    implicit::Equilibrium equilibrium(c.model, 1, limits);
    implicit::State state = implicit::rest_state(c.model);
    std::optional<Sensitivities> sensitivities;
    implicit::Observer follow;
    if (table) {
      sensitivities.emplace(settings, "", numbers, equilibrium, 1);
      follow = [&](const implicit::State& found) { sensitivities->follow(found); };
    }
    if (!c.settling.times.empty()) {
      take_tools_away(c);
      if (sensitivities) sensitivities->take_tools_away();
      implicit::run_steps(equilibrium, state, c.settling, [](const implicit::Step&) {}, follow);
      bring_tools(c, state);
      if (sensitivities) sensitivities->bring_tools();
    }
    std::vector<double> forces;
    const double reached = implicit::run_steps(equilibrium, state, c.steps, [&](const implicit::Step& step) {
      EXPECT_EQ(step.cuts, 0);  // or the differences would be of other steps
      forces.push_back(driven(c, step).force);
      if (sensitivities) sensitivities->add(step);
    }, follow);
    EXPECT_EQ(reached, c.steps.times.back()) << equilibrium.trouble().cause;
    if (sensitivities) *table = sensitivities->table();
    return forces;
  }

  /// Of second order: central, or of one side where the number is zero, the end of its range.
  std::vector<double> differences_of_runs(const Settings& settings, const std::string& number) {
    const double value = settings.number_at(number), h = value == 0 ? 1e-5 : 1e-5 * std::abs(value);
    const auto at = [&](double change) {
      Settings moved = Settings::read(folder / "case.toml");
      moved.shift(number, change);
      return forces(moved);
    };
    const auto here = value == 0 ? at(0) : at(-h), up = at(h), far = value == 0 ? at(2 * h) : up;
    std::vector<double> differences;
    for (std::size_t i = 0; i < up.size(); ++i)
      differences.push_back(value == 0 ? (4 * up[i] - 3 * here[i] - far[i]) / (2 * h) : (up[i] - here[i]) / (2 * h));
    return differences;
  }

  void expect_derivatives(const std::vector<std::string>& numbers) {
    const Settings settings = Settings::read(folder / "case.toml");
    std::string table;
    forces(settings, numbers, &table);
    const auto rows = rows_of(table);
    const std::size_t per_number = (rows[0].size() - 1) / numbers.size();
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      const auto differences = differences_of_runs(settings, numbers[k]);
      double largest = 0, worst = 0;
      for (std::size_t i = 0; i < differences.size(); ++i) {
        largest = std::max(largest, std::abs(differences[i]));
        worst = std::max(worst, std::abs(differences[i] - rows[i][1 + k * per_number]));
      }
      EXPECT_GT(largest, 0) << numbers[k];
      EXPECT_LE(worst, 1e-4 * largest) << numbers[k];
    }
  }
};

const std::string base = R"(
[base]
plane = { point_mm = [0.0, 0.0, 0.01], normal = [0.0, 0.0, 1.0] }
)";
const std::string top = "plane = { point_mm = [0.0, 0.0, 4.99], normal = [0.0, 0.0, -1.0] }\n";

}  // namespace

TEST_F(SensitivitiesOfARun, LawsAndEffectsThatRemember) {
  write(R"(
[material]
law = "fung_demiray"
mu = 0.0067
b = 1.3
[[effect]]
name = "permanent_set"
fraction = 0.2
yield = 0.03
[[effect]]
name = "mullins"
inverse_r = 0.3
m = 0.0005
[[effect]]
name = "rate"
m = 0.05
rate_0 = 0.01
[[effect]]
name = "prony"
g = [0.2, 0.0]
tau_s = [0.5, 5.0]
[tool]
kind = "ball"
radius_mm = 3.0
aim_mm = [0.3, 0.2, 5.0]
axis = [0.1, 0.0, -1.0]
path = [[0, 0], [1, 1.0], [2, 1.0], [3, 0.5], [4, 1.2]]
[steps]
count = 8
)" + base);
  expect_derivatives({"material.mu", "material.b", "effect[0].fraction", "effect[0].yield", "effect[1].inverse_r", "effect[1].m", "effect[2].m",
                      "effect[2].rate_0", "effect[3].g[0]", "effect[3].tau_s[0]", "effect[3].g[1]", "tool.aim_mm[0]", "tool.axis[0]",
                      "tool.radius_mm"});
}

TEST_F(SensitivitiesOfARun, FrictionRemembersToo) {
  write(R"(
[material]
law = "neo_hookean"
mu = 0.0067
kappa = 0.05
[tool]
kind = "ball"
radius_mm = 3.0
aim_mm = [0.3, 0.2, 5.0]
axis = [0.4, 0.0, -1.0]
friction = 0.2
path = [[0, 0], [1, 0.8], [2, 0.4], [3, 0.8]]
[steps]
count = 9
)" + base);
  expect_derivatives({"material.mu", "material.kappa", "tool.friction", "tool.radius_mm"});
}

TEST_F(SensitivitiesOfARun, LoadsAndSupport) {
  write(R"(
[material]
law = "mooney_rivlin"
C10 = 0.002
C01 = 0.0
[[effect]]
name = "prony"
g = 0.0
tau_s = 1.0
[[spring]]
stiffness_N_mm3 = 0.01
plane = { point_mm = [0.0, 0.0, 0.01], normal = [0.0, 0.0, 1.0] }
[gravity]
direction = [0.1, 0.0, -1.0]
steps = 2
acceleration_m_s2 = 9.81
[[displacement]]
motion_mm = [0.2, 0.0, -0.6]
)" + top + "[[force]]\ntotal_N = [0.01, 0.0, 0.0]\nbox = { min_mm = [4.9, -6, 1], max_mm = [6, 6, 4] }\n[steps]\ncount = 4\n");
  expect_derivatives({"material.C10", "material.C01", "effect[0].g", "spring[0].stiffness_N_mm3", "gravity.acceleration_m_s2",
                      "displacement[0].motion_mm[2]", "force[0].total_N[0]"});
}

TEST_F(SensitivitiesOfARun, ANumberThatIsNotThereIsRefused) {
  write("[material]\nlaw = \"neo_hookean\"\nmu = 0.0067\n[[displacement]]\nmotion_mm = [0, 0, -0.1]\n" + top + base);
  const Settings settings = Settings::read(folder / "case.toml");
  const Case c = read_case(settings, "");
  implicit::Equilibrium equilibrium(c.model, 1);
  for (const char* number : {"material.nu", "material.law", "effect[0].g", "displacement[0].motion_mm[3]"})
    EXPECT_THROW(Sensitivities(settings, "", {number}, equilibrium, 1), Failure) << number;
  EXPECT_THROW(Sensitivities(settings, "", {}, equilibrium, 1), Failure);
}
