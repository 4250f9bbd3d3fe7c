// Gaussian in mm, axis after axis: s = g_x * g_y * g_z * I with g_a(u) ∝ exp(−u² h_a² / 2σ²), borders repeated.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/smoothing.hpp>

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace palpate::smoothing {
namespace {

/// Odd length of the kernel that holds 3.5 standard deviations either side.
int kernel_length(double sigma_voxels) { return 2 * static_cast<int>(std::ceil(3.5 * sigma_voxels)) + 1; }

/// A kernel narrower than this is one voxel of weight 1 within 1e-5.
constexpr double narrowest_voxels = 0.2;

Scan apply(const Scan& scan, const Amount& amount) {
  const auto& n = scan.grid.size;
  const Vec3 h = scan.grid.spacing();
  Scan out = scan;
  std::array<cv::Mat, 3> kernel;
  for (int a = 0; a < 3; ++a) {
    const double sigma = amount.width_mm / h[a];
    kernel[a] =
        sigma < narrowest_voxels ? cv::Mat::ones(1, 1, CV_32F) : cv::getGaussianKernel(kernel_length(sigma), sigma, CV_32F);
  }
  for (int k = 0; k < n[2]; ++k) {
    cv::Mat slice(n[1], n[0], CV_32F, &out.voxels[out.grid.at(0, 0, k)]);
    cv::Mat smooth;
    cv::sepFilter2D(slice, smooth, CV_32F, kernel[0], kernel[1], {-1, -1}, 0, cv::BORDER_REPLICATE);
    smooth.copyTo(slice);
  }
  const cv::Mat across(n[2], n[0] * n[1], CV_32F, out.voxels.data());  // one row per slice
  cv::Mat smooth;
  cv::sepFilter2D(across, smooth, CV_32F, cv::Mat::ones(1, 1, CV_32F), kernel[2], {-1, -1}, 0, cv::BORDER_REPLICATE);
  std::copy(smooth.begin<float>(), smooth.end<float>(), out.voxels.begin());
  return out;
}

}  // namespace

Filter gaussian() {
  return {{"smoothing",
           "gaussian",
           "Gaussian mean over neighbours in all three directions; calms noise, moves flat edges hardly at all.",
           "",
           {{"smoothing-mm", "mm", {0, 1000}, 0.7, "standard deviation"}}},
          apply};
}

}  // namespace palpate::smoothing
