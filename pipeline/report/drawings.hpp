// All pictures of a study, drawn from its files.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <string>
#include <vector>

#include <pipeline/report/pictures.hpp>
#include <pipeline/report/study.hpp>

namespace palpate {

/// The deepest frame of one solve.
struct PressedDrawing {
  std::string solve;
  double time_s = 0, depth_mm = 0;
  double largest_displacement_mm = 0, largest_stress_mpa = 0;
  bool wall = false;                   ///< a thin wall: `sections` are all of its pictures
  Picture outside;
  std::vector<NamedPicture> sections;
};

struct Drawings {
  std::vector<NamedPicture> surface, mesh;
  std::vector<PressedDrawing> pressed;
  double displacement_scale_mm = 0, stress_scale_mpa = 0;  ///< where the colours end, the same for all solves
};

/// Draws them. `tell` is called with what is drawn next. Throws Failure(unreadable) naming the file that is damaged.
Drawings draw_study(const Study& study, const std::function<void(const std::string&)>& tell);

}  // namespace palpate
