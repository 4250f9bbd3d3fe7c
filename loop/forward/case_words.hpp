// A case of palpate-solve as text: what is taken out of it, and effects in its own frame.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include <loop/set/set.hpp>

namespace palpate::loop {

/// A case of several materials is solved as it is: a law of the loop stands for all of them.
bool has_one_material(const std::filesystem::path& case_file);

/// False where each depth of the tool has its one force, whatever came before: nothing in the case moves, rubs, sticks, relaxes or softens.
bool remembers(const std::filesystem::path& case_file);

/// The mesh that a case names.
std::filesystem::path mesh_of_case(const std::filesystem::path& case_file);

/// A case's text without these tables, which are written anew.
std::string case_without(const std::string& text, const std::vector<std::string>& tables);

/// The effect `thickness`, from the plane that holds the organ along its normal. Throws Failure(refused) when no plane holds it.
std::string thickness_words(const std::filesystem::path& case_file, double excess);

/// Hertz' representative strain 0.2 a/R at this depth, at which the solver's strains are said.
double representative_strain_at(double deepest_mm, double radius_mm);

/// An effect that remembers or holds on to the tool, of this amplitude and shape in the loop's catalogue: strains there are relative to the deepest point, of which `strain` is the
/// representative one. Empty: the solver has nothing that means the same.
std::string memory_words(const std::string& effect, double amplitude, const std::vector<double>& shape, double mu, double strain);

/// Length along the axis from `point` to the first point of the mesh within `around_mm` of the axis. Throws Failure(refused) when there is none.
double surface_along(const std::filesystem::path& mesh, const Vec3& point, const Vec3& axis, double around_mm);

/// The effect `inclusion`: a ball whose middle lies `depth_mm` under the surface, half as large.
std::string inclusion_words(const Vec3& surface, const Vec3& axis, double depth_mm, double excess);

}  // namespace palpate::loop
