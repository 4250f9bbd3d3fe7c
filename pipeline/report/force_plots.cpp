// Points are those of history.csv; the browser draws them.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/report/force_plots.hpp>

#include <algorithm>

#include <pipeline/report/facts.hpp>
#include <pipeline/report/html.hpp>

namespace palpate {

std::string force_plot(const Study& study) {
  const ForceUnit unit = force_unit(study);
  Json series = Json::array();
  for (const Solve& solve : study.solves) {
    const auto &depths = solve.history.column("depth[mm]"), &forces = solve.history.column("F[N]"),
               &areas = solve.history.column("contact_area[mm2]");
    Json points = Json::array();
    for (std::size_t i = 0; i < depths.size(); ++i) {
      Json point = {depths[i], forces[i] * unit.per_newton};
      if (!areas.empty()) point.push_back(areas[i]);
      points.push_back(std::move(point));
    }
    series.push_back({{"name", solve.name}, {"points", std::move(points)}});
  }
  const Json plot = {{"kind", "lines"},
                     {"x", "depth (mm)"},
                     {"y", "force (" + unit.name + ")"},
                     {"more", "contact area (mm²)"},
                     {"series", series}};
  return plot_figure("plot-force", plot, "Force over depth of every solve; the same numbers are in the table below", "plot");
}

std::string motion_plot(const Study& study) {
  const ForceUnit unit = force_unit(study);
  Json series = Json::array();
  for (const Solve& solve : study.solves) {
    const auto &depths = solve.history.column("depth[mm]"), &times = solve.history.column("t[s]");
    if (std::adjacent_find(depths.begin(), depths.end(), [](double a, double b) { return !(b > a); }) == depths.end()) continue;
    for (const char* component : {"Fx", "Fy", "Fz"}) {
      const auto& forces = solve.history.column(std::string(component) + "[N]");
      Json points = Json::array();
      for (std::size_t i = 0; i < forces.size(); ++i) points.push_back({times[i], forces[i] * unit.per_newton});
      if (!points.empty()) series.push_back({{"name", solve.name + " " + component}, {"points", std::move(points)}});
    }
  }
  if (series.empty()) return "";
  const Json plot = {{"kind", "lines"}, {"x", "time (s)"}, {"y", "force (" + unit.name + ")"}, {"series", series}};
  return "<p class=\"hint\">The tool does not only go deeper: force of the tool on the organ over time, by its components along the patient's x, y and z.</p>\n" +
         plot_figure("plot-motion", plot, "Components of the force over time", "plot");
}

}  // namespace palpate
