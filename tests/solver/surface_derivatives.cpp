// Sensitivities of a run whose tool is a closed triangle surface, a block grown so that its edges are round, against central differences of whole runs
// over the same steps: place, both components of its tilt, and the radius of its edges.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <tests/verify/block_surface.hpp>
#include <tests/verify/case_runs.hpp>

using namespace palpate;

namespace {

using AClosedSurface = verify::CaseRuns;

}  // namespace

/// To 5e-5 of the largest, over the first 0.28 mm: further on steps are cut.
TEST_F(AClosedSurface, HasTheDerivativesOfWholeRuns) {
  write_surface(folder / "core.vtp", verify::block_surface({-1.4, -1.0, 0}, {1.4, 1.0, 3}));
  write(R"([material]
law = "neo_hookean"
mu = 0.0067
[base]
plane = { point_mm = [0.0, 0.0, 0.01], normal = [0.0, 0.0, 1.0] }
[tool]
kind = "surface"
file = "core.vtp"
edge_radius_mm = 0.6
aim_mm = [0.3, 0.2, 5.0]
axis = [0.15, 0.1, -1.0]
across = [1.0, 0.3, 0.0]
depth_mm = 0.8
[steps]
times_s = [0.015, 0.03, 0.05, 0.08, 0.12, 0.16, 0.2, 0.24, 0.28]
)");
  expect_derivatives({"material.mu", "tool.aim_mm[0]", "tool.axis[0]", "tool.axis[1]", "tool.edge_radius_mm"});
}
