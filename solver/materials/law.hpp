// A material law: strain energy W(F) of the isochoric deformation, first Piola-Kirchhoff stress P = ∂W/∂F, tangent A = ∂P/∂F.
// The volume part is the element's: p (J − 1) − p²/(2κ), κ → ∞ allowed.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <span>
#include <string>
#include <vector>

#include <palpate/catalogue.hpp>

namespace palpate::materials {

using Mat3 = Eigen::Matrix3d;
using Mat9 = Eigen::Matrix<double, 9, 9>;
using Vec9 = Eigen::Matrix<double, 9, 1>;

/// Energy in MPa (N mm per mm³), stress in MPa, tangent in MPa with A(i + 3j, k + 3l) = ∂P_ij/∂F_kl.
struct Response {
  double W = 0;
  Mat3 P = Mat3::Zero();
  Mat9 A = Mat9::Zero();
};

/// How the element measures volume: J = det F, or 1 + tr(F − I) with the geometry not updated.
enum class Kinematics { finite, small };

struct Law {
  CatalogueEntry entry;
  Kinematics kinematics = Kinematics::finite;
  /// Requires det F > 0. `parameters` in the order of entry.parameters.
  Response (*respond)(const Mat3& F, std::span<const double> parameters) = nullptr;
  /// Initial shear modulus, MPa.
  double (*shear_modulus)(std::span<const double> parameters) = nullptr;
  /// Bulk modulus κ, MPa; infinite for an incompressible law.
  double (*bulk_modulus)(std::span<const double> parameters) = nullptr;
};

/// Every law of the folder, in alphabetical order (generated).
std::vector<Law> all();

inline double incompressible(std::span<const double>) { return std::numeric_limits<double>::infinity(); }

}  // namespace palpate::materials
