// Order of a run: case, state of a killed run, gravity, tools, steps, summary.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/run.hpp>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <utility>

#include <palpate/text_file.hpp>
#include <solver/implicit/keep.hpp>
#include <solver/moved_case.hpp>
#include <solver/remesh.hpp>

namespace palpate {

using implicit::Step;

namespace {

Case case_of(Command& c, const Settings& settings, const std::filesystem::path& mesh) {
  Case the_case = read_case(settings, mesh);
  if (mesh.empty()) c.add_input("mesh", the_case.mesh_path);
  for (std::size_t i = 0; i < the_case.tool_files.size(); ++i) c.add_input("tool " + std::to_string(i + 1), the_case.tool_files[i]);
  c.say(std::to_string(the_case.model.points.size()) + " nodes, " + std::to_string(the_case.model.tets.size()) + " tetrahedra, " +
        std::to_string(the_case.base.size()) + " nodes held");
  return the_case;
}

double least_shape(const Case& c, const implicit::State& state) {
  const auto of_all = shapes(c.model, state);
  return *std::min_element(of_all.begin(), of_all.end());
}

}  // namespace

Run::Run(Command& c)
    : command_(c),
      settings_(Settings::read(c.input("case"))),
      mesh_(c.has("mesh") ? c.file("mesh") : ""),
      folder_(c.output("result")),
      case_(std::make_unique<Case>(case_of(c, settings_, mesh_))),
      equilibrium_(std::make_unique<implicit::Equilibrium>(case_->model, c.threads())),
      state_(implicit::rest_state(case_->model)),
      results_(folder_, *case_, equilibrium_->assembly()) {
  if (c.has("sensitivities")) {
    sensitivities_.emplace(settings_, mesh_, number_paths(c.text("sensitivities")), *equilibrium_, c.threads());
    for (const auto& remark : sensitivities_->remarks()) c.warn(remark);
  }
  observe_ = [this](const implicit::Accepted& found) {
    results_.accepted(found);
    if (sensitivities_) sensitivities_->follow(found.state);
  };
  restart_.emplace(c, folder_);
  if (auto bytes = restart_->read()) {
    Archive archive(std::move(*bytes));
    keep(archive);
    std::ostringstream line;
    line << "continues a run that was killed, from " << state_.time << " s";
    c.say(line.str());
  }
  results_.make_folders();
  if (case_->remesh) std::filesystem::create_directory(folder_ / "remesh");
}

void Run::keep(Archive& archive) {
  archive(meshes_, failed_remeshings_, too_large_);
  if (archive.reading() && !meshes_.empty()) {
    *case_ = case_on(settings_, folder_ / meshes_.back(), *case_);
    equilibrium_ = std::make_unique<implicit::Equilibrium>(case_->model, command_.threads());
    results_.follow(*case_, equilibrium_->assembly());
    if (sensitivities_) sensitivities_->use_mesh(folder_ / meshes_.back(), *equilibrium_, nullptr);
  }
  archive(state_, *equilibrium_, results_, settling_, pressing_, settled_);
  for (auto& tool : case_->model.tools) archive(tool.first_contact);
  if (sensitivities_) archive(*sensitivities_);
}

std::vector<std::string> Run::files() const {
  std::vector<std::string> files = results_.files();
  files.insert(files.end(), meshes_.begin(), meshes_.end());
  return files;
}

std::string Run::bytes() {
  Archive archive;
  keep(archive);
  return archive.bytes();
}

void Run::save() {
  if (case_->remesh) snapshot_ = bytes();
  restart_->write([this] { return case_->remesh ? snapshot_ : bytes(); }, files());
}

/// Gravity first, without tools; then they come to where they touch the organ that has sagged.
void Run::settle() {
  if (settled_ || case_->settling.times.empty()) return;
  if (settling_.done < 0) {
    take_tools_away(*case_);
    if (sensitivities_) sensitivities_->take_tools_away();
  }
  const double reached = implicit::run_steps(*equilibrium_, state_, case_->settling, settling_, [this](const Step& step) {
    results_.settled(step);
    save();
  }, observe_);
  if (reached < 0) {
    std::ostringstream where;
    where << "near (" << equilibrium_->trouble().place_mm.transpose() << ") mm of the organ at rest";
    throw Failure(ExitCode::not_converged, "gravity cannot be carried: " + equilibrium_->trouble().cause, where.str(),
                  "hold more of the organ, or give [gravity] more steps");
  }
  bring_tools(*case_, state_);
  if (sensitivities_) sensitivities_->bring_tools();
  settled_ = true;
}

std::string Run::remark(const Step& step) const {
  std::ostringstream out;
  out.precision(3);
  const Driven d = driven(*case_, step);
  out << "depth " << d.depth << " mm, force " << d.force << " N";
  return out.str();
}

/// The last time was not reached: an error that helps, or a warning when the case asks for what there is.
void Run::explain_stop() const {
  std::ostringstream what, where;
  what << "stopped at " << time_ << " s of " << case_->steps.times.back() << " s, at depth " << results_.depth() << " mm: " << trouble_.cause;
  where << "near (" << trouble_.place_mm.transpose() << ") mm of the organ at rest";
  if (!case_->keep_partial || !(time_ > 0))
    throw Failure(ExitCode::not_converged, what.str(), where.str(), "[steps] keep_partial = true delivers what was reached");
  command_.warn(what.str() + "; " + where.str());
}

bool Run::may_remesh() const {
  constexpr int most_failures = 2;
  return case_->remesh && static_cast<int>(meshes_.size()) < case_->remesh->most && failed_remeshings_ < most_failures &&
         static_cast<int>(case_->model.points.size()) < case_->remesh->most_nodes;
}

/// Does the mesh suit the tools and the organ's shape as they are now? If not, marks_ say where.
bool Run::suits(const Step& step) {
  if (!may_remesh() || too_large_ || step.index == 0) return true;
  marks_ = marks(case_->model, step.state, step.equations.contact, *case_->remesh);
  marked_force_ = driven(*case_, step).force;
  return marks_.longest_mm.empty();
}

void Run::report(const Step& step, Progress& progress) {
  results_.add(step, step.index == case_->count);
  if (sensitivities_) sensitivities_->add(step);
  progress.update(step.index, remark(step));
  save();
}

/// The step that waits, after equilibrium is found again on a finer mesh; the mesh it was found on reports it where there is no better one.
void Run::report_on_a_finer_mesh(Progress& progress) {
  auto& [index, equations, iterations, cuts, drags] = *coarse_;
  if (auto found = remesh()) equations = std::move(found->equations);
  report({index, state_, equations, iterations, cuts, drags}, progress);
  coarse_.reset();
}

/// A step could not be made: finer where it stopped, from the last reported step on. Nearer to where it stopped equilibrium is hard to find again.
bool Run::mend() {
  if (!may_remesh()) return false;
  const int failed = failed_remeshings_;
  const bool too_large = too_large_;
  Archive back(snapshot_);
  keep(back);
  failed_remeshings_ = failed;
  too_large_ = too_large;
  pressing_.part = 0.5;
  marks_ = {trouble_marks(case_->model, state_, trouble_.place_mm, *case_->remesh), "a step stopped: " + trouble_.cause};
  marked_force_ = results_.force();
  if (marks_.longest_mm.empty() || !remesh()) return false;
  save();
  return true;
}

void Run::give_up_mesh(const std::string& name, const std::string& why) {
  std::filesystem::remove(folder_ / name);
  command_.warn("at " + std::to_string(state_.time) + " s: " + why + "; the mesh stays as it is");
}

/// The same load on a finer mesh; the run goes on there if equilibrium is found.
std::optional<implicit::Found> Run::remesh() {
  constexpr int more_modest = 4;  // times that less is asked where a mesh would have too many nodes
  constexpr double modesty = 1.5;
  const auto most_nodes = static_cast<std::size_t>(case_->remesh->most_nodes);
  std::ostringstream name;
  name << "remesh/mesh_" << std::setw(2) << std::setfill('0') << meshes_.size() + 1 << ".vtu";
  auto origins = remeshed(*case_, state_, marks_.longest_mm, folder_, name.str());
  for (int attempt = 0; attempt < more_modest && origins.nodes.size() > most_nodes; ++attempt) {
    for (double& wish : marks_.longest_mm) wish *= modesty;
    origins = remeshed(*case_, state_, marks_.longest_mm, folder_, name.str());
  }
  if (origins.nodes.size() > most_nodes || origins.nodes.size() == case_->model.points.size()) {
    too_large_ = true;
    give_up_mesh(name.str(), "a finer mesh would have more than " + std::to_string(most_nodes) + " nodes ([remesh] most_nodes, finest_mm)");
    return {};
  }
  auto fresh = std::make_unique<Case>(case_on(settings_, folder_ / name.str(), *case_));
  auto equilibrium = std::make_unique<implicit::Equilibrium>(fresh->model, command_.threads());
  implicit::State state = implicit::carried(case_->model, state_, fresh->model, origins);
  const double before = implicit::volume(case_->model, state_), carried = implicit::volume(fresh->model, state), shape_before = least_shape(*case_, state_);
  auto found = equilibrium->find(state, state.time);
  if (!found) {
    ++failed_remeshings_;
    give_up_mesh(name.str(), "no equilibrium on a finer mesh: " + equilibrium->trouble().cause);
    return {};
  }
  case_ = std::move(fresh);
  equilibrium_ = std::move(equilibrium);
  state_ = std::move(state);
  results_.follow(*case_, equilibrium_->assembly());
  if (sensitivities_) {
    sensitivities_->use_mesh(folder_ / name.str(), *equilibrium_, &origins);
    sensitivities_->follow(state_);
  }
  meshes_.push_back(name.str());
  const Step step{0, state_, found->equations, found->iterations, 0};
  results_.remeshed({{"time_s", state_.time}, {"why", marks_.why}, {"nodes", case_->model.points.size()}, {"tets", case_->model.tets.size()},
                     {"force_N", {{"before", finite_or_null(marked_force_)}, {"after", driven(*case_, step).force}}},
                     {"volume_mm3", {{"before", before}, {"carried", carried}, {"after", implicit::volume(case_->model, state_)}}},
                     {"least_shape", {{"before", shape_before}, {"after", least_shape(*case_, state_)}}},
                     {"iterations", found->iterations}}, step);
  command_.say("remeshed at " + std::to_string(state_.time) + " s: " + std::to_string(case_->model.points.size()) + " nodes");
  return found;
}

void Run::go() {
  Progress progress = command_.progress("solve", case_->count);
  settle();
  const double end = case_->steps.times.back();
  for (;;) {
    time_ = implicit::run_steps(*equilibrium_, state_, case_->steps, pressing_, [&](const Step& step) {
      pressing_.pause = !suits(step);
      if (pressing_.pause) coarse_.emplace(Coarse{step.index, step.equations, step.iterations, step.cuts, step.drags});
      else report(step, progress);
    }, observe_);
    if (std::exchange(pressing_.pause, false)) {
      report_on_a_finer_mesh(progress);
      continue;
    }
    if (!(time_ < end)) break;
    trouble_ = equilibrium_->trouble();
    if (!mend()) break;
  }
  progress.finish();
  if (time_ < end) explain_stop();
}

Json Run::finish() {
  restart_->remove();
  const Json summary = results_.finish(time_);
  if (sensitivities_) {
    write_text(folder_ / "sensitivities.csv", sensitivities_->table());
    for (const auto& remark : sensitivities_->one_sided()) command_.warn(remark);
  }
  return summary;
}

}  // namespace palpate
