// Checks of a surface, from its triangles alone.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/surface/checks.hpp>

#include <algorithm>
#include <cmath>

#include <pipeline/surface/measure.hpp>
#include <pipeline/surface/remesh.hpp>

namespace palpate {
namespace {

Check none(const std::string& name, int count, const Vec3& first_at) {
  Check check = check_equal(name, count, 0);
  if (count > 0) check.where = "the first at " + place_text(first_at);
  return check;
}

Check self_intersection_check(const Surface& surface) {
  const auto pairs = self_intersections(surface);
  Check check = check_equal("self-intersections", long(pairs.size()), 0);
  if (!pairs.empty())
    check.where = place_of_triangle(surface, pairs[0].first) + " meets " + place_of_triangle(surface, pairs[0].second);
  return check;
}

/// Every shell that lies in no other must enclose a positive volume; a shell of negative volume is a cavity's.
bool outward(const std::vector<Shell>& all) {
  double sum = 0;
  for (const Shell& shell : all) sum += shell.volume_mm3;
  return !all.empty() && all.front().volume_mm3 > 0 && sum > 0;
}

Check reported(const std::string& name, long value) { return {name, value, "reported", true, ""}; }

void add_shape_checks(const Surface& surface, const SurfaceLimits& limits, std::vector<Check>& checks) {
  const auto all = shells(surface);
  checks.push_back(check_true("outward", outward(all)));
  long genus = 0;
  for (const Shell& shell : all) genus += shell.genus;
  checks.push_back(limits.components ? check_equal("components", long(all.size()), *limits.components)
                                     : check_at_least("components", double(all.size()), 1));
  checks.push_back(limits.genus ? check_at_most("genus", double(genus), *limits.genus) : reported("genus", genus));
  checks.push_back(self_intersection_check(surface));
}

}  // namespace

std::vector<Check> surface_checks(const Surface& surface, const SurfaceLimits& limits) {
  const Faults found = faults(surface);
  std::vector<Check> checks = {
      none("open edges (closed)", found.open_edges, found.open_at),
      none("edges of more than two triangles (manifold)", found.crowded_edges, found.crowded_at),
      none("points where sheets touch (manifold)", found.pinched_points, found.pinched_at),
      none("neighbours facing opposite ways (oriented)", found.twisted_edges, found.twisted_at),
  };
  const bool sound = std::all_of(checks.begin(), checks.end(), [](const Check& check) { return check.pass; });
  if (sound && !surface.triangles.empty()) add_shape_checks(surface, limits, checks);
  const double change = surface.triangles.empty() ? NAN : std::abs(volume_mm3(surface) - limits.volume_mm3) / limits.volume_mm3;
  checks.push_back(check_at_most("volume change", change, limits.volume_change));
  const Angles found_angles = angles(surface);
  Check angle = check_at_least("smallest triangle angle", found_angles.min_deg, limits.min_angle_deg, "deg");
  angle.where = place_of_triangle(surface, found_angles.sharpest_triangle);
  checks.push_back(angle);
  return checks;
}

std::optional<Check> first_failed(const std::vector<Check>& checks) {
  const auto failed = std::find_if(checks.begin(), checks.end(), [](const Check& check) { return !check.pass; });
  return failed == checks.end() ? std::nullopt : std::optional(*failed);
}

}  // namespace palpate
