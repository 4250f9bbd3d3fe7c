// OpenCV's pool of threads.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/threads.hpp>

#include <opencv2/core/utility.hpp>

namespace palpate {

void use_image_threads(int threads) { cv::setNumThreads(threads); }

}  // namespace palpate
