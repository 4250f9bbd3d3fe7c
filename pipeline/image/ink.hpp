// Text and lines on a picture, drawn at four times the size and averaged, so that thin strokes stay smooth.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

namespace cv {
class Mat;
}

namespace palpate::ink {

/// 0…255 each.
struct Colour {
  double blue, green, red;
};

/// Rectangle in pixels.
struct Place {
  int x, y, width, height;
};

enum class Weight { regular, bold };
enum class Align { left, centre, right };

/// Width in pixels of `text` with capitals `height` pixels tall.
double text_width(const std::string& text, double height, Weight weight = Weight::regular);

/// Writes one line with a dark halo, whose baseline starts (is centred, ends) at (x, y). The character after '^' is raised and
/// small: "mm^3".
void write(cv::Mat& picture, const std::string& text, double x, double y, double height, const Colour& colour,
           Weight weight = Weight::regular, Align align = Align::left);

/// Paints a rectangle (the part within the picture), `opacity` from 0 to 1.
void fill(cv::Mat& picture, const Place& place, const Colour& colour, double opacity = 1);

}  // namespace palpate::ink
