// A finer mesh of a deformed organ by palpate-remesh, as a mesh of the same rest shape.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>

#include <solver/case.hpp>
#include <solver/implicit/carry.hpp>

namespace palpate {

/// Writes the deformed organ with its marks into `folder`, calls palpate-remesh, and writes what comes back as `name`: places at rest, with where nodes
/// and cells come from. Throws Failure(defect) when palpate-remesh fails.
implicit::Origins remeshed(const Case& c, const implicit::State& state, const std::vector<double>& marks, const std::filesystem::path& folder,
                           const std::string& name);

/// The settings' case on another mesh of the same rest shape; its tools are where those of `before` are, its rules of remeshing the same.
Case case_on(const Settings& settings, const std::filesystem::path& mesh, const Case& before);

}  // namespace palpate
