// Curves of a clamped tube from palpate-idealize, palpate-mesh and palpate-solve (scheme "explicit"), as processes; each solve is kept by its content.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>

#include <loop/forward/clamp.hpp>

namespace palpate::loop {

/// True when the set's runs are closings of a clamp.
bool is_clamp(const Set& set);

/// Per site: the wall as declared on a mesh and on two others, which tell what the mesh does; and on the coarser one friction, an angle between the jaws,
/// slices of the tube thicker and thinner, the law's further parameters, each at two amplitudes. Solves that the folder `kept` holds (same
/// case, mesh and solver) are not run again. Throws Failure(refused) without the programs, Failure(not_converged) with the solver's words.
ClampCurves clamp_curves(const Set& set, const std::filesystem::path& kept, int threads, const std::function<void(const std::string&)>& remark);

}  // namespace palpate::loop
