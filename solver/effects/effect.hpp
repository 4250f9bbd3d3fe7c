// A missing effect: what a model of tissue may lack, in the sockets the solver asks for it. One effect per file of this folder.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <string>
#include <vector>

#include <palpate/catalogue.hpp>
#include <solver/contact/touch.hpp>
#include <solver/materials/known_law.hpp>

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
  const materials::KnownLaw* known = nullptr;  ///< asked instead of the law; it knows the stress alone
  materials::KnownLaw* learns = nullptr;       ///< is told what the law said
  materials::Asked asked = materials::Asked::all;

  bool wants_tangent() const { return asked == materials::Asked::all; }
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

/// Of a surface deformed by F (3 × 2, from its plane at rest): energy per rest area in N/mm, N = ∂W/∂F, A(i + 3a, k + 3b) = ∂N_ia/∂F_kb.
struct SurfaceResponse {
  double W = 0;
  Eigen::Matrix<double, 3, 2> N = Eigen::Matrix<double, 3, 2>::Zero();
  Eigen::Matrix<double, 6, 6> A = Eigen::Matrix<double, 6, 6>::Zero();
};

/// Socket `layer`: extra elements on a surface's faces.
struct LayerSocket {
  SurfaceResponse (*respond)(const Eigen::Matrix<double, 3, 2>& F, std::span<const double> parameters) = nullptr;
};

/// Traction of the tool on the organ, MPa, and its derivative by the point's place, MPa/mm.
struct Traction {
  Eigen::Vector3d value = Eigen::Vector3d::Zero();
  Eigen::Matrix3d by_place = Eigen::Matrix3d::Zero();
  bool slides = false, beyond = false;  ///< at its bound; whether the bound says so
};

/// Socket `traction`, at a point of contact with a tool, besides the contact's own pressure.
struct TractionSocket {
  Traction (*respond)(const contact::Touch& touch, std::span<const double> parameters) = nullptr;
  /// Gap up to which it acts, mm; without: only where there is pressure.
  double (*reach)(std::span<const double> parameters) = nullptr;
  bool holds_on = false;  ///< it needs Touch::before, and its value is what is remembered as the shear there; not symmetric
};

using contact::Branch;

/// A point of a region of the surface, as effects on the forces see it.
struct Held {
  Eigen::Vector3d displacement;  ///< mm
  Eigen::Vector3d normal;        ///< unit, outward, of the rest shape
  Branch branch = Branch::by_bound;
};

/// Traction on the organ per area at rest, MPa, and its derivative by the displacement, MPa/mm.
struct Push {
  Eigen::Vector3d traction = Eigen::Vector3d::Zero();
  Eigen::Matrix3d by_displacement = Eigen::Matrix3d::Zero();
  bool slides = false;
};

/// Socket `force`, on a region of the surface.
struct ForceSocket {
  /// Doubles that a point remembers; zero at rest.
  int (*memory)(std::span<const double> parameters) = nullptr;
  Push (*respond)(const Held& at, std::span<const double> memory, std::span<const double> parameters) = nullptr;
  /// Writes the memory that an accepted step leaves.
  void (*remember)(const Held& at, std::span<double> memory, std::span<const double> parameters) = nullptr;
  bool (*symmetric)(std::span<const double> parameters) = nullptr;  ///< whether the derivative is
};

/// It fits one socket. With the parameters that may be left out left out, the first one is the amplitude: 0 switches the effect off.
struct Effect {
  CatalogueEntry entry;     ///< kind "effect"
  bool many_terms = false;  ///< parameters may be lists of one length; they are stored term by term
  StressSocket stress = {};
  /// What is wrong with parameters that lie in their ranges but do not go together; empty: nothing. May be absent.
  std::string (*objection)(std::span<const double> parameters) = nullptr;
  std::vector<double> fallbacks = {};  ///< of the last parameters: those may be left out
  StartSocket start = {};
  LayerSocket layer = {};
  TractionSocket traction = {};
  ForceSocket force = {};
};

/// The socket that it fits.
inline const char* socket(const Effect& effect) {
  if (effect.stress.respond) return "stress";
  if (effect.layer.respond) return "layer";
  if (effect.traction.respond) return "traction";
  if (effect.force.respond) return "force";
  return "start";
}

/// What a parameter is when it is left out, or null.
inline const double* fallback(const Effect& effect, std::size_t parameter) {
  const std::size_t required = effect.entry.parameters.size() - effect.fallbacks.size();
  return parameter < required ? nullptr : &effect.fallbacks[parameter - required];
}

/// An effect with its numbers.
struct Active {
  Effect effect;
  std::vector<double> parameters;
};

/// What `friction` and `sticking` of a tool mean.
Effect friction();

/// Every effect of the folder, in alphabetical order (generated).
std::vector<Effect> all();

}  // namespace palpate::effects
