// Every number the verdict hangs on, in one place; the report carries their hash.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include <palpate/json.hpp>

namespace palpate::loop::thresholds {

inline constexpr double level = 0.01;             ///< of the smallest p over the catalogue, under the null
inline constexpr int null_sets = 1000;            ///< bootstrapped nulls per step
inline constexpr double alternative = 4.6;        ///< Δℓ within which another explanation is not excluded
inline constexpr double hopeless_apart = 100;     ///< of chi2 beyond the best, above which form errors and the noise's size are not asked whether they make up for it
inline constexpr double relevance = 0.2;          ///< fall of the leave-one-run-out excess error; share of the misfit left that a further effect must explain
inline constexpr double one_run = 0.8;            ///< share of a signature in one run, above which leaving it out says nothing
inline constexpr double carried = 4;              ///< amplitude over its jackknife deviation, above which a further effect is not one run's
inline constexpr int most_effects = 3;
inline constexpr double corner = 0.3;             ///< of a second difference between samples: when between them did the tool turn?
inline constexpr int refitted = 6;                ///< best candidates that are refitted, besides instruments
inline constexpr double hopeless = 0.02;          ///< of the best candidate's score: below it no refit
inline constexpr double confounded_cosine = 0.98; ///< of whitened tangents after projection: told apart by no data of this protocol
inline constexpr double visible = 4;              ///< ‖P s‖ e below which the protocol cannot see an effect
inline constexpr double matters = 0.002;          ///< change of the forces, rms over the largest, below which an effect is no finding
inline constexpr double further_matters = 0.02;   ///< the same of a further effect: a first one's form is not known to better
inline constexpr double error_fall = 0.005;       ///< of the error in N, as a share of itself, that an effect must bring
inline constexpr double structure_margin = 2;     ///< of the nulls' 99 % excess over their mean: room for noise of another shape than ours
inline constexpr double unexplained_share = 0.1;  ///< of the null's excess misfit that may be left by a claimed effect
inline constexpr double drop_strength = 8;        ///< of a sudden drop, over the usual change between neighbours
inline constexpr double drop_share = 0.015;       ///< of it, of the run's largest force
inline constexpr double swing_share = 0.5;        ///< of the scatter at rest that one frequency explains
inline constexpr double swing_size = 0.002;       ///< of it, of the largest force
inline constexpr double made_up = 10;             ///< change of other tests over the change of the one measured, above which one test does not carry a law
inline constexpr double prior_weight = 1;         ///< pseudo-observations behind each variance of the noise
inline constexpr double prior_gain_sd = 0.005;    ///< run-to-run, relative
inline constexpr double prior_offset_sd = 0.002;  ///< run-to-run, relative to the deepest point
inline constexpr double prior_drift_sd = 0.002;   ///< slow, relative to the run's largest force, falling as 1/order
inline constexpr double prior_lateral_sd = 0.005; ///< run-to-run, of lateral over axial force
inline constexpr double form_sd = 0.005;          ///< of the elastic curve's own error, linear and quadratic in depth, and from tool to tool, relative
inline constexpr double form_tool_sd = 0.002;     ///< of what depth changes from tool to tool, relative: closed forms against GetFEM with two balls (decision 042)
inline constexpr double form_depth_sd = 0.002;    ///< of the same in depth, relative to the deepest point
inline constexpr double confirm_share = 0.3;      ///< of the solver's change of force that the shortcut's, scaled, may leave (rms), and of its size it may be off by
inline constexpr double other_curve = 2;          ///< squares per block that must be unexplained before another elastic curve is thought of
inline constexpr double wide_layer = 2.5;         ///< heights from a side, beyond which it is not felt

/// All of them, by name.
Json as_json();
/// Hash of as_json(), 16 hexadecimal digits (FNV-1a, Fowler, Noll and Vo 1991).
std::string hash();

}  // namespace palpate::loop::thresholds
