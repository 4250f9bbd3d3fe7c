// From a set and a model to the force each run should have read: instrument ∘ tissue ∘ instrument, averaged over blocks of samples.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <atomic>
#include <map>
#include <memory>

#include <loop/forward/backbone.hpp>
#include <loop/forward/clamp.hpp>
#include <loop/forward/effect.hpp>
#include <loop/forward/site_curve.hpp>

namespace palpate::loop {

/// An effect that is on.
struct Active {
  const Effect* effect = nullptr;
  double amplitude = 0;
  std::vector<double> shape;
};

struct Model {
  const Law* law = nullptr;
  std::vector<double> parameters;  ///< of the law
  double zero_mm = 0;              ///< contact lies so far below the tool's start (zero = "tool_start")
  double gain = 0;                 ///< of the rig, where it is known with a standard deviation
  double compliance_mm_per_N = 0;  ///< of the rig, where it is known
  double form[3] = {0, 0, 0};      ///< error of the elastic curve itself: × (1 + form₀ (2x − 1) + form₁ (6x² − 6x + 1)), x = depth/deepest + form₂
  std::map<std::string, std::array<double, 2>> tool_form;  ///< and of each further tool's: × (1 + e₀ + e₁ (2x − 1))
  double mesh_form = 0;            ///< of a case: how much further than the finer mesh the truth is from the coarser, less the third that is taken already (site_curve.hpp)
  std::vector<double> clamp_form;  ///< of a clamp's curves: how large each of their own errors is, in deviations (ClampCurves::forms)
  std::vector<Active> active;
};

class Forward {
 public:
  explicit Forward(const Set& set);
  const Set& set() const { return *set_; }
  /// Blocks of neighbouring samples, none across two phases; short phases have short blocks.
  int blocks(std::size_t run) const { return static_cast<int>(begin_[run].size()) - 1; }
  Eigen::VectorXd measured(std::size_t run) const { return averaged(run, set_->runs[run].F); }
  Eigen::VectorXd times(std::size_t run) const { return averaged(run, set_->runs[run].t); }
  /// Samples of the file behind each block, and of ours.
  Eigen::VectorXd samples_per_block(std::size_t run) const;
  Eigen::VectorXi rows_per_block(std::size_t run) const;
  std::string phase_of(std::size_t run, int block) const;
  Eigen::VectorXd averaged(std::size_t run, const std::vector<double>& values) const;
  /// The force, N (stress in MPa of a homogeneous test), of each sample.
  std::vector<double> force(std::size_t run, const Model& model) const;
  Eigen::VectorXd predicted(std::size_t run, const Model& model) const { return averaged(run, force(run, model)); }
  /// What the tissue itself goes through: its own depth (zero, play and compliance taken off), and the force on it, without the force cell.
  struct Pressed {
    Path depth_mm, force_N;
  };
  Pressed pressed(std::size_t run, const Model& model) const;
  /// Force on the tissue of an indentation that goes through these depths of its own.
  Path pressed_along(std::size_t run, const Model& model, Path depth_mm) const;
  /// How often a run's force was computed.
  long evaluations() const { return evaluations_; }
  Site site(const Run& run) const;
  /// From now on closed forms are those of these strains (finite without).
  void use(Strains strains) { strains_ = strains; }
  /// Clamps have their curves from solves alone.
  void use(std::shared_ptr<const ClampCurves> curves) { clamp_ = std::move(curves); }
  /// What a clamp's solved curve is off by within each block, as meshes differ there, for all runs at that place together, N; zero for anything else.
  Eigen::VectorXd curve_scatter(std::size_t run) const;
  int clamp_solves() const { return clamp_ ? clamp_->solves : 0; }
  /// From now on the closed form of runs with this tool and point is multiplied by the curve's factor at x = depth/deepest (beyond it as at it), and the changes by departures that
  /// were solved are multiplied by theirs: what solves of that site say about the closed form.
  void correct(SiteCurve curve) { corrections_.push_back(std::move(curve)); }
  /// From now on the row takes `size` times the solver's amplitude of this effect, at every place with a curve of its own. False: it has no such effect, or there is no such place.
  bool resize(const std::string& effect, double size);

 private:
  const SiteCurve* correction(const Run& run) const;
  /// Of the model, with sizes as the row needs them at this place.
  Tissue tissue_at(const Run& run, const Model& model) const;
  double elastic(const Run& run, const Site& site, const Tissue& tissue, double depth) const;
  /// `depth` of the tool becomes that of the tissue, where something gives way in series.
  Path clamped_force(const Run& run, const Model& model, const Tissue& tissue, Path& depth, double compliance) const;
  Path tissue_force(const Run& run, const Model& model, const Tissue& tissue, Path& depth, double compliance) const;
  const Set* set_;
  std::shared_ptr<const ClampCurves> clamp_;
  Strains strains_ = Strains::finite;
  double scale_;  ///< deepest elongation of the set: mm, or MPa of homogeneous tests
  std::vector<std::vector<int>> begin_;
  std::vector<SiteCurve> corrections_;
  mutable std::atomic<long> evaluations_ = 0;
};

/// Law, parameters and active effects of tissue as one Tissue.
Tissue tissue_of(const Model& model);

}  // namespace palpate::loop
