// Reading [[effect]] for a thin wall: the names and keys of the implicit scheme, at work on shells.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <solver/explicit/case.hpp>

namespace palpate::explicit_shell {

/// An effect as the file gives it.
struct GivenEffect {
  Settings table;
  effects::Active active;
};
std::vector<GivenEffect> given_effects(const Settings& settings);

/// What thickens the wall, on the mesh before a wall is made of it. Throws Failure(misuse).
void thicken(const std::vector<GivenEffect>& given, ShellMesh& mesh);

/// The others into tissue, beds and tractions of the clamp. c.wall and c.tissue.material's law are there. Throws Failure(misuse), also for
/// what shells cannot carry: a law whose volume changes, an effect that would need much shorter steps.
void add_effects(const std::vector<GivenEffect>& given, Case& c);

}  // namespace palpate::explicit_shell
