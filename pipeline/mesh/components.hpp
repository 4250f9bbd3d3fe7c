// Which closed surfaces a triangle surface holds, which lies inside which, and the bodies they bound.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include <palpate/mesh_files.hpp>

namespace palpate {

/// One connected closed surface of a Surface.
struct Shell {
  std::vector<int> triangles;  ///< indices, ascending
  double volume = 0;           ///< mm³, by the divergence theorem; negative when the triangles face inward (a cavity)
  int region = 0;              ///< the commonest of its triangles
};

/// What is to be filled: inside of `outer`, outside of each of `holes` (indices of shells).
struct Body {
  int outer = 0;
  std::vector<int> holes;
  int region = 0;
};

/// Connected shells in order of their first triangle.
/// Throws Failure(check_failed) with mm coordinates: an open edge, an edge of more than two triangles, triangles facing both ways.
std::vector<Shell> closed_shells(const Surface& surface);

/// Nests shells by winding number. A cavity faces inward; a shell of another region facing outward is a body of its own and a hole
/// of the body around it. Throws Failure(check_failed): inside out, or inside another of the same region.
std::vector<Body> bodies_of(const Surface& surface, const std::vector<Shell>& shells);

/// Volume of all bodies, mm³: outer shells less their holes.
double total_volume(const std::vector<Shell>& shells, const std::vector<Body>& bodies);

/// ⅙ Σ a·(b×c) over the listed triangles, or all, mm³ (divergence theorem).
double enclosed_volume(const Surface& surface, const std::vector<int>& triangles);
double enclosed_volume(const Surface& surface);

/// The surface without points that no triangle uses.
Surface without_unused_points(const Surface& surface);

/// "(12.5, -3, 40) mm"
std::string place_text(const Vec3& x);

}  // namespace palpate
