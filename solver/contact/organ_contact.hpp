// Contact of deformable faces with deformable faces: a point's gap g is the way along its own face's normal n to the other surface,
// x + g n = y; the pressure t presses x by −t n and y by +t n. The pressure is an unknown of its point, as against a tool (decision 025).
// (A line along the normal as in Zimmerman and Ateshian 2018, J. Biomech. Eng. 140:081013, section 2.2; g(t) of decision 021.)
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <array>
#include <vector>

#include <solver/contact/quadrature.hpp>
#include <solver/contact/tool.hpp>

namespace palpate::contact {

using Triangle = std::array<Eigen::Vector3d, 3>;

/// One way of looking: the points of `own` faces against the surface of `other` faces. Two organs look both ways, an organ looks at itself
/// once. Faces by their numbers in the model.
struct Pass {
  std::vector<int> own, other;
  bool joined = false;  ///< the faces are of one body: what lies behind a face may be the body's own back
  int contact = 0;      ///< of the case, for sums
  double friction = 0;  ///< Coulomb's coefficient; infinite: what touches sticks
};

/// The passes of one contact: two organs look at each other, or, with `b` empty, one looks at itself. `joined`: they hang together.
std::vector<Pass> passes_between(const std::vector<int>& a, const std::vector<int>& b, bool joined, int contact, double friction = 0);

/// A point that lies inside the other surface.
struct Meeting {
  int own = 0, q = 0;  ///< place in Pass::own, point of the face
  int other = 0;       ///< a face of Pass::other, its number in the model
  std::array<double, 3> weights{};  ///< of that face's corners
};

/// All of them, face by face and point by point. `rest` and `now`: every face of the model.
std::vector<Meeting> meetings(const Pass& pass, const std::vector<Triangle>& rest, const std::vector<Triangle>& now);

using Rows18 = Eigen::Matrix<double, 3, 18>;

/// Where a point's line runs, and how that changes with the own face's corners, then the other's.
struct PairGeometry {
  double gap = 0;  ///< mm, negative inside
  Eigen::Vector3d normal, other_normal;  ///< outward, unit
  Eigen::Matrix<double, 1, 18> gap_by_corners;
  Rows18 point_by_corners, normal_by_corners, weights_by_corners;  ///< of x, of n, of the weights of the line's end
};

PairGeometry pair_geometry(const Meeting& meeting, const Triangle& own, const Triangle& other);

/// How the weights of a triangle's corners change with a place in its plane, rows, 1/mm.
Eigen::Matrix3d weight_gradients(const Triangle& corners);

/// A meeting seen from one Newton step; unknowns: the own face's corners, then the other's.
struct PairPoint {
  double gap = 0;        ///< mm, negative inside
  double pressure = 0;   ///< MPa: what the gap asks for, to first order; 0 when the point is let go
  double stiffness = 0;  ///< −dt/dg, MPa/mm
  double energy = 0;     ///< stored in the gap that the pressure leaves, N mm
  double mismatch = 0;   ///< |g − g(t)|/w: 0 at a solution
  Eigen::Vector3d normal;  ///< of the own face, outward
  Eigen::Matrix<double, 1, 18> gap_by_corners;
  Eigen::Matrix<double, 18, 1> residual = Eigen::Matrix<double, 18, 1>::Zero();
  Eigen::Matrix<double, 18, 18> tangent = Eigen::Matrix<double, 18, 18>::Zero();
};

/// `carried` (MPa): the point's pressure so far; `softness` (MPa): A of the gap law; the area that t acts on is the own face's at rest.
PairPoint pair_point(const Meeting& meeting, const Triangle& own_rest, const Triangle& own, const Triangle& other, double carried, double softness);

}  // namespace palpate::contact
