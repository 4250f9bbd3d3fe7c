// Windowed slices with a contour: the half level of the mask, interpolated between voxel centres.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/slice_picture.hpp>

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

/// Contour points in eighths of a picture's pixel, as cv::polylines with shift 3 takes them.
std::vector<std::vector<cv::Point>> contours_of(const cv::Mat& mask, cv::Size size) {
  constexpr int fine = 4;  // contour cells per pixel
  cv::Mat level;
  cv::resize(mask, level, size * fine, 0, 0, cv::INTER_LINEAR);
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(cv::Mat(level > 0.5f), contours, cv::RETR_LIST, cv::CHAIN_APPROX_NONE);
  for (auto& contour : contours)
    for (auto& point : contour) point = point * 2 - cv::Point(3, 3);  // cell centre (c + 1/2)/4 − 1/2 pixel, times 8
  return contours;
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
  cv::polylines(picture, contours, true, {0, 0, 0}, 3, cv::LINE_AA, 3);
  cv::polylines(picture, contours, true, {colour.blue, colour.green, colour.red}, 1, cv::LINE_AA, 3);
  return picture;
}

}  // namespace palpate
