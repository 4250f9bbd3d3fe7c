// Rows, frames and summary of a solve.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/results.hpp>

#include <algorithm>
#include <charconv>
#include <iomanip>
#include <map>
#include <sstream>

#include <palpate/text_file.hpp>
#include <solver/implicit/keep.hpp>

namespace palpate {
namespace {

using Eigen::Vector3d;

double six_volumes(const Eigen::Matrix<double, 3, 4>& x) { return (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0)).dot(x.col(3) - x.col(0)); }

Json json(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// Twelve digits: below that lies the noise of another thread count.
std::string number(double x) {
  std::ostringstream out;
  out << std::setprecision(12) << (x == 0 ? 0.0 : x);
  return out.str();
}

Json numbers(const CatalogueEntry& entry, const std::vector<double>& values) {
  Json json = Json::object();
  for (std::size_t i = 0; i < values.size(); ++i) json[entry.parameters[i].name] = values[i];
  return json;
}

Json effect_facts(const GivenEffect& active) {
  const auto& entry = active.effect.entry;
  Json facts = {{"name", entry.name}};
  for (std::size_t i = 0; i < active.parameters.size(); ++i) facts[entry.parameters[i % entry.parameters.size()].name].push_back(active.parameters[i]);
  if (!active.region.empty()) facts["region"] = active.region;
  return facts;
}

Json tool_facts(const contact::Tool& tool, const Vector3d& aim) {
  Json facts = numbers(tool.shape.entry, tool.parameters);
  facts["kind"] = tool.shape.entry.name;
  facts["aim_mm"] = json(aim);
  facts["axis"] = json(tool.axis);
  facts["across"] = json(tool.frame().col(0));
  facts["first_contact_mm"] = json(tool.first_contact);
  if (tool.force_controlled) facts["force_N"] = tool.force;
  if (tool.turns()) facts["turn"] = {{"about", json(tool.spin)}, {"from_tip_mm", json(tool.pivot)}};
  return facts;
}

/// Forces on the organ at prescribed displacements, the residual there: of what is held, and of each patch that is moved.
std::map<int, Vector3d> reactions(const implicit::Model& model, const Eigen::VectorXd& residual) {
  std::map<int, Vector3d> sums;  // by amplitude
  for (const auto& p : model.prescribed)
    if (p.component < 3) sums.try_emplace(p.amplitude, Vector3d::Zero()).first->second(p.component) += residual(4 * p.node + p.component);
  return sums;
}

/// A tense capsule, or a pre-stress, loads an organ on which no force acts: then forces are compared with this part of the internal ones.
constexpr double of_internal_forces = 1e-3;

/// What is left when every force on the organ is added up, of the largest of them so far: when the tool has left, there is none.
double imbalance(const implicit::Model& model, const implicit::Assembly& assembly, const implicit::Step& step, double& largest) {
  Vector3d sum = assembly.loads(step.state);
  largest = std::max({largest, sum.norm(), of_internal_forces * step.equations.internal_force});
  const auto add = [&](const Vector3d& force) {
    sum += force;
    largest = std::max(largest, force.norm());
  };
  for (const auto& [amplitude, force] : reactions(model, step.equations.residual)) add(force);
  for (const auto& tool : step.equations.contact.tools) add(tool.force);
  return largest > 0 ? sum.norm() / largest : 0;
}

implicit::State beginning(const Case& c) {
  implicit::State state = implicit::rest_state(c.model);
  state.time = c.settling.times.empty() ? c.steps.times.front() : c.settling.times.front();
  return state;
}

Json energy_facts(const implicit::EnergyBalance& energy) {
  const auto& work = energy.works();
  const auto of = [&](implicit::Channel channel) { return work[static_cast<int>(channel)]; };
  const auto& stored = energy.stored();
  using enum implicit::Channel;
  Json facts = {{"work", {{"tools", of(tools)}, {"held", of(held)}, {"loads", of(loads)}, {"supports", of(supports)}, {"growth", of(growth)}}},
                {"stored", {{"layers", stored.layers}, {"springs", stored.springs}, {"contact", stored.contact}, {"elastic_slip", energy.in_slips()}}},
                {"lost", {{"friction", of(friction) - energy.in_slips()}, {"adhesion", of(adhesion)}, {"jumps", energy.lost_in_jumps()}}},
                {"remeshing", energy.by_remeshing()},
                {"imbalance", energy.imbalance()},
                {"quadrature_correction", energy.correction()}};
  if (energy.tissue_remembers()) facts["stored_or_lost"]["tissue"] = of(tissue);
  else facts["stored"]["tissue"] = stored.tissue;
  return facts;
}

}  // namespace

double patch_volume_change(const implicit::Model& model, const implicit::State& state) {
  std::vector<double> rest(model.points.size(), 0.0), now(model.points.size(), 0.0);
  for (const auto& tet : model.tets) {
    const Eigen::Matrix<double, 3, 4> X = implicit::corners(model, tet);
    Eigen::Matrix<double, 3, 4> x = X;
    for (int a = 0; a < 4; ++a) x.col(a) += state.displacement(tet[a]);
    for (int node : tet) {
      rest[node] += six_volumes(X);
      now[node] += six_volumes(x);
    }
  }
  std::vector<double> changes;
  for (std::size_t i = 0; i < rest.size(); ++i)
    if (rest[i] > 0) changes.push_back(std::abs(now[i] / rest[i] - 1));
  if (changes.empty()) return 0;
  const auto at = changes.begin() + (changes.size() * 99 + 99) / 100 - 1;
  std::nth_element(changes.begin(), at, changes.end());
  return *at;
}

Eigen::Vector3d driven_direction(const Case& c) {
  if (!c.model.tools.empty()) return c.model.tools.front().axis;
  return c.moved.empty() ? Vector3d::Zero() : c.moved.front().motion_mm.normalized();  // of zero: zero
}

Driven driven(const Case& c, const implicit::Step& step) {
  Driven d;
  const bool at_rest = step.equations.residual.size() == 0;
  if (!c.model.tools.empty()) {
    d.depth = implicit::pose(c.model, step.state, 0).travel;
    if (at_rest) return d;
    const auto& sums = step.equations.contact.tools.front();
    d.vector = sums.force;
    d.force = sums.force.dot(driven_direction(c));
    d.area = sums.area;
  } else if (!c.moved.empty()) {
    const auto& moved = c.moved.front();
    d.depth = moved.motion_mm.norm() * c.model.amplitudes[moved.amplitude].at(step.state.time);
    if (at_rest) return d;
    for (int node : moved.nodes) d.vector += step.equations.residual.segment<3>(4 * node);
    d.force = d.vector.dot(driven_direction(c));
  }
  return d;
}

ResultFolder::ResultFolder(std::filesystem::path folder, const Case& the_case, const implicit::Assembly& assembly)
    : folder_(std::move(folder)), case_(&the_case), assembly_(&assembly), energy_(assembly, beginning(the_case)) {
  history_ = "t[s],depth[mm],Fx[N],Fy[N],Fz[N],F[N],contact_area[mm2],iterations";
  for (std::size_t i = 2; i <= case_->model.tools.size(); ++i)
    for (const char* column : {"Fx", "Fy", "Fz"}) history_ += "," + std::string(column) + std::to_string(i) + "[N]";
  history_ += "\n";
}

void ResultFolder::make_folders() const { std::filesystem::create_directory(folder_ / "frames"); }

void ResultFolder::keep(Archive& archive) {
  archive(history_, frames_, files_, frame_count_, iterations_, cuts_, drags_, steps_, peak_force_, contact_area_, force_, depth_, organs_, largest_force_, worst_imbalance_,
          worst_penetration_, smallest_J_, patch_change_, energy_, remeshings_);
}

void ResultFolder::follow(const Case& the_case, const implicit::Assembly& assembly) {
  case_ = &the_case;
  assembly_ = &assembly;
}

void ResultFolder::remeshed(Json facts, const implicit::Step& step) {
  facts["energy_N_mm"] = energy_.remeshed(*assembly_, step.state, step.equations);
  remeshings_.push_back(facts.dump());
  iterations_ += step.iterations;
  worst_imbalance_ = std::max(worst_imbalance_, imbalance(case_->model, *assembly_, step, largest_force_));
  worst_penetration_ = std::max(worst_penetration_, step.equations.contact.penetration);
  organs_ = step.equations.contact.organs;
}

void ResultFolder::accepted(const implicit::Accepted& found) { energy_.add(*assembly_, found); }

void ResultFolder::settled(const implicit::Step& step) {
  iterations_ += step.iterations;
  cuts_ += step.cuts;
  drags_ += step.drags;
  if (step.equations.residual.size() > 0) worst_imbalance_ = std::max(worst_imbalance_, imbalance(case_->model, *assembly_, step, largest_force_));
}

void ResultFolder::add(const implicit::Step& step, bool last) {
  settled(step);
  const auto& contact = step.equations.contact;
  const Driven d = driven(*case_, step);
  force_ = d.force;
  contact_area_ = d.area;
  depth_ = d.depth;
  peak_force_ = std::max(peak_force_, force_);
  steps_ = step.index;
  patch_change_ = patch_volume_change(case_->model, step.state);
  organs_ = contact.organs;
  worst_penetration_ = std::max(worst_penetration_, contact.penetration);
  for (double value : {step.state.time, d.depth, d.vector.x(), d.vector.y(), d.vector.z(), d.force, d.area}) history_ += number(value) + ",";
  history_ += std::to_string(step.iterations);
  for (std::size_t i = 1; i < case_->model.tools.size(); ++i)
    for (int k = 0; k < 3; ++k) history_ += "," + number(i < contact.tools.size() ? contact.tools[i].force(k) : 0);
  history_ += "\n";
  const int every = std::max(1, case_->count / case_->frames);
  if (step.index % every == 0 || last) write_frame(step);
}

void ResultFolder::write_frame(const implicit::Step& step) {
  Field displacement{"displacement", 3, {}}, pressure{"pressure", 1, {}}, von_mises{"von_mises", 1, {}}, J{"J", 1, {}};
  for (int node = 0; node < static_cast<int>(case_->model.points.size()); ++node) {
    const Vector3d u = step.state.displacement(node);
    displacement.values.insert(displacement.values.end(), {u.x(), u.y(), u.z()});
    pressure.values.push_back(-step.state.pressure(node));  // compression is positive for people
  }
  for (const auto& result : assembly_->results(step.state)) {
    von_mises.values.push_back(result.von_mises);
    J.values.push_back(result.J);
    if (!(result.J >= smallest_J_)) smallest_J_ = result.J;
  }
  std::ostringstream name;
  name << "frames/frame_" << std::setw(4) << std::setfill('0') << frame_count_++ << ".vtu";
  write_mesh(folder_ / name.str(), rest_mesh(*case_), {displacement, pressure}, {von_mises, J});
  files_.push_back(name.str());
  frames_ += "    <DataSet timestep=\"" + number(step.state.time) + "\" part=\"0\" file=\"" + name.str() + "\"/>\n";
}

Json ResultFolder::finish(double time_reached) {
  write_text(folder_ / "history.csv", history_);
  write_text(folder_ / "frames.pvd", "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n  <Collection>\n" +
                                         frames_ + "  </Collection>\n</VTKFile>\n");
  const auto& model = case_->model;
  const auto& material = model.materials.front();
  Json summary = {{"schema", "palpate-summary/1"},
                  {"law", material.law.entry.name},
                  {"parameters", numbers(material.law.entry, material.parameters)},
                  {"initial_shear_modulus_MPa", material.shear_modulus()},
                  {"bulk_modulus_MPa", finite_or_null(material.bulk_modulus)},
                  {"volume_stiffening_MPa", material.volume_stiffening},
                  {"time_s", {{"asked", case_->steps.times.back()}, {"reached", time_reached}}},
                  {"peak_force_N", peak_force_},
                  {"final_force_N", force_},
                  {"final_contact_area_mm2", contact_area_},
                  {"nodes", model.points.size()},
                  {"tets", model.tets.size()},
                  {"base_nodes", case_->base.size()},
                  {"steps", steps_},
                  {"cuts", cuts_},
                  {"found_by_drag", drags_},
                  {"iterations", iterations_},
                  {"smallest_J", smallest_J_},
                  {"final_volume_change_of_patches_p99", patch_change_},
                  {"worst_penetration_of_element_size", worst_penetration_},
                  {"worst_force_imbalance", worst_imbalance_},
                  {"worst_energy_imbalance", energy_.worst_imbalance()},
                  {"energy_N_mm", energy_facts(energy_)}};
  for (const auto& more : model.materials)
    if (model.materials.size() > 1) summary["materials"].push_back({{"law", more.law.entry.name}, {"parameters", numbers(more.law.entry, more.parameters)}});
  for (std::size_t i = 0; i < case_->contacts.size(); ++i) {
    const auto sums = i < organs_.size() ? organs_[i] : implicit::OrganSums{};
    Json facts = {{case_->contacts[i].size() == 2 ? "between" : "self", case_->contacts[i]}, {"contact_area_mm2", sums.area}};
    if (case_->contacts[i].size() == 2) facts["force_on_first_N"] = json(sums.force);
    summary["contacts"].push_back(facts);
  }
  for (const auto& e : case_->effects) summary["effects"].push_back(effect_facts(e));
  for (const auto& facts : remeshings_) summary["remeshings"].push_back(Json::parse(facts));
  Json shapes = Json::array();
  for (std::size_t i = 0; i < model.tools.size(); ++i) shapes.push_back(tool_facts(model.tools[i], case_->aims_mm[i]));
  if (!shapes.empty()) {
    summary["tool"] = shapes[0];
    summary["depth_mm"] = {{"asked", model.tools[0].force_controlled ? Json(nullptr) : Json(model.tools[0].depth)}, {"reached", depth_}};
  }
  if (shapes.size() > 1) summary["tools"] = shapes;
  write_json(folder_ / "summary.json", summary);
  return summary;
}

}  // namespace palpate
