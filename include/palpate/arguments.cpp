// Words to values by CLI11; what a value may be is checked here against usage().
// SPDX-License-Identifier: GPL-3.0-or-later
#include <palpate/arguments.hpp>

#include <CLI/CLI.hpp>

#include <cmath>
#include <sstream>

#include <palpate/errors.hpp>
#include <palpate/nearest.hpp>

namespace palpate {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void misuse(const std::string& what, const std::string& where, const std::string& next) {
  throw Failure(ExitCode::misuse, what, where, next);
}

std::string expectation(const OptionSpec& option) {
  const std::string unit = option.unit.empty() || option.unit == "1" ? "" : " " + option.unit;
  const std::string range = range_text(option);
  return std::string(option.kind == OptionKind::integer ? "a whole number" : "a number") + (range.empty() ? "" : " " + range) +
         unit;
}

double parse_number(const OptionSpec& option, const std::string& text) {
  std::size_t end = 0;
  double value = 0;
  try {
    value = std::stod(text, &end);
  } catch (const std::exception&) {
    end = 0;
  }
  const bool exact = option.kind != OptionKind::integer || (value == std::floor(value) && std::abs(value) <= 9007199254740992.0);
  if (end == 0 || end != text.size() || !std::isfinite(value) || !exact)
    misuse("not a number that fits: " + text, "--" + option.name, expectation(option));
  if (!option.range.contains(value)) misuse("out of range: " + text, "--" + option.name, expectation(option));
  return value;
}

Json parse_point(const OptionSpec& option, const std::string& text) {
  Json point = Json::array();
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) point.push_back(parse_number(option, part));
  if (point.size() != 3 || text.ends_with(","))
    misuse("not a point: " + text, "--" + option.name, "three numbers in mm: 12.5,-3,40");
  return point;
}

Json parse_value(const OptionSpec& option, const std::string& text) {
  switch (option.kind) {
    case OptionKind::real: return parse_number(option, text);
    case OptionKind::integer: return static_cast<long>(parse_number(option, text));
    case OptionKind::points: return parse_point(option, text);
    case OptionKind::choice:
      for (const auto& choice : option.choices)
        if (choice == text) return text;
      misuse("unknown choice: " + text, "--" + option.name, "did you mean " + nearest_name(text, option.choices) + "?");
    default: return text;
  }
}

/// Words CLI11 left over: options nobody knows.
void reject_extras(const Usage& usage, const std::vector<std::string>& extras) {
  if (extras.empty()) return;
  const std::string word = extras.front();
  std::vector<std::string> known;
  for (const auto& option : all_options(usage)) known.push_back("--" + option.name);
  misuse("unknown option: " + word, "", "did you mean " + nearest_name(word.substr(0, word.find('=')), known) + "?");
}

fs::path without_trailing_slash(const std::string& text) {
  const fs::path path(text);
  return path.has_filename() || !path.has_relative_path() ? path : path.parent_path();
}

/// A .vtu written under the name x.stl would be taken for what it is not.
void expect_extension(const ArgumentSpec& spec, const fs::path& path) {
  const std::string extension = fs::path(spec.example).extension().string();
  if (spec.kind != ArgumentKind::file || extension.empty()) return;
  const bool either = spec.example.ends_with(".nii.gz");
  const std::string name = path.filename().string();
  if (either ? name.ends_with(".nii.gz") || name.ends_with(".nii") : name.ends_with(extension)) return;
  misuse("the name of " + spec.name + " does not end in " + (either ? ".nii.gz or .nii" : extension), path.string(),
         "a name like " + spec.example);
}

struct GivenWords {
  std::map<std::string, std::vector<std::string>> values;  ///< of options with a value
  std::map<std::string, bool> flags;
  std::vector<std::string> files;  ///< inputs, then outputs
};

GivenWords sort_words(const Usage& usage, const std::vector<std::string>& words) {
  CLI::App app;
  app.set_help_flag();
  app.allow_extras();
  GivenWords given;
  for (const auto& option : all_options(usage)) {
    if (option.kind == OptionKind::flag)
      app.add_flag("--" + option.name, given.flags[option.name]);
    else
      app.add_option("--" + option.name, given.values[option.name])
          ->expected(1)
          ->allow_extra_args(false)
          ->multi_option_policy(option.kind == OptionKind::points ? CLI::MultiOptionPolicy::TakeAll
                                                                  : CLI::MultiOptionPolicy::Throw);
  }
  app.add_option("files", given.files);
  try {
    app.parse(std::vector<std::string>(words.rbegin(), words.rend()));
  } catch (const CLI::ParseError& error) {
    misuse(error.what(), "", "see " + usage.program() + " --help");
  }
  reject_extras(usage, app.remaining());
  return given;
}

}  // namespace

Arguments parse_arguments(const Usage& usage, const std::vector<std::string>& words) {
  const GivenWords given = sort_words(usage, words);
  Arguments arguments;
  const std::size_t expected = usage.inputs.size() + usage.outputs.size();
  const bool several = !usage.inputs.empty() && usage.inputs.back().several;
  if (given.files.size() > expected && !several)
    misuse("one file too many: " + given.files[expected], "", "see " + usage.program() + " --help");
  std::size_t index = 0;
  const auto take = [&](const ArgumentSpec& spec) {
    const std::string text = index < given.files.size() ? given.files[index] : "";
    ++index;
    if (text.empty())
      misuse("missing: " + spec.name + " (" + spec.meaning + ")", "", usage.program() + " --help shows the usage");
    return without_trailing_slash(text);
  };
  for (const auto& spec : usage.inputs) {
    arguments.inputs[spec.name] = take(spec);
    if (!spec.several) continue;
    auto& all = arguments.several[spec.name] = {arguments.inputs[spec.name]};
    while (index + usage.outputs.size() < given.files.size()) all.push_back(take(spec));
  }
  for (const auto& spec : usage.outputs) expect_extension(spec, arguments.outputs[spec.name] = take(spec));
  for (const auto& option : all_options(usage)) {
    Json value = option.kind == OptionKind::flag ? Json(given.flags.at(option.name)) : option.default_value;
    if (option.kind != OptionKind::flag)
      for (const auto& text : given.values.at(option.name)) {
        if (option.kind == OptionKind::points)
          value.push_back(parse_value(option, text));
        else
          value = parse_value(option, text);
      }
    arguments.options[option.name] = value;
  }
  return arguments;
}

}  // namespace palpate
