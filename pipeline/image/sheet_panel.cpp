// Writing on slices.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/sheet_panel.hpp>

#include <cmath>
#include <cstdio>
#include <string_view>
#include <opencv2/core.hpp>

namespace palpate::sheet {
namespace {

constexpr double text_height = 10, tick_height = 7;
constexpr int narrow = 300;                // pixels: the position reaches the middle
constexpr int smallest_with_letters = 48;  // pixels: letters would hide the picture

/// 1, 2 or 5 times a power of ten: about a quarter of the panel's width.
double round_length_mm(const Panel& panel) {
  const double wanted = 0.3 * panel.place.width / panel.pixels_per_mm(), decade = std::pow(10, std::floor(std::log10(wanted)));
  return decade * (wanted >= 5 * decade ? 5 : wanted >= 2 * decade ? 2 : 1);
}

std::string position_text(const Panel& panel, double position_mm) {
  return std::string(1, "xyz"[panel.view.normal]) + " = " + number(position_mm, 1) + " mm";
}

/// Patient coordinate along one edge: a straight line from the middle of the first voxel shown to that of the last.
struct Edge {
  double first_mm, last_mm;  ///< at the panel's two ends
  bool straight;             ///< the voxel axis is a patient axis
};

Edge edge_of(const Grid& grid, int voxel_axis, int patient_axis, bool flip, double first_shown, double last_shown) {
  const Vec3& step = grid.lps_from_voxel.columns[voxel_axis];
  const auto coordinate = [&](double shown) {
    return grid.lps_from_voxel.origin[patient_axis] + index_shown_at(shown, grid.size[voxel_axis], flip) * step[patient_axis];
  };
  return {coordinate(first_shown - 0.5), coordinate(last_shown + 0.5), std::abs(unit(step)[patient_axis]) > 0.9999};
}

template <class Draw>
void for_each_tick(const Edge& edge, double step_mm, int pixels, Draw&& draw) {
  const double low = std::min(edge.first_mm, edge.last_mm), high = std::max(edge.first_mm, edge.last_mm);
  for (double tick = std::ceil(low / step_mm); tick * step_mm <= high; ++tick) {
    const double along = (tick * step_mm - edge.first_mm) / (edge.last_mm - edge.first_mm) * pixels;
    draw(static_cast<int>(std::lround(along)), number(tick * step_mm, step_mm < 1 ? 1 : 0));
  }
}

}  // namespace

std::string number(double value, int digits) {
  char text[60];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  std::string grouped = text;
  if (std::string_view(text).find_first_not_of("-0.") == std::string_view::npos && text[0] == '-') grouped.erase(0, 1);
  const std::size_t point = grouped.find('.') == std::string::npos ? grouped.size() : grouped.find('.');
  if (std::abs(value) >= 10000)
    for (std::size_t at = point; at > 3 && grouped[at - 4] != '-'; at -= 3) grouped.insert(at - 3, " ");
  return grouped;
}

void write_directions(cv::Mat& picture, const Panel& panel, double height) {
  const auto& p = panel.place;
  if (std::min(p.width, p.height) < smallest_with_letters) return;
  const double x = p.x + p.width / 2.0, y = p.y + p.height / 2.0 + height / 2;
  const auto letter = [&](char c, double at_x, double at_y) {
    ink::write(picture, std::string(1, c), at_x, at_y, height, faint, ink::Weight::bold, ink::Align::centre);
  };
  letter(panel.view.left, p.x + height, y);
  letter(panel.view.right, p.x + p.width - height, y);
  letter(panel.view.top, x, p.y + (p.width < narrow ? 24 : 0) + 1.7 * height);
  letter(panel.view.bottom, x, p.y + p.height - 0.6 * height);
}

void write_position(cv::Mat& picture, const Panel& panel, double position_mm) {
  const std::string text = position_text(panel, position_mm);
  const int width = static_cast<int>(ink::text_width(text, text_height)) + 16;
  ink::fill(picture, {panel.place.x, panel.place.y, width, 24}, background, 0.8);
  ink::write(picture, text, panel.place.x + 8.0, panel.place.y + 17.0, text_height, paper);
}

void draw_scale_bar(cv::Mat& picture, const Panel& panel) {
  const double length = round_length_mm(panel);
  const int pixels = static_cast<int>(std::lround(length * panel.pixels_per_mm()));
  const int right = panel.place.x + panel.place.width - 10, bottom = panel.place.y + panel.place.height - 22;
  ink::fill(picture, {right - pixels, bottom - 3, pixels, 3}, paper);
  ink::write(picture, number(length, length < 1 ? 1 : 0) + " mm", right - pixels / 2.0, bottom - 9.0, text_height - 1, paper,
             ink::Weight::regular, ink::Align::centre);
}

void draw_ticks(cv::Mat& picture, const Panel& panel) {
  const SliceView& view = panel.view;
  const Crop2& crop = panel.crop;
  const ink::Place& p = panel.place;
  const double step = round_length_mm(panel);
  const Edge lower = edge_of(panel.grid, view.across, view.patient_across, view.flip_across, crop.first_across, crop.last_across);
  const Edge left = edge_of(panel.grid, view.down, view.patient_down, view.flip_down, crop.first_down, crop.last_down);
  const int bottom = p.y + p.height;
  if (lower.straight)
    for_each_tick(lower, step, p.width, [&](int along, const std::string& text) {
      ink::fill(picture, {p.x + along, bottom - 5, 1, 5}, faint);
      if (std::abs(along - p.width / 2) > 22 && along > 16 && along < p.width - 16)
        ink::write(picture, text, p.x + along, bottom - 8, tick_height, faint, ink::Weight::regular, ink::Align::centre);
    });
  if (left.straight)
    for_each_tick(left, step, p.height, [&](int along, const std::string& text) {
      ink::fill(picture, {p.x, p.y + along, 5, 1}, faint);
      if (std::abs(along - p.height / 2) > 16 && along > 32 && along < p.height - 24)
        ink::write(picture, text, p.x + 12, p.y + along + tick_height / 2, tick_height, faint);
    });
}

}  // namespace palpate::sheet
