// A program's usage as JSON (--describe).
// SPDX-License-Identifier: GPL-3.0-or-later
#include <palpate/usage.hpp>

namespace palpate {
namespace {

Json argument_json(const ArgumentSpec& a) {
  Json json = {{"name", a.name},
               {"kind", a.kind == ArgumentKind::file ? "file" : "folder"},
               {"example", a.example},
               {"meaning", a.meaning}};
  if (a.several) json["several"] = true;
  return json;
}

Json option_json(const OptionSpec& o) {
  Json json = {{"name", o.name},
               {"kind", option_kind_name(o.kind)},
               {"unit", o.unit},
               {"default", o.default_value},
               {"meaning", o.meaning}};
  if (o.kind == OptionKind::real || o.kind == OptionKind::integer) {
    json["min"] = finite_or_null(o.range.min);
    json["max"] = finite_or_null(o.range.max);
  }
  if (!o.choices.empty()) json["choices"] = o.choices;
  return json;
}

}  // namespace

Json describe(const Usage& u) {
  Json inputs = Json::array(), outputs = Json::array(), options = Json::array(), common = Json::array();
  for (const auto& a : u.inputs) inputs.push_back(argument_json(a));
  for (const auto& a : u.outputs) outputs.push_back(argument_json(a));
  for (const auto& s : u.side_outputs)
    outputs.push_back({{"name", s.name}, {"kind", "file"}, {"beside", s.of}, {"suffix", s.suffix}, {"meaning", s.meaning}});
  for (const auto& o : u.options) options.push_back(option_json(o));
  for (const auto& o : common_options()) common.push_back(option_json(o));
  return {{"schema", "palpate-describe/1"}, {"name", u.program()}, {"version", PALPATE_VERSION}, {"sentence", u.sentence},
          {"details", u.details},           {"inputs", inputs},    {"outputs", outputs},         {"options", options},
          {"common_options", common}};
}

Json describe(const Group& g) {
  Json commands = Json::array(), common = Json::array();
  for (const Usage& u : g.commands) commands.push_back(describe(u));
  for (const auto& o : common_options()) common.push_back(option_json(o));
  return {{"schema", "palpate-describe/1"}, {"name", g.program},       {"version", PALPATE_VERSION}, {"sentence", g.sentence},
          {"details", g.details},           {"inputs", Json::array()}, {"outputs", Json::array()},   {"options", Json::array()},
          {"common_options", common},       {"commands", commands}};
}

}  // namespace palpate
