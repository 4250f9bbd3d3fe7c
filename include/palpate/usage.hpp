// What a command is: its inputs, outputs and options. Help, --describe, --xml, the card and the parser all read this.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <palpate/catalogue.hpp>
#include <palpate/json.hpp>

namespace palpate {

enum class ArgumentKind {
  file,
  folder,       ///< hashed with everything in it
  open_folder,  ///< only its file names are hashed: the program declares what it read with Command::add_input
};

/// A positional argument: a file or folder read or written.
struct ArgumentSpec {
  std::string name;
  ArgumentKind kind = ArgumentKind::file;
  std::string example;
  std::string meaning;
  bool several = false;  ///< one or more, one after the other; only the last input may be
};

/// An output whose name follows from another's: labels.nii.gz → labels.sheet.png.
struct SideOutputSpec {
  std::string name;
  std::string of;
  std::string suffix;
  std::string meaning;
};

enum class OptionKind { real, integer, text, choice, flag, points, file };

struct OptionSpec {
  std::string name;  ///< long name without dashes, words joined by '-'
  OptionKind kind = OptionKind::flag;
  std::string unit;    ///< "mm", "deg", "1", … ; empty for text
  Range range;         ///< of numbers
  Json default_value;  ///< null: decided by the program, which says how in `meaning`
  std::vector<std::string> choices;
  std::string meaning;
};

/// Filled by a program's usage(). Order of calls is the order on the command line and in help.
struct Usage {
  std::string name;                 ///< "segment" for palpate-segment
  std::string prefix = "palpate-";  ///< "palpate " for a command of a group: palpate run
  std::string sentence;             ///< what it does, one sentence
  std::string details;              ///< a paragraph for --help and the docs page; may be empty
  std::vector<ArgumentSpec> inputs, outputs;
  std::vector<SideOutputSpec> side_outputs;
  std::vector<OptionSpec> options;
  bool continues = false;           ///< an output folder that a killed run left is handed to the next run as it is
  std::function<std::vector<CatalogueEntry>()> catalogue;  ///< this program's part of `palpate list`; may be empty

  std::string program() const { return prefix + name; }
  void input(std::string name, std::string example, std::string meaning, ArgumentKind kind = ArgumentKind::file);
  /// One or more of it: Command::inputs.
  void several_inputs(std::string name, std::string example, std::string meaning, ArgumentKind kind = ArgumentKind::file);
  void output(std::string name, std::string example, std::string meaning, ArgumentKind kind = ArgumentKind::file);
  void side_output(std::string name, std::string of, std::string suffix, std::string meaning);
  void real(std::string name, std::optional<double> fallback, std::string unit, Range range, std::string meaning);
  void integer(std::string name, std::optional<long> fallback, Range range, std::string meaning);
  void text(std::string name, std::optional<std::string> fallback, std::string meaning);
  void choice(std::string name, std::string fallback, std::vector<std::string> choices, std::string meaning);
  void flag(std::string name, std::string meaning);
  /// Points in mm, `--name x,y,z`, repeatable.
  void points(std::string name, std::string meaning);
  /// A further file read when given; hashed in the card.
  void file(std::string name, std::string meaning);
};

/// "real", "integer", … as `--describe` names it.
std::string option_kind_name(OptionKind kind);

/// The default as text; empty when there is none.
std::string default_text(const OptionSpec& option);

/// "from 0 to 10", "at least 0"; empty when any number will do.
std::string range_text(const OptionSpec& option);

/// The program as JSON (`--describe`): inputs, outputs, options with unit, range, default, meaning.
Json describe(const Usage& usage);

/// The program as a Slicer Execution Model description (`--xml`).
std::string slicer_xml(const Usage& usage);

/// The program as text (`--help`).
std::string help_text(const Usage& usage);

/// Several commands under one program: `palpate run`, `palpate list`.
struct Group {
  std::string program;  ///< "palpate"
  std::string sentence;
  std::string details;
  std::vector<Usage> commands;
  std::function<std::vector<CatalogueEntry>()> catalogue;  ///< this program's part of `palpate list`; may be empty
};
Json describe(const Group& group);
std::string slicer_xml(const Group& group);  ///< Slicer knows no groups: an executable without parameters
std::string help_text(const Group& group);

/// The options every program has: threads, seed, quiet, verbose, force, skip-current.
const std::vector<OptionSpec>& common_options();

/// The program's options, then the common ones.
std::vector<OptionSpec> all_options(const Usage& usage);

}  // namespace palpate
