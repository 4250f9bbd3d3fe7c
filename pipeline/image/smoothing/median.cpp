// Median of a square of voxels in each slice: s(x) = med { I(y) : |y − x|_∞ ≤ r }.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/smoothing.hpp>

#include <opencv2/imgproc.hpp>

namespace palpate::smoothing {
namespace {

Scan apply(const Scan& scan, const Amount& amount) {
  const auto& n = scan.grid.size;
  const Vec3 h = scan.grid.spacing();
  const int length = amount.width_mm < 1.5 * std::min(h[0], h[1]) ? 3 : 5;  // what OpenCV has for floats
  Scan out = scan;
  for (int k = 0; k < n[2]; ++k) {
    cv::Mat slice(n[1], n[0], CV_32F, &out.voxels[out.grid.at(0, 0, k)]);
    cv::medianBlur(slice.clone(), slice, length);
  }
  return out;
}

}  // namespace

Filter median() {
  return {
      {"smoothing",
       "median",
       "Median within each slice, of 3 x 3 voxels, or of 5 x 5 for a reach of 1.5 voxels and more; removes specks, keeps edges.",
       "",
       {{"smoothing-mm", "mm", {0, 1000}, 1, "reach in the slice"}}},
      apply};
}

}  // namespace palpate::smoothing
