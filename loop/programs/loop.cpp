// palpate-loop: from measurement back to parameters and to the effect the model lacks.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <palpate/command.hpp>
#include <palpate/nearest.hpp>
#include <palpate/outputs.hpp>
#include <palpate/text_file.hpp>
#include <loop/forward/clamp_solves.hpp>
#include <loop/forward/process.hpp>
#include <loop/forward/register.hpp>
#include <loop/forward/solved_curves.hpp>
#include <loop/methods/searched.hpp>
#include <loop/methods/thresholds.hpp>
#include <loop/report/case_file.hpp>
#include <loop/report/confirm.hpp>
#include <loop/report/report.hpp>
#include <loop/set/thinned.hpp>

#include <chrono>
#include <numeric>
#include <optional>

using namespace palpate;
namespace fs = std::filesystem;

namespace {

std::vector<CatalogueEntry> catalogue() {
  std::vector<CatalogueEntry> entries;
  for (const loop::Effect& effect : loop::all_effects()) {
    entries.push_back(effect.entry);
    entries.back().kind = "effect";
    entries.back().sentence += effect.absent.empty() ? " (" + effect.entry.kind + ")" : " (" + effect.entry.kind + "; absent: " + effect.absent + ")";
  }
  return entries;
}

/// The set, or Failure(check_failed) with everything that is wrong with it.
loop::Set sound_set(Command& c) {
  loop::Set set = loop::read_set(c.input("set"));
  for (const loop::Run& run : set.runs) c.add_input("run " + run.id, run.file);
  if (!set.specimen.case_file.empty()) c.add_input("case", set.specimen.case_file);
  if (set.specimen.law != "unknown") loop::start_model(set, set.specimen.law);  // refuses a law that is none, and parameters that are not its own
  const auto list = loop::faults(set);
  std::string rest;
  for (std::size_t i = 1; i < list.size(); ++i) rest += "\n  also:  " + list[i];
  if (!list.empty())
    throw Failure(ExitCode::check_failed, "the set is not fit for the loop: " + list.front().substr(list.front().find(": ") + 2),
                  list.front().substr(0, list.front().find(": ")), rest.empty() ? "" : "correct this first" + rest);
  loop::thin(set);
  return set;
}

void set_input(Usage& u) { u.input("set", "set.toml", "the measured set: specimen, rig, tools, runs and their CSV files"); }

void solves_option(Usage& u) {
  u.text("solves", "", "folder that keeps what was solved, for the next call; without it every call solves its own");
}

/// The curves of a clamp, or nothing where there is none. Solves that are not to be kept lie in `scratch` until they are read; what a killed run
/// leaves there the next one removes.
std::shared_ptr<const loop::ClampCurves> clamp_of(Command& c, loop::Set& set, const fs::path& scratch) {
  if (!loop::is_clamp(set)) return nullptr;
  std::optional<PendingOutput> goes;
  fs::path solves = c.text("solves");
  if (solves.empty()) solves = goes.emplace(scratch / "palpate-solves", PendingOutput::Kind::folder, true).temporary();
  auto curves = std::make_shared<loop::ClampCurves>(loop::clamp_curves(set, solves, c.threads(), [&](const std::string& remark) { c.say(remark); }));
  set.clamp_forms = static_cast<int>(curves->forms.cols());
  set.clamp_form_sd = curves->form_sd();
  set.clamp_correlation = curves->correlation;
  return curves;
}

loop::Session prepared(Command& c, loop::Set& set) {
  const auto clamp = clamp_of(c, set, fs::temp_directory_path());
  return loop::prepared(set, [&](loop::Forward& forward) { forward.use(clamp); });
}

void usage_of_check(Usage& u) {
  u.name = "check";
  u.sentence = "Says in words what is wrong with a measured set or missing from it, by file and line.";
  set_input(u);
}
void run_of_check(Command& c) {
  const loop::Set set = sound_set(c);
  std::size_t samples = 0;
  for (const loop::Run& run : set.runs) samples += run.t.size();
  for (const std::string& remark : loop::remarks(set)) c.print("remark: " + remark);
  c.print("sound: " + std::to_string(set.runs.size()) + " runs, " + std::to_string(samples) + " samples");
}

void usage_of_noise(Usage& u) {
  u.name = "noise";
  u.sentence = "Prints the noise that replicates and air runs show, as JSON.";
  set_input(u);
  solves_option(u);
}
void run_of_noise(Command& c) {
  loop::Set set = sound_set(c);
  c.print(loop::noise_json(prepared(c, set)).dump(2));
}

void usage_of_blindspots(Usage& u) {
  u.name = "blindspots";
  u.sentence = "Prints what each effect could show with this protocol and what it cannot be told from, as JSON.";
  set_input(u);
  solves_option(u);
}
void run_of_blindspots(Command& c) {
  loop::Set set = sound_set(c);
  loop::Session session = prepared(c, set);
  loop::Finding finding;
  finding.candidates = loop::candidates_of(set);
  finding.blind_spots = loop::blind_spots(session, finding.candidates);
  c.print(loop::blind_spots_json(session, finding).dump(2));
}

void usage_of_fit(Usage& u) {
  u.name = "fit";
  u.sentence = "Fits the null model and prints its parameters, as JSON.";
  set_input(u);
  solves_option(u);
}
void run_of_fit(Command& c) {
  loop::Set set = sound_set(c);
  const loop::Session session = prepared(c, set);
  c.print(loop::parameters_json(session, session.null).dump(2));
}

void forward_option(Usage& u, const char* usual) {
  u.choice("forward", usual, {"auto", "closed", "solver"},
           "elastic curves: closed forms, or one run of palpate-solve per tool and place; auto: closed forms on a wide layer, else the solver where it can");
}
void null_sets_option(Usage& u) {
  u.integer("null-sets", loop::thresholds::null_sets, {100, 100000}, "bootstrapped sets without effect from which the threshold comes");
}

loop::Searched searched(Command& c, loop::Set& set, const std::vector<loop::SiteCurve>& curves = {}, const fs::path& scratch = fs::temp_directory_path()) {
  const auto clamp = clamp_of(c, set, scratch);
  const auto correct = [&](loop::Forward& forward) {
    forward.use(clamp);
    for (const auto& curve : curves) forward.correct(curve);
  };
  return loop::searched(set, correct, c.threads(), static_cast<int>(c.integer("null-sets")), c.seed(), [&](const std::string& remark) { c.say(remark); });
}

void usage_of_diagnose(Usage& u) {
  u.name = "diagnose";
  u.sentence = "Finds where the misfit lives and what may be missing, as JSON, and leaves the sealed runs sealed.";
  u.details = "Closed forms only. It prints the verdict on the fitted runs, the table of residuals before and after, and every candidate with its reason.";
  set_input(u);
  solves_option(u);
  null_sets_option(u);
}
void run_of_diagnose(Command& c) {
  loop::Set set = sound_set(c);
  const loop::Searched s = searched(c, set);
  c.print(loop::diagnosis_json(s.session, s.finding).dump(2));
}

void usage_of_add(Usage& u) {
  u.name = "add";
  u.sentence = "Writes the case of palpate-solve with the missing effect added and everything fitted anew.";
  u.details = "Without --effect the effects of the verdict (or of the ranking) are added. A simple shape's mesh is not written: palpate-loop run solves it by itself.";
  set_input(u);
  solves_option(u);
  u.output("case", "case.toml", "the case with the effect in it");
  u.text("effect", "", "an effect of the catalogue instead of the verdict's");
  null_sets_option(u);
}
void run_of_add(Command& c) {
  loop::Set set = sound_set(c);
  const bool asked = !c.text("effect").empty();
  loop::Searched s = asked ? loop::Searched{prepared(c, set), {}, {}} : searched(c, set);
  const loop::Fit fit = asked ? loop::fit_with(s.session, c.text("effect")) : s.finding.final;
  const std::string text = loop::case_file(s.session, fit.model);
  if (text.empty()) throw Failure(ExitCode::refused, "homogeneous tests have no case to press", set.file.string(), "palpate-loop run reports the law");
  write_text(c.output("case"), text);
  c.print(loop::parameters_json(s.session, fit).dump(2));
}

int earlier_looks(const fs::path& report) { return fs::exists(report) ? read_json(report).value("sealed_looks", 0) : 0; }

void usage_of_validate(Usage& u) {
  u.name = "validate";
  u.sentence = "Opens the sealed runs and tells the error before and after on them; every further look into the same file is counted.";
  set_input(u);
  solves_option(u);
  u.output("validation", "validation.json", "errors before and after by run, and how often the sealed runs were looked at");
  null_sets_option(u);
}
void run_of_validate(Command& c) {
  loop::Set set = sound_set(c);
  if (std::none_of(set.runs.begin(), set.runs.end(), [](const loop::Run& r) { return r.role == loop::Role::holdout; }))
    throw Failure(ExitCode::refused, "no sealed run", set.file.string(), "role = \"holdout\" for at least one run");
  const loop::Searched s = searched(c, set);
  const Json json = loop::validation_json(s.session, s.finding, earlier_looks(c.final_output("validation")));
  write_json(c.output("validation"), json);
  c.print(json.dump(2));
}

void usage_of_plan(Usage& u) {
  u.name = "plan";
  u.sentence = "Prints the next experiments, the cheapest first: what separates what is left, then what this protocol cannot see, as JSON.";
  set_input(u);
  solves_option(u);
  null_sets_option(u);
}
void run_of_plan(Command& c) {
  loop::Set set = sound_set(c);
  const loop::Searched s = searched(c, set);
  c.print(loop::plan_json(s.session, s.finding).dump(2));
}

void usage_of_run(Usage& u) {
  u.name = "run";
  u.sentence = "Closes the loop: finds the residual, names the effect the model lacks, adds it, and reports the error before and after.";
  u.details =
      "Everything up to the verdict uses the runs with role = \"fit\"; then the sealed ones (role = \"holdout\") are opened once, and every\n"
      "further look at them through the same folder is counted. The verdict is one of claimed, confounded, unexplained, nothing_supported,\n"
      "ranking_only; the exit code is 0 for each.";
  set_input(u);
  solves_option(u);
  u.output("result", "loop", "report.json; curves.csv: every run measured, before and after; case.toml: the case with the effect added", ArgumentKind::folder);
  forward_option(u, "auto");
  null_sets_option(u);
}

/// The sites' curves, or none: with auto a solver that is missing or fails leaves the closed forms, and says so.
std::vector<loop::SiteCurve> curves_of(Command& c, const loop::Set& set) {
  const std::string forward = c.text("forward");
  const fs::path solver = loop::beside("palpate-solve"), scratch = c.output("result") / "solves", kept = c.text("solves").empty() ? scratch : fs::absolute(c.text("solves"));
  if (loop::is_clamp(set) || forward == "closed" || (forward == "auto" && (solver.empty() || loop::is_wide_layer(set) || !loop::can_be_solved(set)))) return {};
  try {
    const auto curves = loop::solved_curves(set, solver, kept, c.threads(), [&](const std::string& remark) { c.say(remark); });
    fs::remove_all(scratch);
    return curves;
  } catch (const Failure& failure) {
    fs::remove_all(scratch);
    if (forward == "solver" || !set.specimen.case_file.empty()) throw;
    c.warn(std::string("closed forms instead of solved curves: ") + failure.what());
    return {};
  }
}

/// What was found, held against the solver; the folder it worked in is removed.
loop::Confirmation confirmed(Command& c, const loop::Searched& s) {
  const fs::path scratch = c.output("result") / "confirmation", solver = c.text("forward") == "closed" ? "" : loop::beside("palpate-solve");
  const fs::path kept = c.text("solves").empty() ? scratch : fs::absolute(c.text("solves")) / "confirmation";
  const bool solvable = loop::can_be_solved(*s.session.set);
  const loop::Confirmation confirmation = loop::confirmed(s.session, s.finding.final.model, solvable ? solver : "", kept, scratch, c.threads(), [&](const std::string& remark) { c.say(remark); });
  fs::remove_all(scratch);
  return confirmation;
}

void run_of_run(Command& c) {
  const auto start = std::chrono::steady_clock::now();
  loop::Set set = sound_set(c);
  c.say("null model and noise");
  const auto curves = curves_of(c, set);
  loop::tell_mesh_errors(curves, set);
  loop::Searched s = searched(c, set, curves, c.output("result"));
  loop::Confirmation confirmation = confirmed(c, s);
  loop::take_size(s.session, s.finding, confirmation);
  Json report = loop::report_json(s.session, s.finding, earlier_looks(c.final_output("result") / "report.json"));
  report["version"] = PALPATE_VERSION;
  report["set"] = {{"file", set.file.filename().string()}, {"sha256", sha256(set.file)}};
  const int others = confirmation.solves + s.session.forward->clamp_solves();
  report["solves"] = std::accumulate(curves.begin(), curves.end(), others, [](int sum, const loop::SiteCurve& curve) { return sum + curve.solves; });
  report["solved_curves"] = loop::solves_json(curves);
  report["elastic_curves"] = loop::tried_json(s.curves);
  report["confirmed_in_solver"] = loop::confirmation_json(confirmation);
  if (const std::string remark = loop::told(confirmation); !remark.empty()) report["remarks"].push_back(remark);
  report["curve_evaluations"] = s.session.forward->evaluations();
  report["seconds"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  write_json(c.output("result") / "report.json", report);
  write_text(c.output("result") / "curves.csv", loop::curves_csv(s.session, s.finding));
  if (const std::string text = loop::case_file(s.session, s.finding.final.model); !text.empty()) write_text(c.output("result") / "case.toml", text);
  c.note("verdict", report["verdict"]);
  c.print(report["verdict"]["sentence"].get<std::string>());
}

int unknown(const std::string& word, const std::vector<std::string>&) {
  throw Failure(ExitCode::misuse, "unknown command: " + word, "",
                "did you mean " + nearest_name(word, {"check", "noise", "blindspots", "fit", "diagnose", "add", "validate", "plan", "run", "--help", "--version", "--describe", "--xml", "--catalogue"}) +
                    "? palpate-loop --help lists the commands");
}

}  // namespace

int main(int argc, char** argv) {
  Group group;
  group.program = "palpate-loop";
  group.sentence = "Finds what measured forces say that the model lacks, adds it, and tells the error before and after.";
  group.details = "palpate-loop run set.toml loop does all of it; the other commands are its parts.";
  group.catalogue = catalogue;
  return run_group(argc, argv, group,
                   {{usage_of_check, run_of_check}, {usage_of_noise, run_of_noise}, {usage_of_blindspots, run_of_blindspots},
                    {usage_of_fit, run_of_fit}, {usage_of_diagnose, run_of_diagnose}, {usage_of_add, run_of_add},
                    {usage_of_validate, run_of_validate}, {usage_of_plan, run_of_plan}, {usage_of_run, run_of_run}},
                   unknown);
}
