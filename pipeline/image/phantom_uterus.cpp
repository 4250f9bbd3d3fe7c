// Uterus: a flattened pear (hull of two balls), with a tube that leaves its shoulder and arches over an ovary on a ligament.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/phantom_organs.hpp>

#include <algorithm>
#include <numbers>

namespace palpate {
namespace {

/// Parts reach this far beyond the organ, which cuts them: no slivers are left of the uterus along surfaces that would coincide.
constexpr double beyond_mm = 1;
constexpr double ligament_length_mm = 10, shoulder = 35 * std::numbers::pi / 180;

bool has_tube(const UterusShape& u) { return u.tube_length_mm > 0; }
bool has_ovary(const UterusShape& u) { return u.ovary_length_mm > 0; }

double ligament_radius(const UterusShape& u) { return 0.35 * u.ovary_thickness_mm / 2; }

/// Where everything lies: the pear's two balls, the tube's way (straight, then an arc about `middle`), the ovary's centre.
struct Plan {
  double fundus, cervix;             ///< radii
  Vec3 fundus_centre, cervix_centre;
  Vec3 root, middle, ovary;
  double arc_radius, lead, arc_angle;
};

Plan plan_of(const UterusShape& u) {
  Plan p;
  p.fundus = u.width_mm / 2;
  p.cervix = u.cervix_mm / 2;
  p.fundus_centre = {0, 0, u.length_mm / 2 - p.fundus};
  p.cervix_centre = {0, 0, p.cervix - u.length_mm / 2};
  p.root = p.fundus_centre + p.fundus * Vec3{std::cos(shoulder), 0, std::sin(shoulder)};
  const double long_half = u.ovary_length_mm / 2, high_half = u.ovary_width_mm / 2;
  p.arc_radius = long_half + u.gap_mm + u.tube_mm / 2;
  p.middle = {p.fundus + ligament_length_mm + long_half, 0, p.root[2] - p.arc_radius};
  p.ovary = p.middle + Vec3{0, 0, long_half - high_half};
  p.lead = p.middle[0] - p.root[0];
  p.arc_angle = (u.tube_length_mm - p.lead) / p.arc_radius;
  return p;
}

/// The tube's centre line from its root to its free end, a point per millimetre of the arc.
std::vector<Vec3> way(const Plan& p) {
  std::vector<Vec3> points{p.root};
  const int steps = std::max(1, static_cast<int>(std::ceil(p.arc_angle * p.arc_radius)));
  for (int i = 0; i <= steps; ++i) {
    const double t = p.arc_angle * i / steps;
    points.push_back(p.middle + p.arc_radius * Vec3{std::sin(t), 0, std::cos(t)});
  }
  return points;
}

Implicit outside_of(Implicit f) {
  return [f = std::move(f)](const Vec3& x) { return -f(x); };
}

void enclose(Box& box, const Vec3& centre, const Vec3& half) {
  for (int i = 0; i < 3; ++i) {
    box.min[i] = std::min(box.min[i], centre[i] - half[i]);
    box.max[i] = std::max(box.max[i], centre[i] + half[i]);
  }
}

}  // namespace

std::string defect_of(const UterusShape& u) {
  const Plan p = plan_of(u);
  if (!(u.length_mm >= 1.2 * u.width_mm)) return "the uterus' length must be at least 1.2 times its width";
  if (!(u.cervix_mm <= u.width_mm && u.cervix_mm >= 0.25 * u.width_mm)) return "the cervix must be 0.25 to 1 times as wide as the uterus";
  if (!(u.thickness_mm <= 1.2 * u.width_mm && u.thickness_mm >= 0.3 * u.width_mm)) return "the thickness must be 0.3 to 1.2 times the width";
  if (has_tube(u) && !has_ovary(u)) return "a tube arches over an ovary: ovary_length_mm is 0";
  if (has_ovary(u) && !(u.ovary_width_mm <= u.ovary_length_mm && u.ovary_thickness_mm <= u.ovary_length_mm)) return "the ovary is longest along its length";
  if (has_tube(u) && !(p.lead > u.tube_mm && p.arc_angle >= 0.5 && p.arc_angle <= 0.75 * std::numbers::pi))
    return "the tube is too short to reach over the ovary, or winds back to the uterus";
  if (has_tube(u) && !(u.tube_mm <= 0.5 * u.ovary_thickness_mm)) return "the tube is thicker than half the ovary";
  return "";
}

Organ uterus(const UterusShape& u) {
  const Plan p = plan_of(u);
  const Vec3 flattened{1, u.thickness_mm / u.width_mm, 1};
  const Implicit pear = stretched(round_cone(p.cervix_centre, p.cervix, p.fundus_centre, p.fundus), flattened);
  Organ organ;
  organ.name = "uterus";
  organ.body_part = "UTERUS";
  organ.shape = pear;
  organ.seed = p.fundus_centre;
  const Vec3 half{u.width_mm / 2, u.thickness_mm / 2, u.length_mm / 2};
  organ.box = {-1.0 * half, half};
  Implicit hanging;  // ligament and ovary: smooth where they join, sharp against the tube, which must not grow towards them
  if (has_ovary(u)) {
    const Vec3 semi_axes = 0.5 * Vec3{u.ovary_length_mm, u.ovary_thickness_mm, u.ovary_width_mm};
    Affine there;
    there.origin = p.ovary;
    const double least = std::min({semi_axes[0], semi_axes[1], semi_axes[2]});
    const Implicit egg = moved(stretched(ball({0, 0, 0}, least), (1 / least) * semi_axes), there);
    const double r = ligament_radius(u);
    const Implicit ligament = capsule({0.7 * p.fundus, 0, p.ovary[2]}, p.ovary - Vec3{0.8 * semi_axes[0], 0, 0}, r);
    organ.shape = smooth_union(pear, ligament, r);
    hanging = smooth_union(ligament, egg, r / 2);
    organ.parts.push_back({"ovary", 3, offset(egg, beyond_mm), u.ovary});
    enclose(organ.box, p.ovary, semi_axes);
  }
  if (has_tube(u)) {
    const auto points = way(p);
    const double r = u.tube_mm / 2;
    const Implicit tube = polyline_tube(points, r);
    organ.shape = smooth_union(organ.shape, tube, r);
    organ.parts.push_back({"tube", 2, intersection(offset(tube, beyond_mm), outside_of(pear)), u.tube});
    for (const Vec3& x : points) enclose(organ.box, x, {r, r, r});
  }
  if (hanging) organ.shape = smooth_union(organ.shape, hanging, 0);
  organ.parts.push_back({"uterus", 1, organ.shape, u.uterus});
  return organ;
}

}  // namespace palpate
