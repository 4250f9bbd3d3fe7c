// Windowed slices with a contour: the half level of the mask, interpolated between voxel centres.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/slice_picture.hpp>

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace palpate {
namespace {

/// The cropped slice as shown, one float per voxel.
template <class Voxel>
cv::Mat slice_of(const Volume<Voxel>& volume, const SliceView& view, int n, const Crop2& crop) {
  cv::Mat slice(crop.down(), crop.across(), CV_32F);
  const auto& size = volume.grid.size;
  VoxelIndex at;
  at[view.through] = n;
  for (int y = 0; y < crop.down(); ++y)
    for (int x = 0; x < crop.across(); ++x) {
      const int a = crop.first_across + x, d = crop.first_down + y;
      at[view.across] = view.flip_across ? size[view.across] - 1 - a : a;
      at[view.down] = view.flip_down ? size[view.down] - 1 - d : d;
      slice.at<float>(y, x) = static_cast<float>(volume(at[0], at[1], at[2]));
    }
  return slice;
}

cv::Mat windowed(const cv::Mat& slice, cv::Size size, const Window& window) {
  cv::Mat scaled, grey, picture;
  const bool larger = size.width >= slice.cols && size.height >= slice.rows;
  cv::resize(slice, scaled, size, 0, 0, larger ? cv::INTER_CUBIC : cv::INTER_AREA);
  const double gain = 255.0 / std::max(1e-20f, window.white - window.black);
  scaled.convertTo(grey, CV_8U, gain, -gain * window.black);
  cv::cvtColor(grey, picture, cv::COLOR_GRAY2BGR);
  return picture;
}

constexpr int fine = 4;                                  // contour cells per pixel
constexpr double line_pixels = 1.8, shade_pixels = 3.4;  // widths of the line and of the shade around it
constexpr double shade_opacity = 0.45;

std::vector<std::vector<cv::Point>> contours_of(const cv::Mat& mask, cv::Size size) {
  cv::Mat level;
  cv::resize(mask, level, size * fine, 0, 0, cv::INTER_LINEAR);
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(cv::Mat(level > 0.5f), contours, cv::RETR_LIST, cv::CHAIN_APPROX_NONE);
  return contours;
}

/// Draws lines through contour cells over the picture; a pixel takes as much colour as the line covers of it.
void draw_lines(cv::Mat& picture, const std::vector<std::vector<cv::Point>>& contours, double pixels, const ink::Colour& colour,
                double opacity) {
  cv::Mat cells = cv::Mat::zeros(picture.size() * fine, CV_8U), coverage, weight;
  cv::polylines(cells, contours, true, 255, static_cast<int>(std::lround(pixels * fine)));
  cv::resize(cells, coverage, picture.size(), 0, 0, cv::INTER_AREA);
  coverage.convertTo(weight, CV_32F, opacity / 255);
  const cv::Vec3f paint(static_cast<float>(colour.blue), static_cast<float>(colour.green), static_cast<float>(colour.red));
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 0; x < picture.cols; ++x) {
      auto& pixel = picture.at<cv::Vec3b>(y, x);
      pixel = cv::Vec3b(cv::Vec3f(pixel) + weight.at<float>(y, x) * (paint - cv::Vec3f(pixel)));
    }
}

}  // namespace

Crop2 crop_of(const Block& block, const Grid& grid, const SliceView& view) {
  const auto shown = [&](int axis, bool flip) {
    const int last = grid.size[axis] - 1;
    return flip ? std::pair{last - block.last[axis], last - block.first[axis]} : std::pair{block.first[axis], block.last[axis]};
  };
  const auto [a0, a1] = shown(view.across, view.flip_across);
  const auto [d0, d1] = shown(view.down, view.flip_down);
  return {a0, a1, d0, d1};
}

cv::Mat slice_picture(const Scan& scan, const Mask& mask, const SliceView& view, int n, const Crop2& crop, int width, int height,
                      const Window& window, const ink::Colour& colour) {
  const cv::Size size(width, height);
  cv::Mat picture = windowed(slice_of(scan, view, n, crop), size, window);
  const auto contours = contours_of(slice_of(mask, view, n, crop), size);
  draw_lines(picture, contours, shade_pixels, {0, 0, 0}, shade_opacity);
  draw_lines(picture, contours, line_pixels, colour, 1);
  return picture;
}

}  // namespace palpate
