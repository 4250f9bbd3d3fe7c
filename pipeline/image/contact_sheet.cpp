// Layout of the contact sheet: a header with three views of the whole scan, then slices around the label.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/contact_sheet.hpp>

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <pipeline/image/histogram.hpp>
#include <pipeline/image/sheet_panel.hpp>

namespace palpate {
namespace {

constexpr int sheet_width = 1800, gap = 10, margin = 28, header_height = 330, panels_wanted = 24;

/// Everything the drawing functions share.
struct Sheet {
  const Scan& scan;
  const Mask& mask;
  Block label, around;
  cv::Mat picture;
};

Block whole(const Grid& grid) { return {{0, 0, 0}, {grid.size[0] - 1, grid.size[1] - 1, grid.size[2] - 1}}; }

/// 1 % and 99 % of the intensities shown.
Window robust_window(const Scan& scan, const Block& block) {
  std::vector<float> values;
  for (int k = block.first[2]; k <= block.last[2]; ++k)
    for (int j = block.first[1]; j <= block.last[1]; ++j)
      for (int i = block.first[0]; i <= block.last[0]; ++i) values.push_back(scan(i, j, k));
  return {percentile(values, 0.01), percentile(values, 0.99)};
}

/// The label's block with a margin of a quarter of its longest side, clipped to the scan.
Block block_around(const Block& label, const Grid& grid) {
  const Vec3 h = grid.spacing();
  double longest_mm = 0;
  for (int a = 0; a < 3; ++a) longest_mm = std::max(longest_mm, h[a] * (label.last[a] - label.first[a] + 1));
  Block block;
  for (int a = 0; a < 3; ++a) {
    const int voxels = static_cast<int>(std::ceil(longest_mm / 4 / h[a])) + 2;
    block.first[a] = std::max(0, label.first[a] - voxels);
    block.last[a] = std::min(grid.size[a] - 1, label.last[a] + voxels);
  }
  return block;
}

double width_mm(const Crop2& crop, const Grid& grid, const SliceView& view) {
  return crop.across() * grid.spacing()[view.across];
}
double height_mm(const Crop2& crop, const Grid& grid, const SliceView& view) { return crop.down() * grid.spacing()[view.down]; }

/// Patient coordinate of slice n along the view's normal, at the label's middle.
double position_mm(const Sheet& sheet, const SliceView& view, int n) {
  Vec3 middle;
  for (int a = 0; a < 3; ++a) middle[a] = 0.5 * (sheet.label.first[a] + sheet.label.last[a]);
  middle[view.through] = n;
  return sheet.scan.grid.lps_from_voxel(middle)[view.normal];
}

void draw_slice(Sheet& sheet, const sheet::Panel& panel, int n, const Window& window) {
  const auto& p = panel.place;
  const cv::Mat slice =
      slice_picture(sheet.scan, sheet.mask, panel.view, n, panel.crop, p.width, p.height, window, sheet::contour);
  ink::fill(sheet.picture, {p.x - 1, p.y - 1, p.width + 2, p.height + 2}, sheet::frame);
  slice.copyTo(sheet.picture(cv::Rect(p.x, p.y, p.width, p.height)));
}

/// The part of the scan that the panels show, framed.
void draw_crop_frame(Sheet& sheet, const sheet::Panel& panel) {
  const Crop2 shown = crop_of(sheet.around, panel.grid, panel.view);
  const double fx = double(panel.place.width) / panel.crop.across(), fy = double(panel.place.height) / panel.crop.down();
  const cv::Point first(panel.place.x + int(shown.first_across * fx), panel.place.y + int(shown.first_down * fy));
  const cv::Point last(panel.place.x + int((shown.last_across + 1) * fx) - 1,
                       panel.place.y + int((shown.last_down + 1) * fy) - 1);
  cv::rectangle(sheet.picture, first, last, {sheet::cropped.blue, sheet::cropped.green, sheet::cropped.red});
}

/// The whole scan in the three planes through the label's middle, from the right edge to the left.
void draw_overviews(Sheet& sheet) {
  constexpr double room = header_height - 2.0 * margin, widest = 360;
  const Grid& grid = sheet.scan.grid;
  const Window window = robust_window(sheet.scan, whole(grid));
  int right = sheet_width - margin;
  for (int through = 0; through < 3; ++through) {
    const SliceView view = view_through(grid, through);
    const Crop2 crop = crop_of(whole(grid), grid, view);
    const double w = width_mm(crop, grid, view), h = height_mm(crop, grid, view), pixels_per_mm = std::min(room / h, widest / w);
    const int width = std::max(1, int(w * pixels_per_mm)), height = std::max(1, int(h * pixels_per_mm));
    right -= width;
    const sheet::Panel panel{grid, view, crop, {right, margin + int(room - height) / 2, width, height}};
    draw_slice(sheet, panel, (sheet.label.first[through] + sheet.label.last[through]) / 2, window);
    draw_crop_frame(sheet, panel);
    sheet::write_directions(sheet.picture, panel, 10);
    right -= 3 * gap;
  }
}

void write_header(Sheet& sheet, const SheetText& text) {
  ink::fill(sheet.picture, {margin, margin + 2, 30, 30}, sheet::contour);
  ink::write(sheet.picture, text.name, margin + 46.0, margin + 29.0, 25, sheet::paper, ink::Weight::bold);
  double y = margin + 74;
  for (const auto& fact : text.facts) {
    ink::write(sheet.picture, fact, margin, y, 13, sheet::faint);
    y += 29;
  }
}

struct Layout {
  int columns, panel_width, panel_height;
  std::vector<int> slices;
};

/// Columns so that the sheet is about as wide as high; slices evenly from the first to the last, in full rows when there are
/// enough.
Layout layout_of(double aspect, int first, int last) {
  Layout layout;
  layout.columns = std::clamp(static_cast<int>(std::lround(std::sqrt(panels_wanted * 1.5 / aspect))), 2, 8);
  layout.panel_width = (sheet_width - 2 * margin - (layout.columns - 1) * gap) / layout.columns;
  layout.panel_height = std::max(20, static_cast<int>(std::lround(layout.panel_width / aspect)));
  const int rows = (panels_wanted + layout.columns / 2) / layout.columns;
  const int count = std::min(layout.columns * rows, last - first + 1);
  for (int p = 0; p < count; ++p)
    layout.slices.push_back(count == 1 ? first : first + static_cast<int>(std::lround(double(p) * (last - first) / (count - 1))));
  return layout;
}

void draw_panels(Sheet& sheet, const SliceView& view, const Crop2& crop, const Layout& layout) {
  const Window window = robust_window(sheet.scan, sheet.around);
  for (int p = 0; p < static_cast<int>(layout.slices.size()); ++p) {
    const int x = margin + p % layout.columns * (layout.panel_width + gap);
    const int y = header_height + p / layout.columns * (layout.panel_height + gap);
    const sheet::Panel panel{sheet.scan.grid, view, crop, {x, y, layout.panel_width, layout.panel_height}};
    draw_slice(sheet, panel, layout.slices[p], window);
    sheet::draw_ticks(sheet.picture, panel);
    sheet::write_directions(sheet.picture, panel, 9);
    sheet::write_position(sheet.picture, panel, position_mm(sheet, view, layout.slices[p]));
    sheet::draw_scale_bar(sheet.picture, panel);
  }
}

}  // namespace

std::string contact_sheet_png(const Scan& scan, const Mask& mask, const SheetText& text) {
  const Block label = bounding_block(mask);
  Sheet sheet{scan, mask, label, block_around(label, scan.grid), {}};
  const SliceView view = view_through(scan.grid, coarsest_axis(scan.grid));
  const Crop2 crop = crop_of(sheet.around, scan.grid, view);
  const double aspect = width_mm(crop, scan.grid, view) / height_mm(crop, scan.grid, view);
  const Layout layout = layout_of(aspect, label.first[view.through], label.last[view.through]);
  const int rows = (static_cast<int>(layout.slices.size()) + layout.columns - 1) / layout.columns;
  const int height = header_height + rows * (layout.panel_height + gap) - gap + margin;
  sheet.picture = cv::Mat(height, sheet_width, CV_8UC3);
  ink::fill(sheet.picture, {0, 0, sheet_width, height}, sheet::background);
  write_header(sheet, text);
  draw_overviews(sheet);
  draw_panels(sheet, view, crop, layout);
  std::vector<std::uint8_t> png;
  cv::imencode(".png", sheet.picture, png, {cv::IMWRITE_PNG_COMPRESSION, 3});
  return {png.begin(), png.end()};
}

}  // namespace palpate
