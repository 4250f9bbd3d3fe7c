// palpate-export: a case in the words of another solver.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <palpate/command.hpp>
#include <palpate/text_file.hpp>
#include <solver/export/calculix.hpp>

#include <algorithm>
#include <cmath>

using namespace palpate;

void usage(Usage& u) {
  u.name = "export";
  u.sentence = "Writes a case as input of another solver: CalculiX (.inp, Abaqus' syntax), for a second opinion.";
  u.details =
      "Tetrahedra become quadratic ones (C3D10) with straight edges; [base], [[displacement]] and [[symmetry]] also take the nodes in the middle\n"
      "of edges whose ends both belong, so that a patch is as rigid as in palpate-solve. Run it with `ccx -i model`: model.dat then holds the total\n"
      "force on the node sets MOVED1, MOVED2, … and BASE at every increment. Laws: neo_hookean, mooney_rivlin, yeoh, ogden; a volume energy\n"
      "given by kappa or D1 is the same in both. Tools, forces, springs and gravity are refused (exit code 6).";
  u.input("case", "case.toml", "the case: mesh, [material], [base], [[displacement]], [[symmetry]], [steps]");
  u.output("model", "model.inp", "input of CalculiX");
  u.file("mesh", "the mesh to use instead of the one the case names");
  u.real("bulk-ratio", 1000, "1", {10, 1e6},
         "bulk modulus over initial shear modulus where the law is incompressible: CalculiX has no pressure unknown. Less is softer "
         "by compressibility, more locks elements and asks for more iterations");
}

void run(Command& c) {
  const Case the_case = read_case(c.input("case"), c.has("mesh") ? c.file("mesh") : "");
  if (!c.has("mesh")) c.add_input("mesh", the_case.mesh_path);
  if (c.final_output("model").extension() != ".inp")
    throw Failure(ExitCode::misuse, "the format follows from the name, and this one is unknown", c.final_output("model").string(), "model.inp");
  calculix::refuse_what_cannot_be_said(c.input("case"), the_case);
  const auto& materials = the_case.model.materials;
  if (std::any_of(materials.begin(), materials.end(), [](const auto& m) { return !std::isfinite(m.bulk_modulus); }))
    c.warn("incompressible in the case, nearly so in the file: kappa is --bulk-ratio times the initial shear modulus");
  write_text(c.output("model"), calculix::input(the_case, c.real("bulk-ratio")));
}
