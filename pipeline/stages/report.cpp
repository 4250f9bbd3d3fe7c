// palpate-report: a study folder as one self-contained page.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <palpate/command.hpp>
#include <palpate/text_file.hpp>
#include <pipeline/report/drawings.hpp>
#include <pipeline/report/facts.hpp>
#include <pipeline/report/page.hpp>
#include <pipeline/report/study.hpp>

using namespace palpate;

void usage(Usage& u) {
  u.name = "report";
  u.sentence = "Makes one self-contained HTML page of a study: pictures, curves, numbers, checks and cards.";
  u.details =
      "The page opens offline in any browser. It shows what the folder holds: labels.sheet.png, surface.vtp, mesh.vtu and every "
      "solve/<name> "
      "with its history and its deepest frame; what is missing is left out. Pictures are drawn by VTK on a private X server "
      "(Xvfb) and "
      "Mesa's software renderer, so no screen and no graphics card are needed, and the same files give the same page.";
  u.input("study", "result", "the folder that palpate run made; a study may end before the solve", ArgumentKind::open_folder);
  u.output("page", "report.html", "one HTML file that needs no other and no network");
}

void run(Command& c) {
  const Study study = read_study(c.input("study"));
  for (const auto& file : study.files_read) c.add_input(file.lexically_proximate(c.input("study")).generic_string(), file);
  const Drawings drawings = draw_study(study, [&](const std::string& what) {
    if (c.verbose()) c.say("drawing " + what);
  });
  const std::string html = page_html(study, drawings);
  write_text(c.output("page"), html);
  c.note("result", result_sentence(study));
  c.note("pictures", drawings.surface.size() + drawings.mesh.size() + (study.sheet_png.empty() ? 0 : 1));
  c.note("solves", study.solves.size());
  c.note("bytes", html.size());
}
