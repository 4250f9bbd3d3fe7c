// Rodrigues' formula for a vector at right angles to the axis it is turned about.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/mesh/jaws_place.hpp>

#include <cmath>
#include <numbers>
#include <sstream>

namespace palpate {

JawsPlace jaws_at(const CentreLine& line, double place, double angle_deg) {
  const Vec3 t = line.tangent(place), down{0, -1, 0}, back{0, 0, -1}, from = std::abs(dot(t, down)) < 0.99 ? down : back;
  const Vec3 start = unit(from - dot(from, t) * t);
  const double angle = angle_deg * std::numbers::pi / 180;
  return {line.at(place), std::cos(angle) * start + std::sin(angle) * cross(t, start), t};
}

std::string clamp_lines(const JawsPlace& jaws) {
  std::ostringstream out;
  out.precision(9);
  const auto write = [&](const char* key, const Vec3& v) { out << key << " = [" << v[0] << ", " << v[1] << ", " << v[2] << "]"; };
  write("centre_mm", jaws.centre), out << "\n";
  write("axis", jaws.axis), out << "\n";
  write("along", jaws.along);
  return out.str();
}

}  // namespace palpate
