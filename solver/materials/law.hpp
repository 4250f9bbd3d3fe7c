// A material law: strain energy W(F) of the isochoric deformation, first Piola-Kirchhoff stress P = ∂W/∂F, tangent A = ∂P/∂F.
// The volume part is the element's: p (J − 1) − U*(p), volume_energy.hpp; κ → ∞ allowed.
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

/// What of a response is wanted: with the stress alone the tangent is left unwritten.
enum class Asked { all, stress };

/// How the element measures volume: J = det F, or 1 + tr(F − I) with the geometry not updated.
enum class Kinematics { finite, small };

struct Law {
  CatalogueEntry entry;
  Kinematics kinematics = Kinematics::finite;
  /// Requires det F > 0. `parameters` in the order of entry.parameters.
  Response (*function)(const Mat3& F, std::span<const double> parameters, Asked asked) = nullptr;
  Response respond(const Mat3& F, std::span<const double> parameters, Asked asked = Asked::all) const { return function(F, parameters, asked); }
  /// Initial shear modulus, MPa.
  double (*shear_modulus)(std::span<const double> parameters) = nullptr;
  /// Bulk modulus κ, MPa; infinite for an incompressible law.
  double (*bulk_modulus)(std::span<const double> parameters) = nullptr;
  /// How many D_i a case may give besides the parameters, for a volume energy Σ (J − 1)^(2i)/D_i: 0 to 3.
  int volume_terms = 0;
  /// What is wrong with parameters that lie in their ranges but do not go together; empty: nothing. May be absent.
  std::string (*objection)(std::span<const double> parameters) = nullptr;
};

/// Every law of the folder, in alphabetical order (generated).
std::vector<Law> all();

inline double incompressible(std::span<const double>) { return std::numeric_limits<double>::infinity(); }

}  // namespace palpate::materials
