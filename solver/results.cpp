// Rows, frames and summary of a solve.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/results.hpp>

#include <algorithm>
#include <charconv>
#include <iomanip>
#include <sstream>

#include <palpate/text_file.hpp>

namespace palpate {
namespace {

using Eigen::Vector3d;

Json json(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// Twelve digits: below that lies the noise of another thread count.
std::string number(double x) {
  std::ostringstream out;
  out << std::setprecision(12) << (x == 0 ? 0.0 : x);
  return out.str();
}

/// Force of the base on the organ: the residual of the held unknowns. With the tool's force it must vanish.
Vector3d base_reaction(const implicit::Model& model, const Eigen::VectorXd& residual) {
  Vector3d sum = Vector3d::Zero();
  for (const auto& p : model.prescribed) sum(p.component) += residual(4 * p.node + p.component);
  return sum;
}

}  // namespace

ResultFolder::ResultFolder(std::filesystem::path folder, const Case& the_case, const implicit::Assembly& assembly)
    : folder_(std::move(folder)), case_(the_case), assembly_(assembly) {
  std::filesystem::create_directory(folder_ / "frames");
  history_ = "t[s],depth[mm],Fx[N],Fy[N],Fz[N],F[N],contact_area[mm2],iterations\n";
}

void ResultFolder::add(const implicit::Step& step, bool last) {
  const auto& tool = *case_.model.tool;
  const auto& contact = step.equations.contact;
  const double depth = step.state.load * tool.depth;
  force_ = contact.force.dot(tool.axis);
  contact_area_ = contact.area;
  peak_force_ = std::max(peak_force_, force_);
  iterations_ += step.iterations;
  cuts_ += step.cuts;
  steps_ = step.index;
  worst_penetration_ = std::max(worst_penetration_, contact.penetration);
  if (step.equations.residual.size() > 0 && force_ > 0)
    worst_imbalance_ = std::max(worst_imbalance_, (base_reaction(case_.model, step.equations.residual) + contact.force).norm() / contact.force.norm());
  for (double value : {depth / case_.speed_mm_s, depth, contact.force.x(), contact.force.y(), contact.force.z(), force_, contact.area})
    history_ += number(value) + ",";
  history_ += std::to_string(step.iterations) + "\n";
  const int every = std::max(1, case_.steps.count / case_.frames);
  if (step.index % every == 0 || last) write_frame(step);
}

void ResultFolder::write_frame(const implicit::Step& step) {
  Field displacement{"displacement", 3, {}}, pressure{"pressure", 1, {}}, von_mises{"von_mises", 1, {}}, J{"J", 1, {}};
  for (int node = 0; node < static_cast<int>(case_.model.points.size()); ++node) {
    const Vector3d u = step.state.displacement(node);
    displacement.values.insert(displacement.values.end(), {u.x(), u.y(), u.z()});
    pressure.values.push_back(-step.state.pressure(node));  // compression is positive for people
  }
  for (const auto& result : assembly_.results(step.state)) {
    von_mises.values.push_back(result.von_mises);
    J.values.push_back(result.J);
    if (!(result.J >= smallest_J_)) smallest_J_ = result.J;
  }
  std::ostringstream name;
  name << "frames/frame_" << std::setw(4) << std::setfill('0') << frame_count_++ << ".vtu";
  write_mesh(folder_ / name.str(), case_.mesh, {displacement, pressure}, {von_mises, J});
  const double time = step.state.load * case_.model.tool->depth / case_.speed_mm_s;
  frames_ += "    <DataSet timestep=\"" + number(time) + "\" part=\"0\" file=\"" + name.str() + "\"/>\n";
}

Json ResultFolder::finish(double load_reached) {
  write_text(folder_ / "history.csv", history_);
  write_text(folder_ / "frames.pvd", "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n  <Collection>\n" +
                                         frames_ + "  </Collection>\n</VTKFile>\n");
  const auto& material = case_.model.materials.front();
  const auto& tool = *case_.model.tool;
  Json parameters = Json::object(), shape = {{"kind", tool.shape.entry.name}};
  for (std::size_t i = 0; i < material.parameters.size(); ++i) parameters[material.law.entry.parameters[i].name] = material.parameters[i];
  for (std::size_t i = 0; i < tool.parameters.size(); ++i) shape[tool.shape.entry.parameters[i].name] = tool.parameters[i];
  shape["aim_mm"] = json(case_.aim_mm);
  shape["axis"] = json(tool.axis);
  shape["first_contact_mm"] = json(tool.first_contact);
  const Json summary = {{"schema", "palpate-summary/1"},
                        {"law", material.law.entry.name},
                        {"parameters", parameters},
                        {"initial_shear_modulus_MPa", material.shear_modulus()},
                        {"bulk_modulus_MPa", finite_or_null(material.bulk_modulus)},
                        {"volume_stiffening_MPa", material.volume_stiffening},
                        {"tool", shape},
                        {"depth_mm", {{"asked", tool.depth}, {"reached", load_reached * tool.depth}}},
                        {"peak_force_N", peak_force_},
                        {"final_force_N", force_},
                        {"final_contact_area_mm2", contact_area_},
                        {"nodes", case_.model.points.size()},
                        {"tets", case_.model.tets.size()},
                        {"base_nodes", case_.base_nodes},
                        {"steps", steps_},
                        {"cuts", cuts_},
                        {"iterations", iterations_},
                        {"smallest_J", smallest_J_},
                        {"worst_penetration_of_element_size", worst_penetration_},
                        {"worst_force_imbalance", worst_imbalance_}};
  write_json(folder_ / "summary.json", summary);
  return summary;
}

}  // namespace palpate
