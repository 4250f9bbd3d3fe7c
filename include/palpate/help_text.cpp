// A program's usage as text (--help).
// SPDX-License-Identifier: GPL-3.0-or-later
#include <palpate/usage.hpp>

#include <sstream>

namespace palpate {
namespace {

void help_option(std::ostream& out, const OptionSpec& o) {
  std::string left = "  --" + o.name;
  if (o.kind == OptionKind::points)
    left += " X,Y,Z";
  else if (o.kind != OptionKind::flag)
    left += " " + (o.unit.empty() || o.unit == "1" ? option_kind_name(o.kind) : o.unit);
  out << left << std::string(left.size() < 30 ? 30 - left.size() : 1, ' ') << o.meaning;
  if (!o.choices.empty()) {
    out << " (";
    for (std::size_t i = 0; i < o.choices.size(); ++i) out << (i ? " | " : "") << o.choices[i];
    out << ")";
  }
  if (const std::string range = range_text(o); !range.empty()) out << " [" << range << "]";
  if (o.kind != OptionKind::flag && !default_text(o).empty()) out << " (default " << default_text(o) << ")";
  out << "\n";
}

const char* const exit_codes =
    "exit codes: 0 done · 1 defect of ours · 2 misuse · 3 file unreadable or unwritable · 4 a check failed · 5 did not converge "
    "· "
    "6 refused\n";

}  // namespace

std::string help_text(const Usage& u) {
  std::ostringstream out;
  out << u.program() << ": " << u.sentence << "\n\nusage: " << u.program();
  for (const auto& a : u.inputs) out << " " << a.example << (a.several ? " …" : "");
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

std::string help_text(const Group& g) {
  std::ostringstream out;
  out << g.program << ": " << g.sentence << "\n\ncommands\n";
  for (const Usage& u : g.commands) {
    std::string left = "  " + u.program();
    for (const auto& a : u.inputs) left += " " + a.example;
    out << left << std::string(left.size() < 30 ? 30 - left.size() : 1, ' ') << u.sentence << "\n";
  }
  out << "\n"
      << g.details << "\n\n"
      << g.program << " <command> --help says more about one command.\n"
      << "  --help, --version, --describe (JSON), --xml (Slicer Execution Model), --catalogue (JSON)\n\n"
      << exit_codes;
  return out.str();
}

}  // namespace palpate
