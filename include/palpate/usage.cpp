// How a program fills its usage, and the options every program has.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <palpate/usage.hpp>

#include <cmath>
#include <sstream>

namespace palpate {

void Usage::input(std::string n, std::string example, std::string meaning, ArgumentKind kind) {
  inputs.push_back({std::move(n), kind, std::move(example), std::move(meaning), false});
}
void Usage::several_inputs(std::string n, std::string example, std::string meaning, ArgumentKind kind) {
  inputs.push_back({std::move(n), kind, std::move(example), std::move(meaning), true});
}
void Usage::output(std::string n, std::string example, std::string meaning, ArgumentKind kind) {
  outputs.push_back({std::move(n), kind, std::move(example), std::move(meaning), false});
}
void Usage::side_output(std::string n, std::string of, std::string suffix, std::string meaning) {
  side_outputs.push_back({std::move(n), std::move(of), std::move(suffix), std::move(meaning)});
}
void Usage::real(std::string n, std::optional<double> fallback, std::string unit, Range range, std::string meaning) {
  options.push_back(
      {std::move(n), OptionKind::real, std::move(unit), range, fallback ? Json(*fallback) : Json(), {}, std::move(meaning)});
}
void Usage::integer(std::string n, std::optional<long> fallback, Range range, std::string meaning) {
  options.push_back({std::move(n), OptionKind::integer, "1", range, fallback ? Json(*fallback) : Json(), {}, std::move(meaning)});
}
void Usage::text(std::string n, std::optional<std::string> fallback, std::string meaning) {
  options.push_back({std::move(n), OptionKind::text, "", {}, fallback ? Json(*fallback) : Json(), {}, std::move(meaning)});
}
void Usage::choice(std::string n, std::string fallback, std::vector<std::string> choices, std::string meaning) {
  options.push_back({std::move(n), OptionKind::choice, "", {}, std::move(fallback), std::move(choices), std::move(meaning)});
}
void Usage::flag(std::string n, std::string meaning) {
  options.push_back({std::move(n), OptionKind::flag, "", {}, false, {}, std::move(meaning)});
}
void Usage::points(std::string n, std::string meaning) {
  options.push_back({std::move(n), OptionKind::points, "mm", {}, Json::array(), {}, std::move(meaning)});
}
void Usage::file(std::string n, std::string meaning) {
  options.push_back({std::move(n), OptionKind::file, "", {}, Json(), {}, std::move(meaning)});
}

const std::vector<OptionSpec>& common_options() {
  static const std::vector<OptionSpec> options = {
      {"threads", OptionKind::integer, "1", {0, 1024}, 0, {}, "threads to use; 0: all cores"},
      {"seed", OptionKind::integer, "1", {0, 1e15}, 1, {}, "seed of every random number"},
      {"quiet", OptionKind::flag, "", {}, false, {}, "no progress and no messages but errors"},
      {"verbose", OptionKind::flag, "", {}, false, {}, "more messages"},
      {"force", OptionKind::flag, "", {}, false, {}, "replace outputs that exist"},
      {"skip-current",
       OptionKind::flag,
       "",
       {},
       false,
       {},
       "do nothing and print \"current\" when the card beside the output says that this very call made it"},
  };
  return options;
}

std::vector<OptionSpec> all_options(const Usage& usage) {
  std::vector<OptionSpec> options = usage.options;
  options.insert(options.end(), common_options().begin(), common_options().end());
  return options;
}

std::string option_kind_name(OptionKind kind) {
  switch (kind) {
    case OptionKind::real: return "real";
    case OptionKind::integer: return "integer";
    case OptionKind::text: return "text";
    case OptionKind::choice: return "choice";
    case OptionKind::flag: return "flag";
    case OptionKind::points: return "points";
    case OptionKind::file: return "file";
  }
  return "";
}

std::string default_text(const OptionSpec& option) {
  const Json& value = option.default_value;
  if (value.is_null() || option.kind == OptionKind::points) return "";
  return value.is_string() ? value.get<std::string>() : value.dump();
}

std::string range_text(const OptionSpec& option) {
  const auto [min, max] = option.range;
  std::ostringstream text;
  text.precision(15);
  if (std::isfinite(min) && std::isfinite(max))
    text << "from " << min << " to " << max;
  else if (std::isfinite(min))
    text << "at least " << min;
  else if (std::isfinite(max))
    text << "at most " << max;
  return text.str();
}

}  // namespace palpate
