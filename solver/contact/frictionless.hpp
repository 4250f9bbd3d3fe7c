// Frictionless contact of the organ's faces with a rigid tool, at quadrature points, by an augmented Lagrangian:
// pressure t = ⟨λ − ε g⟩, energy Σ w t²/(2ε). (Simo and Laursen 1992, Computers & Structures 42:97, eq. 2.17–2.20.)
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <array>
#include <vector>

#include <solver/contact/tool.hpp>

namespace palpate::contact {

constexpr int points_per_face = 6;
/// No point of a solution lies deeper inside the tool than this part of the local element size.
constexpr double deepest_gap = 0.01;

/// A rigid tool on its way: its tip is at first_contact + travel · axis.
struct Tool {
  tools::Shape shape;
  std::vector<double> parameters;
  Eigen::Vector3d axis;           ///< unit, direction of motion
  Eigen::Vector3d first_contact;  ///< the tip's place at first contact, mm
  double depth = 0;               ///< travel at full load, mm

  /// Distance at a point of space (mm), gradient and Hessian in the patient's frame.
  tools::Distance distance(const Eigen::Vector3d& x, double travel) const;
};

/// A face's corners, now and at rest, with its points' multipliers.
struct Face {
  std::array<Eigen::Vector3d, 3> rest, now;
  const double* multipliers = nullptr;  ///< points_per_face of them
};

/// What a face in contact adds to the equations, and to the tool's reaction.
struct FaceContact {
  bool touched = false;
  Eigen::Matrix<double, 9, 1> residual = Eigen::Matrix<double, 9, 1>::Zero();
  Eigen::Matrix<double, 9, 9> tangent = Eigen::Matrix<double, 9, 9>::Zero();
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< of the tool on the organ, N
  double area = 0;                                  ///< of the deformed face in contact, mm²
  std::array<double, points_per_face> pressure{};   ///< t, MPa
  double worst_gap = 0;   ///< largest |g|/size over points under pressure, and −g/size where it penetrates
};

/// `penalty_modulus` (MPa): ε = penalty_modulus / face size.
FaceContact face_contact(const Tool& tool, double travel, const Face& face, double penalty_modulus);

/// Edge of the equilateral triangle of the same area, mm: the local element size.
double face_size(const std::array<Eigen::Vector3d, 3>& corners);

/// Moves the tool along its axis through `aim` to where it first touches the points; false when it passes them by.
bool find_first_contact(Tool& tool, const Eigen::Vector3d& aim, const std::vector<Eigen::Vector3d>& points);

/// Part of `palpate list`.
CatalogueEntry frictionless_entry();

}  // namespace palpate::contact
