// What a run of the implicit scheme remembers between two steps, to an archive and back.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <solver/archive.hpp>
#include <solver/implicit/steps.hpp>

namespace palpate::contact {

inline void keep(Archive& a, Slip& x) { a(x.place, x.shear, x.place_before, x.shear_before); }
inline void keep(Archive& a, Point& x) { a(x.pressure, x.stiffness, x.normal, x.shear, x.cling, x.slides, x.beyond); }
inline void keep(Archive& a, PairPoint& x) { a(x.gap, x.pressure, x.stiffness, x.energy, x.mismatch, x.normal, x.gap_by_corners, x.residual, x.tangent); }
inline void keep(Archive& a, PairSlip& x) { a(x.face, x.weights, x.shear, x.way, x.beyond); }
inline void keep(Archive& a, Coulomb& x) { a(x.shear, x.by_trial, x.by_normal, x.by_pressure, x.slides, x.beyond); }
inline void keep(Archive& a, KnownCoulomb& x) { a(x.trial, x.normal, x.mu, x.pressure, x.answer); }

}  // namespace palpate::contact

namespace palpate::implicit {

inline void keep(Archive& a, State& x) {
  a(x.nodal, x.bubbles, x.contact_pressures, x.slips, x.pair_pressures, x.pair_slips, x.before, x.travels, x.memory, x.memory_time, x.time);
}
inline void keep(Archive& a, ToolSums& x) { a(x.force, x.area, x.moment, x.by_travel, x.by_angle, x.along_by_nodes, x.excess); }
inline void keep(Archive& a, OrganSums& x) { a(x.force, x.area); }
inline void keep(Archive& a, PairPlace& x) { a(x.at, x.nodes, x.point, x.rubs, x.law, x.after); }
inline void keep(Archive& a, ContactSums& x) { a(x.tools, x.penetration, x.mismatch, x.points, x.organs, x.pairs); }
inline void keep(Archive& a, Stride& x) { a(x.done, x.part, x.easy); }
inline void keep(Archive& a, Stored& x) { a(x.tissue, x.layers, x.grown_layers, x.springs, x.contact); }
inline void keep(Archive& a, Equations& x) { a(x.residual, x.tissue, x.internal_force, x.stored, x.contact, x.pressure_forces, x.fault, x.faulty_tet); }

}  // namespace palpate::implicit
