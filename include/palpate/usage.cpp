// A program's usage as JSON, as Slicer Execution Model XML, as help text.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <palpate/usage.hpp>

#include <cmath>
#include <sstream>

namespace palpate {

Json finite_or_null(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json to_json(const CatalogueEntry& entry) {
  Json parameters = Json::array();
  for (const Parameter& p : entry.parameters)
    parameters.push_back({{"name", p.name},
                          {"unit", p.unit},
                          {"min", finite_or_null(p.range.min)},
                          {"max", finite_or_null(p.range.max)},
                          {"typical", p.typical},
                          {"meaning", p.meaning}});
  return {{"kind", entry.kind},
          {"name", entry.name},
          {"sentence", entry.sentence},
          {"reference", entry.reference},
          {"parameters", parameters}};
}

void Usage::input(std::string n, std::string example, std::string meaning, ArgumentKind kind) {
  inputs.push_back({std::move(n), kind, std::move(example), std::move(meaning)});
}
void Usage::output(std::string n, std::string example, std::string meaning, ArgumentKind kind) {
  outputs.push_back({std::move(n), kind, std::move(example), std::move(meaning)});
}
void Usage::side_output(std::string n, std::string of, std::string suffix, std::string meaning) {
  side_outputs.push_back({std::move(n), std::move(of), std::move(suffix), std::move(meaning)});
}
void Usage::real(std::string n, std::optional<double> fallback, std::string unit, Range range, std::string meaning) {
  options.push_back({std::move(n), OptionKind::real, std::move(unit), range, fallback ? Json(*fallback) : Json(), {}, std::move(meaning)});
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
      {"skip-current", OptionKind::flag, "", {}, false, {},
       "do nothing and print \"current\" when the card beside the output says that this very call made it"},
  };
  return options;
}

namespace {

const char* kind_name(OptionKind kind) {
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

Json argument_json(const ArgumentSpec& a) {
  return {{"name", a.name},
          {"kind", a.kind == ArgumentKind::file ? "file" : "folder"},
          {"example", a.example},
          {"meaning", a.meaning}};
}

Json option_json(const OptionSpec& o) {
  Json json = {{"name", o.name}, {"kind", kind_name(o.kind)}, {"unit", o.unit}, {"default", o.default_value}, {"meaning", o.meaning}};
  if (o.kind == OptionKind::real || o.kind == OptionKind::integer) {
    json["min"] = finite_or_null(o.range.min);
    json["max"] = finite_or_null(o.range.max);
  }
  if (!o.choices.empty()) json["choices"] = o.choices;
  return json;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (char c : text) switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      default: out += c;
    }
  return out;
}

const char* xml_element(OptionKind kind) {
  switch (kind) {
    case OptionKind::real: return "double";
    case OptionKind::integer: return "integer";
    case OptionKind::choice: return "string-enumeration";
    case OptionKind::flag: return "boolean";
    case OptionKind::points: return "point";
    case OptionKind::file: return "file";
    case OptionKind::text: return "string";
  }
  return "string";
}

std::string plain(const Json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

void xml_option(std::ostream& out, const OptionSpec& o) {
  const std::string tag = xml_element(o.kind);
  out << "    <" << tag << (o.kind == OptionKind::points ? " multiple=\"true\" coordinateSystem=\"lps\"" : "") << ">\n"
      << "      <name>" << o.name << "</name>\n      <longflag>--" << o.name << "</longflag>\n"
      << "      <label>" << o.name << (o.unit.empty() ? "" : " (" + escaped(o.unit) + ")") << "</label>\n"
      << "      <description>" << escaped(o.meaning) << "</description>\n";
  if (!o.default_value.is_null() && o.kind != OptionKind::points)
    out << "      <default>" << escaped(plain(o.default_value)) << "</default>\n";
  for (const auto& choice : o.choices) out << "      <element>" << escaped(choice) << "</element>\n";
  if ((o.kind == OptionKind::real || o.kind == OptionKind::integer) && std::isfinite(o.range.min) && std::isfinite(o.range.max))
    out << "      <constraints><minimum>" << o.range.min << "</minimum><maximum>" << o.range.max << "</maximum></constraints>\n";
  out << "    </" << tag << ">\n";
}

void xml_argument(std::ostream& out, const ArgumentSpec& a, const char* channel, std::size_t index) {
  const char* tag = a.kind == ArgumentKind::file ? "file" : "directory";
  out << "    <" << tag << ">\n      <name>" << a.name << "</name>\n      <index>" << index << "</index>\n      <channel>" << channel
      << "</channel>\n      <label>" << a.name << "</label>\n      <description>" << escaped(a.meaning) << "</description>\n    </" << tag
      << ">\n";
}

void help_option(std::ostream& out, const OptionSpec& o) {
  std::string left = "  --" + o.name;
  if (o.kind == OptionKind::points) left += " X,Y,Z";
  else if (o.kind != OptionKind::flag) left += " " + (o.unit.empty() || o.unit == "1" ? std::string(kind_name(o.kind)) : o.unit);
  out << left << std::string(left.size() < 30 ? 30 - left.size() : 1, ' ') << o.meaning;
  if (!o.choices.empty()) {
    out << " (";
    for (std::size_t i = 0; i < o.choices.size(); ++i) out << (i ? " | " : "") << o.choices[i];
    out << ")";
  }
  if (std::isfinite(o.range.min) || std::isfinite(o.range.max)) {
    out << " [" << o.range.min << " … " << o.range.max << "]";
  }
  const bool has_default = !o.default_value.is_null() && o.kind != OptionKind::flag && o.kind != OptionKind::points;
  if (has_default) out << " (default " << plain(o.default_value) << ")";
  out << "\n";
}

const char* const exit_codes =
    "exit codes: 0 done · 1 defect of ours · 2 misuse · 3 file unreadable or unwritable · 4 a check failed · 5 did not converge · "
    "6 refused\n";

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
          {"details", u.details}, {"inputs", inputs}, {"outputs", outputs}, {"options", options}, {"common_options", common}};
}

std::string slicer_xml(const Usage& u) {
  std::ostringstream out;
  out << "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<executable>\n  <category>Palpate</category>\n  <title>" << u.program()
      << "</title>\n  <description>" << escaped(u.sentence) << "</description>\n  <version>" << PALPATE_VERSION
      << "</version>\n  <license>GPL-3.0-or-later</license>\n  <parameters>\n    <label>Files</label>\n"
      << "    <description>Inputs and outputs</description>\n";
  std::size_t index = 0;
  for (const auto& a : u.inputs) xml_argument(out, a, "input", index++);
  for (const auto& a : u.outputs) xml_argument(out, a, "output", index++);
  out << "  </parameters>\n  <parameters>\n    <label>Options</label>\n    <description>Options</description>\n";
  for (const auto& o : u.options) xml_option(out, o);
  for (const auto& o : common_options()) xml_option(out, o);
  out << "  </parameters>\n</executable>\n";
  return out.str();
}

std::string help_text(const Usage& u) {
  std::ostringstream out;
  out << u.program() << ": " << u.sentence << "\n\nusage: " << u.program();
  for (const auto& a : u.inputs) out << " " << a.example;
  for (const auto& a : u.outputs) out << " " << a.example;
  out << " [options]\n";
  if (!u.details.empty()) out << "\n" << u.details << "\n";
  if (!u.inputs.empty()) out << "\nreads\n";
  for (const auto& a : u.inputs) out << "  " << a.name << ": " << a.meaning << "\n";
  if (!u.outputs.empty()) out << "writes\n";
  for (const auto& a : u.outputs) out << "  " << a.name << ": " << a.meaning << "\n";
  for (const auto& s : u.side_outputs) out << "  " << s.name << " (<" << s.of << ">" << s.suffix << "): " << s.meaning << "\n";
  out << "\noptions\n";
  for (const auto& o : u.options) help_option(out, o);
  out << "\ncommon options\n";
  for (const auto& o : common_options()) help_option(out, o);
  out << "  --help, --version, --describe (JSON), --xml (Slicer Execution Model), --catalogue (JSON)\n\n" << exit_codes;
  return out.str();
}

Json describe(const Group& g) {
  Json commands = Json::array(), common = Json::array();
  for (const Usage& u : g.commands) commands.push_back(describe(u));
  for (const auto& o : common_options()) common.push_back(option_json(o));
  return {{"schema", "palpate-describe/1"}, {"name", g.program}, {"version", PALPATE_VERSION}, {"sentence", g.sentence}, {"details", g.details},
          {"inputs", Json::array()}, {"outputs", Json::array()}, {"options", Json::array()}, {"common_options", common}, {"commands", commands}};
}

std::string slicer_xml(const Group& g) {
  return "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<executable>\n  <category>Palpate</category>\n  <title>" + g.program +
         "</title>\n  <description>" + escaped(g.sentence) + "</description>\n  <version>" PALPATE_VERSION
         "</version>\n  <license>GPL-3.0-or-later</license>\n</executable>\n";
}

std::string help_text(const Group& g) {
  std::ostringstream out;
  out << g.program << ": " << g.sentence << "\n\ncommands\n";
  for (const Usage& u : g.commands) {
    std::string left = "  " + u.program();
    for (const auto& a : u.inputs) left += " " + a.example;
    out << left << std::string(left.size() < 30 ? 30 - left.size() : 1, ' ') << u.sentence << "\n";
  }
  out << "\n" << g.details << "\n\n" << g.program << " <command> --help says more about one command.\n"
      << "  --help, --version, --describe (JSON), --xml (Slicer Execution Model), --catalogue (JSON)\n\n" << exit_codes;
  return out.str();
}

}  // namespace palpate
