// What is written on a slice of a contact sheet: position, patient directions, a scale bar, ticks in mm.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include <pipeline/image/slice_picture.hpp>

namespace palpate::sheet {

inline constexpr ink::Colour background{22, 18, 15}, frame{58, 50, 44}, paper{236, 233, 230}, faint{165, 155, 147},
    contour{60, 190, 255}, cropped{210, 170, 90};

/// A slice drawn at `place` of a picture.
struct Panel {
  const Grid& grid;
  SliceView view;
  Crop2 crop;
  ink::Place place;
  double pixels_per_mm() const { return place.width / (crop.across() * grid.spacing()[view.across]); }
};

/// "12.5", with thousands apart: "5 329 165".
std::string number(double value, int digits);

/// The letters R L A P H F at the edges.
void write_directions(cv::Mat& picture, const Panel& panel, double height);

/// The slice's patient coordinate, "y = 12.5 mm", at the upper left.
void write_position(cv::Mat& picture, const Panel& panel, double position_mm);

/// A bar of a round length at the lower right.
void draw_scale_bar(cv::Mat& picture, const Panel& panel);

/// Patient coordinates along the lower and left edges, at multiples of the scale bar's length. Nothing where the scan is oblique:
/// there one coordinate is not one place of the edge.
void draw_ticks(cv::Mat& picture, const Panel& panel);

}  // namespace palpate::sheet
