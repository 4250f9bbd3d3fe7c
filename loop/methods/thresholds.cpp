// The thresholds as JSON, and their hash.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/methods/thresholds.hpp>

#include <cstdint>
#include <cstdio>

namespace palpate::loop::thresholds {

Json as_json() {
  return {{"level", level}, {"null_sets", null_sets}, {"alternative", alternative}, {"relevance", relevance},
          {"hopeless_apart", hopeless_apart}, {"carried", carried}, {"most_effects", most_effects}, {"corner", corner}, {"refitted", refitted}, {"hopeless", hopeless}, {"confounded_cosine", confounded_cosine}, {"visible", visible},
          {"matters", matters}, {"further_matters", further_matters}, {"structure_margin", structure_margin}, {"unexplained_share", unexplained_share}, {"prior_weight", prior_weight}, {"prior_gain_sd", prior_gain_sd},
          {"prior_offset_sd", prior_offset_sd}, {"prior_drift_sd", prior_drift_sd}, {"drop_strength", drop_strength}, {"drop_share", drop_share}, {"swing_share", swing_share},
          {"swing_size", swing_size}, {"made_up", made_up}, {"prior_lateral_sd", prior_lateral_sd}, {"form_sd", form_sd}, {"form_tool_sd", form_tool_sd}, {"form_depth_sd", form_depth_sd}, {"one_run", one_run}, {"other_curve", other_curve}, {"wide_layer", wide_layer}, {"confirm_share", confirm_share}, {"error_fall", error_fall}};
}

std::string hash() {
  std::uint64_t h = 14695981039346656037ull;
  for (unsigned char c : as_json().dump()) h = (h ^ c) * 1099511628211ull;
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(h));
  return text;
}

}  // namespace palpate::loop::thresholds
