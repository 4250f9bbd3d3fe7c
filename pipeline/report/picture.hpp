// A picture and the view it was taken from; no VTK, so that the page's text can be compiled without it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include <palpate/vec3.hpp>

namespace palpate {

/// Where one looks from: `toward` points from the eye into the picture; `up` need not be at right angles to it.
struct View {
  Vec3 toward{0, 1, 0};
  Vec3 up{0, 0, 1};
  Vec3 centre{0, 0, 0};
  double width_mm = 1, height_mm = 1;
};

struct Picture {
  std::string png;  ///< the file's bytes
  int width = 0, height = 0;
  double mm_per_pixel = 0;
  Vec3 right{1, 0, 0}, up{0, 0, 1};  ///< unit vectors of the picture's plane, in LPS
};

struct NamedPicture {
  std::string name;  ///< "from the front"
  Picture picture;
};

/// The smallest view along `toward` that holds all points, with a margin; neither very low nor narrower than high.
View fit_view(const std::vector<Vec3>& points, const Vec3& toward, const Vec3& up);

/// Sequences of colours for fields, pale for 0: one per kind of field, so that they are not mistaken for one another.
enum class Tones { none, displacement, stress };

/// As "#rrggbb", from low to high, for the bar beside a picture.
std::vector<std::string> tone_colours(Tones tones);

}  // namespace palpate
