// Text of the case. Strains of the loop are relative to the deepest point; the solver's are those of Hertz' representative strain 0.2 a/R there.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/report/case_file.hpp>

#include <cmath>
#include <sstream>

#include <palpate/text_file.hpp>
#include <loop/forward/case_words.hpp>
#include <loop/forward/departures.hpp>

namespace palpate::loop {
namespace {

struct Parts {
  std::ostringstream law, bulk, effects, comments;
  bool on_bed = false;  ///< the base is held by springs
};

/// A law that a stiffening turns the null into, where the solver has it.
bool write_stiffened(const Model& model, const Active& a, Parts& parts) {
  const double mu = model.law->shear_modulus(model.parameters), e = a.amplitude;
  const int kind = static_cast<int>(a.shape[0]);
  if (model.law->name != "neo_hookean" || (kind == 0 && !(e > 0))) return false;
  parts.law << stiffened_material(mu, kind, e);
  return true;
}

/// The inclusion lies under the place of a run, whose axis leads to it.
std::string inclusion_at(const Session& s, const Active& a) {
  const Vec3 point{a.shape[0], a.shape[1], a.shape[2]};
  for (const Run& run : s.set->runs)
    if (norm(run.point_mm - point) < 0.5) {
      const double R = s.set->tools.at(run.tool).radius_mm, surface = surface_along(mesh_of_case(s.set->specimen.case_file), run.point_mm, run.axis, R);
      return inclusion_words(run.point_mm + (surface / norm(run.axis)) * run.axis, run.axis, a.shape[3], a.amplitude);
    }
  return "";
}

/// One effect as a table or as a key of material or tool; false: the solver has nothing that means the same. `strain` is the representative one at the deepest point.
bool write_effect(const Session& s, const Model& model, const Active& a, double strain, Parts& parts) {
  const std::string& name = a.effect->entry.name;
  const double mu = model.law->shear_modulus(model.parameters), e = a.amplitude;
  if (name == "stiffening") return write_stiffened(model, a, parts);
  if (const std::string words = memory_words(name, e, a.shape, mu, strain); !words.empty()) {
    parts.effects << words;
  } else if (name == "capsule") {
    parts.effects << "[[effect]]\nname = \"capsule\"\nE_h = " << e << "\n";
  } else if (name == "thickness" && s.set->specimen.case_file.empty()) {  // a case does not say where its base is
    parts.effects << "[[effect]]\nname = \"thickness\"\nexcess = " << e << "\naxis_x = 0\naxis_y = 0\naxis_z = 1\n";
  } else if (name == "thickness") {
    parts.effects << thickness_words(s.set->specimen.case_file, e);
  } else if (name == "support" && a.shape[0] > 0 && e > 0) {
    Tissue bed;
    a.effect->tissue(e, a.shape, bed);
    parts.effects << "[[effect]]\nname = \"support\"\nlabel = \"base\"\nstiffness = " << 1 / bed.bed_mm_per_MPa << "\ntangential = 1\nfriction = 1e6\n";
    parts.on_bed = true;
  } else if (name == "prestress" && a.shape[0] > 0) {
    parts.effects << "[[effect]]\nname = \"prestress\"\np_kPa = " << 1e3 * e << "\n";
  } else if (name == "inclusion" && !s.set->specimen.case_file.empty()) {
    parts.effects << inclusion_at(s, a);
  } else if (name == "compressibility" && e > 0) {
    parts.bulk << "kappa = " << 2 * mu * (1.5 - e) / (3 * 2 * e) << "\n";
  } else {
    return false;
  }
  return true;
}

void write_comment(const Active& a, Parts& parts) {
  parts.comments << "# not in this case: " << a.effect->entry.name;
  for (std::size_t i = 0; i < a.effect->entry.parameters.size(); ++i)
    parts.comments << (i ? ", " : " with ") << a.effect->entry.parameters[i].name << " = " << (i ? a.shape[i - 1] : a.amplitude) << " " << a.effect->entry.parameters[i].unit;
  parts.comments << " (" << a.effect->entry.kind << ")\n";
}

}  // namespace

bool in_case(const Session& s, const Model& model, const Active& a) {
  Parts parts;
  return write_effect(s, model, a, 0.1, parts);
}

std::string case_text(const Session& s, const Model& model, const Run& run, const std::string& motion) {
  const Specimen& specimen = s.set->specimen;
  const Tool& tool = s.set->tools.at(run.tool);
  const double strain = representative_strain_at(s.depth_scale_mm, s.set->tools.at(run.tool).radius_mm);
  Parts parts;
  for (std::ostringstream* out : {&parts.law, &parts.bulk, &parts.effects, &parts.comments}) out->precision(8);
  bool law_written = false;
  for (const Active& a : model.active) {
    const bool is_law = a.effect->entry.name == "stiffening";
    if ((is_law && law_written) || !write_effect(s, model, a, strain, parts))
      write_comment(a, parts);
    else
      law_written = law_written || is_law;
  }
  if (!law_written) {
    Tissue plain;
    plain.law = model.law;
    plain.parameters = model.parameters;
    parts.law << material_text(plain);
  }
  std::ostringstream out;
  out.precision(8);
  out << parts.comments.str();
  if (specimen.case_file.empty())
    out << "schema = \"palpate-case/1\"\nmesh = \"mesh.vtu\"\n" << (parts.on_bed ? "" : "[base]\nlabel = \"base\"\n");
  else
    out << case_without(read_text(specimen.case_file), {"material", "tool", "steps"});
  out << parts.law.str() << parts.bulk.str() << parts.effects.str() << "[tool]\nkind = \"" << tool.kind << "\"\nradius_mm = " << tool.radius_mm << "\naim_mm = ["
      << run.point_mm[0] << ", " << run.point_mm[1] << ", " << run.point_mm[2] << "]\naxis = [" << run.axis[0] << ", " << run.axis[1] << ", " << run.axis[2]
      << "]\n" << motion;
  return out.str();
}

std::string case_file(const Session& s, const Model& model) {
  if (s.set->specimen.shape == "tube") return "";
  for (std::size_t r : s.problem.runs) {
    const Run& run = s.set->runs[r];
    if (run.role != Role::fit || run.test != Test::indentation) continue;
    const double measured = run.timed ? loading_rate(run) : 0, speed = run.rate_mm_s > 0 ? run.rate_mm_s : measured > 0 ? measured : 1;
    std::ostringstream motion;
    motion << "depth_mm = " << *std::max_element(run.u.begin(), run.u.end()) << "\nspeed_mm_s = " << speed << "\n[steps]\ncount = 20\n";
    return "# Written by palpate-loop: the set's specimen with what the loop found.\n" + case_text(s, model, run, motion.str());
  }
  return "";
}

}  // namespace palpate::loop
