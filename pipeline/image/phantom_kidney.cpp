// Kidney: a tube bent on a circular arc, flattened, with a notch at the hilum; pyramids fan out from the renal sinus.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/phantom_organs.hpp>

#include <algorithm>
#include <numbers>

namespace palpate {
namespace {

/// Arc with which a tube of radius `radius` is length × width large:  length = 2 (R sin α + r), width = R (1 − cos α) + 2 r.
struct Bend {
  double radius, arc_radius, half_angle;
};

Bend bend_of(const KidneyShape& k) {
  const double r = k.fullness * k.width_mm / 2;
  const double s = k.length_mm / 2 - r, h = k.width_mm - 2 * r;
  const double alpha = 2 * std::atan2(h, s);
  return {r, s / std::sin(alpha), alpha};
}

/// The notch: a capsule along the long axis whose flank enters the medial side by the hilum's depth.
Implicit hilum(const KidneyShape& k, double medial_x) {
  const double q = 0.09 * k.length_mm;
  const Vec3 middle{medial_x - q, 0, 0}, half{0, 0, 0.07 * k.length_mm};
  return capsule(middle - half, middle + half, q + k.hilum_depth_mm);
}

/// Distance from `start` along the unit vector `d` at which f becomes positive.
double exit_distance(const Implicit& f, const Vec3& start, const Vec3& d, double limit) {
  double t = 0;
  while (t < limit) {
    const double value = f(start + t * d);
    if (value >= 0) break;
    t += std::max(-value, 1e-3);
  }
  return t;
}

struct Ray {
  Vec3 direction;
  double length;
};

/// Directions from the sinus to the pyramids' bases, fanned in the x–z plane, leaning to the front and to the back in turn.
std::vector<Ray> fan(const KidneyShape& k, const Implicit& inner, const Vec3& sinus) {
  std::vector<Ray> rays;
  const double widest = 80 * std::numbers::pi / 180, lean = 0.35 * k.thickness_mm / k.width_mm;
  for (int i = 0; i < k.pyramids; ++i) {
    const double phi = k.pyramids == 1 ? 0 : widest * (2.0 * i / (k.pyramids - 1) - 1);
    const Vec3 d = unit({std::cos(phi), i % 2 ? lean : -lean, std::sin(phi)});
    rays.push_back({d, exit_distance(inner, sinus, d, k.length_mm)});
  }
  return rays;
}

}  // namespace

std::string defect_of(const KidneyShape& k) {
  const Bend b = bend_of(k);
  if (!(k.length_mm >= 1.2 * k.width_mm)) return "the kidney's length must be at least 1.2 times its width";
  if (!(k.thickness_mm <= 1.5 * k.width_mm && k.thickness_mm >= 0.3 * k.width_mm)) return "the thickness must be 0.3 to 1.5 times the width";
  if (!(b.arc_radius > 1.1 * b.radius && b.half_angle < 0.45 * std::numbers::pi)) return "the bend is too tight for this fullness, width and length";
  if (!(k.hilum_depth_mm <= 0.6 * b.radius)) return "the hilum is deeper than 0.3 times the width";
  if (!(k.cortex_mm <= 0.4 * std::min(k.thickness_mm, k.width_mm) / 2)) return "the cortex is thicker than 0.2 times the thickness";
  return "";
}

Organ kidney(const KidneyShape& k) {
  const Bend b = bend_of(k);
  const double r = b.radius;
  const Vec3 arc_centre{k.width_mm / 2 - b.arc_radius - r, 0, 0};
  const double medial_x = arc_centre[0] + b.arc_radius - r;
  Implicit body = stretched(arc_tube(arc_centre, b.arc_radius, b.half_angle, r), {1, k.thickness_mm / (2 * r), 1});
  if (k.hilum_depth_mm > 0) body = smooth_difference(body, hilum(k, medial_x), 0.25 * r);

  const Vec3 sinus{medial_x + k.hilum_depth_mm + 0.3 * r, 0, 0};
  const Implicit inner = offset(body, -k.cortex_mm);
  Implicit pelvis = capsule({medial_x, 0, 0}, sinus, 0.2 * r);
  Implicit medulla;
  const double spread = 160 * std::numbers::pi / 180 / std::max(1, k.pyramids - 1);
  for (const Ray& ray : fan(k, inner, sinus)) {
    const double base = std::min(0.85 * spread * ray.length, 0.6 * r), tip = 0.3 * base;
    const Vec3 apex = sinus + (0.35 * ray.length) * ray.direction, end = sinus + ray.length * ray.direction;
    const Implicit pyramid = base - tip < 0.65 * ray.length ? round_cone(apex, tip, end, base) : ball(end, base);
    medulla = medulla ? smooth_union(medulla, pyramid, 0) : pyramid;
    pelvis = smooth_union(pelvis, capsule(sinus, apex, 0.08 * r), 0.1 * r);
  }

  Organ organ;
  organ.name = "kidney";
  organ.body_part = "KIDNEY";
  organ.laterality = "L";
  organ.shape = body;
  organ.parts = {{"pelvis", 3, pelvis, k.pelvis}, {"medulla", 2, intersection(medulla, inner), k.medulla}, {"cortex", 1, body, k.cortex}};
  const Vec3 half{k.width_mm / 2, k.thickness_mm / 2, k.length_mm / 2};
  organ.box = {-1.0 * half, half};
  organ.seed = {arc_centre[0] + b.arc_radius + 0.25 * r, 0, 0};
  return organ;
}

}  // namespace palpate
