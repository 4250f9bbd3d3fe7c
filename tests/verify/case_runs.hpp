// Whole runs of a case file on a block of 10 x 10 x 5 mm, and their derivatives against differences of runs over the same steps.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <gtest/gtest.h>

#include <fstream>
#include <optional>
#include <sstream>

#include <palpate/errors.hpp>
#include <solver/results.hpp>
#include <solver/sensitivities.hpp>
#include <tests/verify/shapes.hpp>
#include <tests/words/temporary_folder.hpp>

namespace palpate::verify {

/// Rows of numbers of a CSV with a header.
inline std::vector<std::vector<double>> rows_of(const std::string& csv) {
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

class CaseRuns : public InFolder {
 protected:
  static bool depth_answers(const Case& c) { return !c.model.tools.empty() && c.model.tools.front().force_controlled; }

  void write(const std::string& text, const TetMesh& mesh = mesh_of(brick(uniform(-5, 5, 4), uniform(-5, 5, 4), uniform(0, 5, 2)))) {
    write_mesh(folder / "mesh.vtu", mesh);
    std::ofstream(folder / "case.toml") << "schema = \"palpate-case/1\"\n" << text;
  }

  /// Force along the motion at every reported step, or the depth of a tool whose force is given; with the table of its derivatives when `numbers` are given.
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
      follow = [&](const implicit::Accepted& found) { sensitivities->follow(found.state); };
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
      forces.push_back(depth_answers(c) ? driven(c, step).depth : driven(c, step).force);
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

  static std::string told(const std::vector<double>& differences, const std::vector<std::vector<double>>& rows, std::size_t column) {
    std::ostringstream out;
    for (std::size_t i = 0; i < rows.size(); ++i) out << "\n  " << rows[i][0] << " s: " << rows[i][column] << ", of runs " << differences[i];
    return out.str();
  }

  /// Of a number that is 0 and has no derivative there.
  void expect_secant(const std::string& number, double amplitude) {
    const Settings settings = Settings::read(folder / "case.toml");
    std::string table;
    const auto off = forces(settings, {number}, &table);
    Settings moved = Settings::read(folder / "case.toml");
    moved.shift(number, amplitude);
    const auto on = forces(moved);
    const auto rows = rows_of(table);
    for (std::size_t i = 0; i < on.size(); ++i) EXPECT_NEAR(rows[i][1], (on[i] - off[i]) / amplitude, 1e-7) << rows[i][0];
    EXPECT_GT(std::abs(rows.back()[1]), 1e-4);
  }

  void expect_derivatives(const std::vector<std::string>& numbers) {
    const Settings settings = Settings::read(folder / "case.toml");
    std::string table;
    forces(settings, numbers, &table);
    const auto rows = rows_of(table);
    const std::size_t per_number = (rows[0].size() - 1) / numbers.size();
    const std::size_t column = depth_answers(read_case(settings, "")) ? per_number : 1;
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      const auto differences = differences_of_runs(settings, numbers[k]);
      double largest = 0, worst = 0;
      for (std::size_t i = 0; i < differences.size(); ++i) {
        largest = std::max(largest, std::abs(differences[i]));
        worst = std::max(worst, std::abs(differences[i] - rows[i][column + k * per_number]));
      }
      EXPECT_GT(largest, 0) << numbers[k];
      EXPECT_LE(worst, 5e-5 * largest) << numbers[k] << told(differences, rows, column + k * per_number);
    }
  }
};

}  // namespace palpate::verify
