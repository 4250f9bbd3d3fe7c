// A missing effect: what a model of tissue may lack, in the sockets the solver asks for it. One effect per file of this folder.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <string>
#include <vector>

#include <palpate/catalogue.hpp>
#include <solver/materials/law.hpp>

namespace palpate::effects {

using materials::Mat3;
using materials::Mat9;
using materials::Response;
using materials::Vec9;
using Vec6 = Eigen::Matrix<double, 6, 1>;

/// What an effect on the stress sees of a point, besides the elastic stress and its memory.
struct Point {
  Mat3 F;
  double time = 0;  ///< s
  double dt = 0;    ///< s since the memory was written; 0: at that very moment
  materials::Kinematics kinematics = materials::Kinematics::finite;
  double modulus = 1;  ///< factor on the law, see Start
};

/// The response of the law with the effects inside this one, as a function of F.
struct Inner {
  const void* context;
  Response (*call)(const void* context, const Mat3& F);
  Response operator()(const Mat3& F) const { return call(context, F); }
};

/// Socket `stress`. The tangent is symmetric: the stress of a step derives from a potential.
struct StressSocket {
  /// Doubles that a point remembers; zero at rest.
  int (*memory)(std::span<const double> parameters) = nullptr;
  /// Stress and tangent at F from the memory of the last accepted step; reads only.
  Response (*respond)(const Inner& inner, const Point& point, std::span<const double> memory, std::span<const double> parameters) = nullptr;
  /// Writes the memory that an accepted step at F leaves.
  void (*remember)(const Inner& inner, const Point& point, std::span<double> memory, std::span<const double> parameters) = nullptr;
};

/// What is so of a place of the tissue from the start.
struct Start {
  double modulus = 1;  ///< factor on the law's stress and on the volume energy
  double turgor = 0;   ///< MPa: isotropic tension of the tissue at rest, and the pressure of what fills it
};

/// Socket `start`: places are of the rest shape, mm. Either may be absent.
struct StartSocket {
  /// Changes what is so of a place.
  void (*begin)(const Eigen::Vector3d& place, std::span<const double> parameters, Start& start) = nullptr;
  /// Where a point of the mesh lies in the rest shape; and the factor on the thickness of a wall there.
  Eigen::Vector3d (*shape)(const Eigen::Vector3d& point, std::span<const double> parameters) = nullptr;
  double (*thickness)(const Eigen::Vector3d& point, std::span<const double> parameters) = nullptr;
};

/// It fits one socket. With the parameters that may be left out left out, the first one is the amplitude: 0 switches the effect off.
struct Effect {
  CatalogueEntry entry;     ///< kind "effect"
  bool many_terms = false;  ///< parameters may be lists of one length; they are stored term by term
  StressSocket stress = {};
  /// What is wrong with parameters that lie in their ranges but do not go together; empty: nothing. May be absent.
  std::string (*objection)(std::span<const double> parameters) = nullptr;
  StartSocket start = {};
};

/// The socket that it fits.
inline const char* socket(const Effect& effect) {
  if (effect.stress.respond) return "stress";
  return "start";
}

/// An effect with its numbers.
struct Active {
  Effect effect;
  std::vector<double> parameters;
};

/// Every effect of the folder, in alphabetical order (generated).
std::vector<Effect> all();

}  // namespace palpate::effects
