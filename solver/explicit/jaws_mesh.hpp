// The jaws as a person sees them and another code takes them: hexahedra with their mass.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <string>
#include <vector>

namespace palpate::explicit_shell {

/// A .vtu of blocks, `corners` of each as Jaws::corners() gives them (mm), cut into hexahedra no longer than `edge` (mm); on cells `region` (1: upper, 2: lower) and
/// `mass` (tonne), which adds up to `mass` a block.
std::string blocks_as_vtu(const std::vector<Eigen::Vector3d>& corners, double edge, double mass);

}  // namespace palpate::explicit_shell
