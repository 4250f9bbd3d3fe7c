// A few shapes, lit, seen in parallel projection without a window, as a PNG with a transparent ground (for light and dark pages).
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <string>
#include <vector>

#include <pipeline/report/picture.hpp>

class vtkPolyData;

namespace palpate {

using Colour = std::array<double, 3>;  ///< red, green, blue in 0..1

/// How a shape is drawn. With `field` set its colours come from that array, from 0 to `top`.
struct Look {
  Colour colour{0.8, 0.8, 0.8};
  bool edges = false;     ///< draws the edges of the faces too
  bool lit = true;        ///< shaded; otherwise the plain colour
  double line_width = 1;  ///< pixels
  int layer = 0;          ///< of shapes at the same depth, the higher layer is seen
  std::string field{};    ///< empty: the plain colour
  Tones tones = Tones::none;
  double top = 1;  ///< value of the field at the last tone
};

class Scene {
 public:
  Scene();
  ~Scene();
  /// Keeps a reference to `shape`.
  void add(vtkPolyData* shape, const Look& look);
  /// Needs a display (PrivateDisplay). Throws Failure(unreadable) when nothing can be drawn.
  Picture draw(const View& view, int width_pixels) const;

 private:
  struct Shape;
  std::vector<Shape> shapes_;
};

}  // namespace palpate
