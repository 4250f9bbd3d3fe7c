// Contact of the organ's faces with a rigid tool, at quadrature points, by a perturbed Lagrangian: the pressure t is an
// unknown of its own, condensed at its point, and the gap it leaves is g(t) = −w t/(A + t): never deeper than w, at any pressure.
// (Simo, Wriggers, Taylor 1985, Comput. Methods Appl. Mech. Eng. 50:163, eq. 3.4, with this g(t) for their −t/ε; decision 021.) Friction: decision 024.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <array>
#include <vector>

#include <solver/amplitude.hpp>
#include <solver/contact/gap_law.hpp>
#include <solver/contact/quadrature.hpp>
#include <solver/contact/tool.hpp>
#include <solver/effects/effect.hpp>

namespace palpate::contact {

/// Where a tool is: its travel along the axis (mm), then its turn (rad).
struct Pose {
  double travel = 0, angle = 0;
  Pose(double travel_mm = 0, double angle_rad = 0) : travel(travel_mm), angle(angle_rad) {}
};

/// A rigid tool on its way: its tip is at first_contact + travel · axis, travel = depth · ramp(time). Or the force along the axis is
/// force · ramp(time) and the travel follows from the organ. It may turn about `spin` through a point that travels with it.
struct Tool {
  tools::Shape shape;
  std::vector<double> parameters;
  Eigen::Vector3d axis;           ///< unit, direction of motion
  Eigen::Vector3d first_contact;  ///< the tip's place at first contact, mm
  double depth = 0;               ///< mm
  Amplitude ramp;
  Eigen::Vector3d across = Eigen::Vector3d::Zero();  ///< the shape's x axis, as far as it is at right angles to `axis`; zero: any
  std::vector<effects::Active> tractions = {};  ///< friction, adhesion, …

  bool force_controlled = false;
  double force = 0;               ///< N, with force control; then there is no depth
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();   ///< unit: the axis of turning; zero: it does not turn
  Eigen::Vector3d pivot = Eigen::Vector3d::Zero();  ///< a point of that axis, from the tip at first contact, mm
  Amplitude turn{{{0, 0}, {1, 0}}};                 ///< angle, rad

  double travel(double time) const { return depth * ramp.at(time); }
  Pose pose(double time) const { return {travel(time), turn.at(time)}; }
  bool turns() const { return !spin.isZero(); }
  /// Whether a traction remembers where points were.
  bool holds_on() const;
  /// Gap up to which a traction acts, mm.
  double reach() const;
  Eigen::Matrix3d rotation(double angle) const { return Eigen::AngleAxisd(angle, spin).toRotationMatrix(); }
  /// The point of the axis of turning, mm.
  Eigen::Vector3d pivot_now(const Pose& pose) const { return first_contact + pivot + pose.travel * axis; }

  /// Columns: the shape's frame in the patient's; its z looks back along the axis.
  Eigen::Matrix3d frame() const;

  /// Distance at a point of space (mm), gradient and Hessian in the patient's frame.
  tools::Distance distance(const Eigen::Vector3d& x, const Pose& pose) const;
};

/// A face's corners, now and at rest, with the pressures its points carry.
struct Face {
  std::array<Eigen::Vector3d, 3> rest, now;
  const double* pressures = nullptr;  ///< points_per_face of them, MPa, not negative
  const Slip* slips = nullptr;        ///< points_per_face of them, for a tool that holds on
  const Branch* branches = nullptr;   ///< points_per_face of them, in a run close beside another
};

/// A contact point seen from one Newton step: t and g(t) linearised at the pressure it carries.
struct Point {
  double pressure = 0;   ///< MPa: what the gap asks for, to first order; 0 when the point is let go
  double stiffness = 0;  ///< −dt/dg, MPa/mm
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< out of the tool
  Eigen::Vector3d shear = Eigen::Vector3d::Zero();   ///< of the tool on the organ, MPa
  Eigen::Vector3d cling = Eigen::Vector3d::Zero();   ///< of what reaches out: of the tool on the organ, MPa
  bool slides = false, beyond = false;  ///< at friction's bound; whether that says so
};

/// What a face in contact adds to the equations, and to the tool's reaction.
struct FaceContact {
  bool touched = false;
  Eigen::Matrix<double, 9, 1> residual = Eigen::Matrix<double, 9, 1>::Zero();
  Eigen::Matrix<double, 9, 9> tangent = Eigen::Matrix<double, 9, 9>::Zero();
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< of the tool on the organ, N
  double area = 0;                                  ///< of the deformed face in contact, mm²
  double energy = 0;                                ///< stored in the gaps that pressures leave, N mm
  std::array<Point, points_per_face> points;
  double penetration = 0;  ///< deepest point, of the face's size
  double mismatch = 0;     ///< largest |g − g(t)|/w of a point: 0 at a solution
  int weakly_active = 0;   ///< points that touch without pressing: what comes next, contact or a gap, is of one side
};

/// `softness` (MPa): A, the pressure at which a point is half way to the deepest gap.
FaceContact face_contact(const Tool& tool, const Pose& pose, const Face& face, double softness);

/// Pressure of point `q` of a face after a part `length` of a Newton step that moves the face's corners by `corner_steps` against the tool.
double next_pressure(const Point& point, int q, double before, const std::array<Eigen::Vector3d, 3>& corner_steps, double length);

/// Where point `q` of a face is, seen from a tool: where a point that moves with the tool was before the tool moved.
Eigen::Vector3d place(const Tool& tool, const Pose& pose, const std::array<Eigen::Vector3d, 3>& corners, int q);

/// Edge of the equilateral triangle of the same area, mm: the local element size.
double face_size(const std::array<Eigen::Vector3d, 3>& corners);

/// Moves the tool along its axis through `aim` to where it first touches the triangles, be it between their corners; false when it passes them by.
bool find_first_contact(Tool& tool, const Eigen::Vector3d& aim, const std::vector<std::array<Eigen::Vector3d, 3>>& surface);

/// Parts of `palpate list`.
std::vector<CatalogueEntry> entries();

}  // namespace palpate::contact
