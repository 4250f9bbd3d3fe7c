// Bilateral mean in each slice: s(x) ∝ Σ_y exp(−|y − x|²/2σ² − (I(y) − I(x))²/2τ²) I(y) (Tomasi & Manduchi 1998, eq. 5).
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/smoothing.hpp>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace palpate::smoothing {
namespace {

Scan apply(const Scan& scan, const Amount& amount) {
  const auto& n = scan.grid.size;
  const Vec3 h = scan.grid.spacing();
  const double sigma = amount.width_mm / std::sqrt(h[0] * h[1]);
  const double tau = amount.intensity_width.value_or(3 * noise_sd(scan));
  const int diameter = 2 * std::max(1, static_cast<int>(std::lround(1.5 * sigma))) + 1;
  if (!(tau > 0) || !(sigma > 0)) return scan;
  Scan out = scan;
  for (int k = 0; k < n[2]; ++k) {
    cv::Mat slice(n[1], n[0], CV_32F, &out.voxels[out.grid.at(0, 0, k)]);
    cv::Mat smooth;
    cv::bilateralFilter(slice, smooth, diameter, tau, sigma, cv::BORDER_REPLICATE);
    smooth.copyTo(slice);
  }
  return out;
}

}  // namespace

Filter bilateral() {
  return {{"smoothing",
           "bilateral",
           "Mean within each slice over neighbours of like intensity; calms noise, keeps edges.",
           "C. Tomasi & R. Manduchi, Bilateral filtering for gray and color images, ICCV 1998, eq. 5",
           {{"smoothing-mm", "mm", {0, 1000}, 0.7, "standard deviation in space"},
            {"smoothing-intensity", "1", {0, 1e9}, 30, "standard deviation in intensity; three times the noise when not given"}}},
          apply};
}

}  // namespace palpate::smoothing
