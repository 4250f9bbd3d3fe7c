// Hershey strokes, supersampled.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/ink.hpp>

#include <opencv2/imgproc.hpp>

namespace palpate::ink {
namespace {

constexpr int supersampling = 4;
constexpr int halo_width = 2 * 1.5 * supersampling + 1;  // a pixel and a half of dark around strokes, for bright pictures
constexpr double halo_opacity = 0.55;
constexpr int font = cv::FONT_HERSHEY_SIMPLEX;
constexpr double capital_height = 21;  // of this font at scale 1, in pixels
constexpr double raised_scale = 0.65, raised_by = 0.5;

double scale_of(double height) { return supersampling * height / capital_height; }

int stroke(double height, Weight weight) {
  return std::max(1, static_cast<int>(std::lround(supersampling * height * (weight == Weight::bold ? 0.17 : 0.105))));
}

/// A run of characters of one size.
struct Run {
  std::string text;
  bool raised;
};

std::vector<Run> runs_of(const std::string& text) {
  std::vector<Run> runs{{"", false}};
  for (std::size_t c = 0; c < text.size(); ++c)
    if (text[c] == '^' && c + 1 < text.size()) {
      runs.push_back({std::string(1, text[++c]), true});
      runs.push_back({"", false});
    } else {
      runs.back().text += text[c];
    }
  return runs;
}

double run_width(const Run& run, double height, Weight weight) {
  if (run.text.empty()) return 0;
  const double scale = scale_of(height) * (run.raised ? raised_scale : 1);
  int baseline = 0;
  return cv::getTextSize(run.text, font, scale, stroke(height, weight), &baseline).width / double(supersampling);
}

void blend(cv::Mat& picture, const cv::Mat& coverage, cv::Point corner, const Colour& colour) {
  const double ink[3] = {colour.blue, colour.green, colour.red};
  for (int y = 0; y < coverage.rows; ++y)
    for (int x = 0; x < coverage.cols; ++x) {
      const int px = corner.x + x, py = corner.y + y;
      if (px < 0 || py < 0 || px >= picture.cols || py >= picture.rows) continue;
      const double alpha = coverage.at<std::uint8_t>(y, x) / 255.0;
      auto& pixel = picture.at<cv::Vec3b>(py, px);
      for (int c = 0; c < 3; ++c) pixel[c] = cv::saturate_cast<std::uint8_t>(pixel[c] + alpha * (ink[c] - pixel[c]));
    }
}

}  // namespace

double text_width(const std::string& text, double height, Weight weight) {
  double width = 0;
  for (const Run& run : runs_of(text)) width += run_width(run, height, weight);
  return width;
}

void write(cv::Mat& picture, const std::string& text, double x, double y, double height, const Colour& colour, Weight weight,
           Align align) {
  const double width = text_width(text, height, weight);
  if (align == Align::centre) x -= width / 2;
  if (align == Align::right) x -= width;
  const int margin = static_cast<int>(height) + 2;
  const cv::Point corner(static_cast<int>(x) - margin, static_cast<int>(y) - 2 * margin);
  const cv::Size size(static_cast<int>(width) + 2 * margin + 1, 3 * margin);
  cv::Mat strokes = cv::Mat::zeros(size * supersampling, CV_8U);
  double run_x = x - corner.x;
  for (const Run& run : runs_of(text)) {
    const double run_y = y - corner.y - (run.raised ? raised_by * height : 0);
    cv::putText(strokes, run.text, cv::Point(static_cast<int>(run_x * supersampling), static_cast<int>(run_y * supersampling)),
                font, scale_of(height) * (run.raised ? raised_scale : 1), 255, stroke(height, weight), cv::LINE_AA);
    run_x += run_width(run, height, weight);
  }
  cv::Mat coverage;
  cv::Mat halo;
  cv::dilate(strokes, halo, cv::getStructuringElement(cv::MORPH_ELLIPSE, {halo_width, halo_width}));
  cv::resize(halo, coverage, size, 0, 0, cv::INTER_AREA);
  blend(picture, coverage * halo_opacity, corner, {0, 0, 0});
  cv::resize(strokes, coverage, size, 0, 0, cv::INTER_AREA);
  blend(picture, coverage, corner, colour);
}

void fill(cv::Mat& picture, const Place& place, const Colour& colour, double opacity) {
  cv::Mat part = picture(cv::Rect(place.x, place.y, place.width, place.height) & cv::Rect(0, 0, picture.cols, picture.rows));
  const cv::Mat paint(part.size(), part.type(), cv::Scalar(colour.blue, colour.green, colour.red));
  cv::addWeighted(part, 1 - opacity, paint, opacity, 0, part);
}

}  // namespace palpate::ink
