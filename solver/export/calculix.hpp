// A case as input of CalculiX (Abaqus' syntax): quadratic tetrahedra, hyperelastic laws, held and moved nodes, one static step.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include <solver/case.hpp>

namespace palpate::calculix {

/// Throws Failure(refused), naming the key and its line, for what the file cannot say: tools, forces, springs, gravity, other laws.
/// `file`: the case's, as the user wrote it.
void refuse_what_cannot_be_said(const std::filesystem::path& file, const Case& c);

/// The whole .inp. Tetrahedra get nodes in the middle of their straight edges; such a node is held or moved when both ends are, in
/// the same way. An incompressible law gets the bulk modulus `bulk_ratio` · initial shear modulus: CalculiX has no pressure unknown.
/// Node sets BASE, MOVED1, MOVED2, … (in the order of [[displacement]]); the total force on each is printed at every increment.
std::string input(const Case& c, double bulk_ratio);

}  // namespace palpate::calculix
