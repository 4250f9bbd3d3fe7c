// palpate-report: a study folder as one self-contained page.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <palpate/command.hpp>
#include <palpate/text_file.hpp>
#include <pipeline/report/drawings.hpp>
#include <pipeline/report/facts.hpp>
#include <pipeline/report/findings.hpp>
#include <pipeline/report/loop_page.hpp>
#include <pipeline/report/page.hpp>
#include <pipeline/report/side_by_side_page.hpp>
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
      "Mesa's software renderer, so no screen and no graphics card are needed, and the same files give the same page. A folder of "
      "palpate-loop run gets the page of its verdict; in a study's folder it is looked for as loop/, and what palpate-compare wrote as compare/.";
  u.input("study", "result", "the folder that palpate run made, which may end before the solve; or the folder that palpate-loop run made", ArgumentKind::open_folder);
  u.output("page", "report.html", "one HTML file that needs no other and no network");
}

namespace {

void add_inputs(Command& c, const std::vector<std::filesystem::path>& files) {
  for (const auto& file : files) c.add_input(file.lexically_proximate(c.input("study")).generic_string(), file);
}

void deliver(Command& c, const std::string& html, const std::string& result) {
  write_text(c.output("page"), html);
  c.note("result", result);
  c.note("bytes", html.size());
}

std::string sentence(const Findings& findings) { return findings.report.at("verdict").at("sentence").get<std::string>(); }

}  // namespace

void run(Command& c) {
  if (is_loop_folder(c.input("study"))) {
    const Findings findings = read_findings(c.input("study"));
    add_inputs(c, findings.files_read);
    const std::string html = loop_page_html(findings);
    return deliver(c, html, sentence(findings));
  }
  const Study study = read_study(c.input("study"));
  add_inputs(c, study.files_read);
  Additions additions;
  if (const auto loop = c.input("study") / "loop"; is_loop_folder(loop)) {
    const Findings findings = read_findings(loop);
    add_inputs(c, findings.files_read);
    additions.missing_effect = verdict_html(findings);
  }
  if (const auto compare = c.input("study") / "compare" / "compare.json"; std::filesystem::is_regular_file(compare)) {
    add_inputs(c, {compare});
    additions.side_by_side = side_by_side_html(compare.parent_path());
  }
  const Drawings drawings = draw_study(study, [&](const std::string& what) {
    if (c.verbose()) c.say("drawing " + what);
  });
  deliver(c, page_html(study, drawings, additions), result_sentence(study));
  c.note("pictures", drawings.surface.size() + drawings.mesh.size() + (study.sheet_png.empty() ? 0 : 1));
  c.note("solves", study.solves.size());
}
