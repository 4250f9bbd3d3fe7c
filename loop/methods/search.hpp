// The search for the missing effect: score, refit, threshold, relevance, alternatives; forward with deletion.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <limits>

#include <loop/methods/oddities.hpp>
#include <loop/methods/score.hpp>
#include <loop/methods/session.hpp>
#include <loop/methods/thresholds.hpp>

namespace palpate::loop {

/// What became of a candidate at a step.
struct Tried {
  int candidate = 0;
  double z = 0, lambda_linear = 0;  ///< score of its best column
  bool refitted = false;
  double lambda = 0, p = 1;         ///< 2 Δℓ of the joint refit, and its share of nulls
  Fit fit;
  double left_out_fall = 0;         ///< of the leave-one-run-out excess; 0: not asked
  bool unproven = false;            ///< it passed the threshold, and only relevance speaks against it
  std::string reason;               ///< why it was not taken, or "taken"
};

/// What the protocol can show of a candidate.
struct BlindSpot {
  int candidate = 0;
  double smallest_visible = 0;  ///< amplitude with ‖P s‖ e = 4; infinite: cannot be told from the null's parameters
  bool visible = false;         ///< within the plausible range
  std::vector<int> like;        ///< candidates whose signature has a cosine beyond 0.98
};

enum class VerdictKind { claimed, confounded, unexplained, nothing_supported, ranking_only };
std::string kind_name(VerdictKind kind);

struct Finding {
  std::vector<Candidate> candidates;
  std::vector<std::vector<Tried>> steps;  ///< of each step every candidate that was scored
  std::vector<BlindSpot> blind_spots;
  Fit final;                              ///< null plus what was taken (for a ranking: plus the best)
  Model reported_before, reported_after;  ///< null and final with every block weighing the same: errors in N are told of these
  VerdictKind kind = VerdictKind::nothing_supported;
  std::vector<std::vector<std::string>> alternatives;  ///< sets of effects, the best first; one set: no other is left
  std::vector<double> alternative_distance;            ///< Δℓ behind the best
  double structure_before = 0, structure_after = 0, structure_limit = 0;
  double threshold_p = 0;
  std::vector<Oddity> oddities;           ///< of the final model's residuals
  std::vector<std::string> remarks;       ///< what a person should know of the choice
};

/// `remark` is told what is going on. Where the last effect allowed cannot bring the misfit down to `enough`, it is not asked whether it is a finding: the verdict is unexplained.
Finding search(Session& session, int null_sets, std::uint64_t seed, const std::function<void(const std::string&)>& remark,
               int most_effects = thresholds::most_effects, double enough = std::numeric_limits<double>::infinity());

/// The null with one effect of the catalogue fitted to it, at its best grid point. Throws Failure(misuse) for a name the catalogue does not have,
/// Failure(refused) for an effect this set leaves out, with the reason.
Fit fit_with(Session& session, const std::string& effect);

/// The blind-spot table alone: it needs no measured force beyond the null fit.
std::vector<BlindSpot> blind_spots(Session& session, const std::vector<Candidate>& candidates);

}  // namespace palpate::loop
