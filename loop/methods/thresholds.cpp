// The thresholds as JSON, and their hash.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/methods/thresholds.hpp>

#include <cstdint>
#include <cstdio>

namespace palpate::loop::thresholds {

Json as_json() {
  return {{"level", level}, {"null_sets", null_sets}, {"alternative", alternative}, {"relevance", relevance},
          {"most_effects", most_effects}, {"second_share", second_share}, {"corner", corner}, {"refitted", refitted}, {"confounded_cosine", confounded_cosine}, {"visible", visible},
          {"unexplained_share", unexplained_share}, {"prior_weight", prior_weight}, {"prior_gain_sd", prior_gain_sd},
          {"prior_offset_sd", prior_offset_sd}, {"prior_drift_sd", prior_drift_sd}, {"form_sd", form_sd}};
}

std::string hash() {
  std::uint64_t h = 14695981039346656037ull;
  for (unsigned char c : as_json().dump()) h = (h ^ c) * 1099511628211ull;
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(h));
  return text;
}

}  // namespace palpate::loop::thresholds
