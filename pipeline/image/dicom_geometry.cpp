// Slice k lies at  first + k d,  d = (last − first) / (n − 1);  pitch = d · normal,  tilt = ∠(d, normal).
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/dicom_geometry.hpp>

#include <algorithm>
#include <cstdio>
#include <numbers>

#include <palpate/errors.hpp>

namespace palpate {
namespace {

constexpr double same_direction = 1e-4;    // largest difference of direction components within a series
constexpr double same_spacing = 1e-4;      // relative
constexpr double uneven = 0.02;            // largest deviation of a gap from the median gap, relative
constexpr double rounding_mm = 5e-3;       // positions are often rounded to this
constexpr double duplicate_mm = 1e-3;
constexpr double regular = 0.05;           // largest distance of a slice from the lattice, in pitches

std::string mm(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f mm", x);
  return text;
}

std::string size_text(const DicomFrame& f) { return std::to_string(f.columns) + " x " + std::to_string(f.rows); }

[[noreturn]] void irregular(const std::string& what, const std::string& where, const std::string& next) {
  throw Failure(ExitCode::check_failed, what, where, next);
}

Vec3 normal_of(const DicomFrame& f) { return unit(cross(f.plane->row, f.plane->column)); }

double largest_difference(const Vec3& a, const Vec3& b) {
  return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
}

/// Scouts that the file itself calls so, when there are other images.
void drop_localizers(std::vector<DicomFrame>& frames, std::vector<std::string>& warnings) {
  const auto is_localizer = [](const DicomFrame& f) { return f.localizer; };
  const auto count = std::count_if(frames.begin(), frames.end(), is_localizer);
  if (count == 0 || count == static_cast<long>(frames.size())) return;
  warnings.push_back(std::to_string(count) + " localizer image(s) of the series left out");
  std::erase_if(frames, is_localizer);
}

void expect_one_kind(const std::vector<DicomFrame>& frames) {
  const DicomFrame& first = frames.front();
  for (const DicomFrame& f : frames) {
    if (!f.plane) irregular("an image without place: " + f.missing, f.name(), "a capture or a damaged file: move it out of the folder, or choose another series");
    const std::string both = first.name() + "\n         and " + f.name();
    if (f.columns != first.columns || f.rows != first.rows)
      irregular("images of different size in one series: " + size_text(first) + " and " + size_text(f), both, "keep one kind in the folder");
    if (largest_difference(f.plane->row, first.plane->row) > same_direction || largest_difference(f.plane->column, first.plane->column) > same_direction)
      irregular("images of different orientation in one series", both, "a scout or a radial scan? keep one orientation in the folder");
    if (std::abs(f.plane->column_step_mm - first.plane->column_step_mm) > same_spacing * first.plane->column_step_mm ||
        std::abs(f.plane->row_step_mm - first.plane->row_step_mm) > same_spacing * first.plane->row_step_mm)
      irregular("images of different pixel spacing in one series", both, "keep one kind in the folder");
  }
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

std::string about_gap(double gap, double usual) {
  const double slices = gap / usual;
  const bool whole = slices > 1.5 && std::abs(slices - std::round(slices)) < 0.1;
  return "a gap of " + mm(gap) + " between slices, where " + mm(usual) + " is usual" +
         (whole ? ": " + std::to_string(std::lround(slices) - 1) + " slice(s) missing" : ": the slices are not evenly spaced");
}

/// `along`: positions of the ordered frames on the normal.
void expect_even(const std::vector<DicomFrame>& frames, const std::vector<double>& along) {
  std::vector<double> gaps;
  for (std::size_t k = 1; k < along.size(); ++k) {
    gaps.push_back(along[k] - along[k - 1]);
    if (gaps.back() < duplicate_mm)
      irregular("two images at one position (several time points, echoes or a copy?)", frames[k - 1].name() + "\n         and " + frames[k].name(),
                "keep one of them in the folder");
  }
  const double usual = median(gaps);
  const double tolerance = std::max(uneven * usual, rounding_mm);
  int count = 0;
  std::string where;
  std::size_t worst = 0;
  for (std::size_t k = 0; k < gaps.size(); ++k) {
    if (std::abs(gaps[k] - usual) <= tolerance) continue;
    if (++count <= 5) where += (where.empty() ? "" : "\n         ") + mm(gaps[k]) + " between " + frames[k].name() + " and " + frames[k + 1].name();
    if (count == 1 || std::abs(gaps[k] - usual) > std::abs(gaps[worst] - usual)) worst = k;
  }
  if (count > 5) where += "\n         and " + std::to_string(count - 5) + " more";
  if (count > 0) irregular(about_gap(gaps[worst], usual), where, "find the missing slices, or keep an evenly spaced part in the folder");
}

/// Every first pixel on one line in equal steps: what an affine map can say.
void expect_on_lattice(const SliceStack& stack) {
  const Affine& map = stack.grid.lps_from_voxel;
  for (std::size_t k = 0; k < stack.frames.size(); ++k) {
    const double off = norm(stack.frames[k].plane->position - map({0, 0, double(k)}));
    if (!(off <= std::max(regular * stack.pitch_mm, rounding_mm)))
      irregular("a slice lies " + mm(off) + " off the line of the others", stack.frames[k].name(), "keep the slices of one acquisition in the folder");
  }
}

double single_slice_pitch(SliceStack& stack) {
  const DicomFrame& f = stack.frames.front();
  const double pitch = f.spacing_between_mm > 0 ? f.spacing_between_mm : f.thickness_mm;
  if (!(pitch > 0)) irregular("one slice only, of unknown thickness", f.name(), "a series with at least two slices");
  stack.warnings.push_back("one slice only: its thickness of " + mm(pitch) + " is the header's");
  return pitch;
}

}  // namespace

SliceStack stack_slices(std::vector<DicomFrame> frames) {
  SliceStack stack;
  drop_localizers(frames, stack.warnings);
  expect_one_kind(frames);
  const Vec3 normal = normal_of(frames.front());
  const auto along = [&](const DicomFrame& f) { return dot(f.plane->position, normal); };
  std::stable_sort(frames.begin(), frames.end(), [&](const DicomFrame& a, const DicomFrame& b) { return along(a) < along(b); });
  stack.frames = std::move(frames);
  const FramePlane& first = *stack.frames.front().plane;
  const int n = static_cast<int>(stack.frames.size());
  Vec3 step;
  if (n == 1) {
    step = single_slice_pitch(stack) * normal;
  } else {
    std::vector<double> positions;
    for (const DicomFrame& f : stack.frames) positions.push_back(along(f));
    expect_even(stack.frames, positions);
    step = (1.0 / (n - 1)) * (stack.frames.back().plane->position - first.position);
  }
  stack.grid.size = {stack.frames.front().columns, stack.frames.front().rows, n};
  stack.grid.lps_from_voxel = {{first.column_step_mm * first.row, first.row_step_mm * first.column, step}, first.position};
  stack.pitch_mm = dot(step, normal);
  stack.tilt_deg = std::acos(std::min(1.0, stack.pitch_mm / norm(step))) * 180 / std::numbers::pi;
  expect_on_lattice(stack);
  return stack;
}

std::string orientation_name(const Grid& grid) {
  const Vec3 normal = unit(cross(grid.lps_from_voxel.columns[0], grid.lps_from_voxel.columns[1]));
  const char* names[3] = {"sagittal", "coronal", "axial"};
  int axis = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(normal[i]) > std::abs(normal[axis])) axis = i;
  return (std::abs(normal[axis]) < std::cos(std::numbers::pi / 180) ? "oblique " : "") + std::string(names[axis]);
}

}  // namespace palpate
