// Order of a run: case, state of a killed run, gravity, tools, steps, summary.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/run.hpp>

#include <sstream>

#include <palpate/text_file.hpp>
#include <solver/implicit/keep.hpp>

namespace palpate {

using implicit::Step;

namespace {

Case case_of(Command& c, const Settings& settings, const std::filesystem::path& mesh) {
  Case the_case = read_case(settings, mesh);
  if (mesh.empty()) c.add_input("mesh", the_case.mesh_path);
  for (std::size_t i = 0; i < the_case.tool_files.size(); ++i) c.add_input("tool " + std::to_string(i + 1), the_case.tool_files[i]);
  c.say(std::to_string(the_case.model.points.size()) + " nodes, " + std::to_string(the_case.model.tets.size()) + " tetrahedra, " +
        std::to_string(the_case.base_nodes) + " nodes held");
  return the_case;
}

}  // namespace

Run::Run(Command& c)
    : command_(c),
      settings_(Settings::read(c.input("case"))),
      mesh_(c.has("mesh") ? c.file("mesh") : ""),
      folder_(c.output("result")),
      case_(case_of(c, settings_, mesh_)),
      equilibrium_(case_.model, c.threads()),
      state_(implicit::rest_state(case_.model)),
      results_(folder_, case_, equilibrium_.assembly()) {
  if (c.has("sensitivities")) {
    sensitivities_.emplace(settings_, mesh_, number_paths(c.text("sensitivities")), equilibrium_, c.threads());
    observe_ = [this](const implicit::State& found) { sensitivities_->follow(found); };
  }
  restart_.emplace(c, folder_);
  if (auto bytes = restart_->read()) {
    Archive archive(std::move(*bytes));
    keep(archive);
    std::ostringstream line;
    line << "continues a run that was killed, from " << state_.time << " s";
    c.say(line.str());
  }
  results_.make_folders();
}

void Run::keep(Archive& archive) {
  archive(state_, equilibrium_, results_, settling_, pressing_, settled_);
  for (auto& tool : case_.model.tools) archive(tool.first_contact);
  if (sensitivities_) archive(*sensitivities_);
}

void Run::save() {
  restart_->write([this] {
    Archive archive;
    keep(archive);
    return archive.bytes();
  }, results_.files());
}

/// Gravity first, without tools; then they come to where they touch the organ that has sagged.
void Run::settle() {
  if (settled_ || case_.settling.times.empty()) return;
  if (settling_.done < 0) {
    take_tools_away(case_);
    if (sensitivities_) sensitivities_->take_tools_away();
  }
  const double reached = implicit::run_steps(equilibrium_, state_, case_.settling, settling_, [this](const Step& step) {
    results_.settled(step);
    save();
  }, observe_);
  if (reached < 0) {
    std::ostringstream where;
    where << "near (" << equilibrium_.trouble().place_mm.transpose() << ") mm of the organ at rest";
    throw Failure(ExitCode::not_converged, "gravity cannot be carried: " + equilibrium_.trouble().cause, where.str(),
                  "hold more of the organ, or give [gravity] more steps");
  }
  bring_tools(case_, state_);
  if (sensitivities_) sensitivities_->bring_tools();
  settled_ = true;
}

std::string Run::remark(const Step& step) const {
  std::ostringstream out;
  out.precision(3);
  const Driven d = driven(case_, step);
  out << "depth " << d.depth << " mm, force " << d.force << " N";
  return out.str();
}

/// The last time was not reached: an error that helps, or a warning when the case asks for what there is.
void Run::explain_stop() const {
  const implicit::Trouble& trouble = equilibrium_.trouble();
  std::ostringstream what, where;
  what << "stopped at " << time_ << " s of " << case_.steps.times.back() << " s, at depth " << results_.depth() << " mm: " << trouble.cause;
  where << "near (" << trouble.place_mm.transpose() << ") mm of the organ at rest";
  if (!case_.keep_partial || !(time_ > 0))
    throw Failure(ExitCode::not_converged, what.str(), where.str(), "[steps] keep_partial = true delivers what was reached");
  command_.warn(what.str() + "; " + where.str());
}

void Run::go() {
  Progress progress = command_.progress("solve", case_.count);
  settle();
  time_ = implicit::run_steps(equilibrium_, state_, case_.steps, pressing_, [&](const Step& step) {
    results_.add(step, step.index == case_.count);
    if (sensitivities_) sensitivities_->add(step);
    progress.update(step.index, remark(step));
    save();
  }, observe_);
  progress.finish();
  if (time_ < case_.steps.times.back()) explain_stop();
}

Json Run::finish() {
  restart_->remove();
  const Json summary = results_.finish(time_);
  if (sensitivities_) write_text(folder_ / "sensitivities.csv", sensitivities_->table());
  return summary;
}

}  // namespace palpate
