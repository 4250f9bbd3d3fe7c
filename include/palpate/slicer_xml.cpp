// A program's usage as a Slicer Execution Model description (--xml).
// SPDX-License-Identifier: GPL-3.0-or-later
#include <palpate/usage.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace palpate {
namespace {

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

/// Slicer makes a variable of every name.
std::string identifier(std::string name) {
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

std::string number(const OptionSpec& option, double x) {
  return option.kind == OptionKind::integer ? std::to_string(static_cast<long>(x)) : Json(x).dump();
}

void xml_option(std::ostream& out, const OptionSpec& o) {
  const std::string tag = xml_element(o.kind);
  out << "    <" << tag << (o.kind == OptionKind::points ? " multiple=\"true\" coordinateSystem=\"lps\"" : "") << ">\n"
      << "      <name>" << identifier(o.name) << "</name>\n      <longflag>--" << o.name << "</longflag>\n"
      << "      <label>" << o.name << (o.unit.empty() ? "" : " (" + escaped(o.unit) + ")") << "</label>\n"
      << "      <description>" << escaped(o.meaning) << "</description>\n";
  if (!o.default_value.is_null() && o.kind != OptionKind::points)
    out << "      <default>" << escaped(default_text(o)) << "</default>\n";
  for (const auto& choice : o.choices) out << "      <element>" << escaped(choice) << "</element>\n";
  if (std::isfinite(o.range.min) && std::isfinite(o.range.max))
    out << "      <constraints><minimum>" << number(o, o.range.min) << "</minimum><maximum>" << number(o, o.range.max)
        << "</maximum></constraints>\n";
  out << "    </" << tag << ">\n";
}

void xml_argument(std::ostream& out, const ArgumentSpec& a, const char* channel, std::size_t index) {
  const char* tag = a.kind == ArgumentKind::file ? "file" : "directory";
  out << "    <" << tag << ">\n      <name>" << identifier(a.name) << "</name>\n      <index>" << index
      << "</index>\n      <channel>" << channel << "</channel>\n      <label>" << a.name << "</label>\n      <description>"
      << escaped(a.meaning) << "</description>\n    </" << tag << ">\n";
}

}  // namespace

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

std::string slicer_xml(const Group& g) {
  return "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<executable>\n  <category>Palpate</category>\n  <title>" + g.program +
         "</title>\n  <description>" + escaped(g.sentence) +
         "</description>\n  <version>" PALPATE_VERSION "</version>\n  <license>GPL-3.0-or-later</license>\n</executable>\n";
}

}  // namespace palpate
