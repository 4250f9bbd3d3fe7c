// Coulomb's friction between deformable faces: a point x holds on to a material point of the other surface, its anchor z, by an elastic slip,
// v = −ε (x − z), and the return to the cone of contact/coulomb.hpp. The shear acts on x, and with the other sign where x's line ends.
// (Wriggers 2006, Computational Contact Mechanics, section 5.2.2; decision 039.)
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <solver/contact/coulomb.hpp>
#include <solver/contact/organ_contact.hpp>

namespace palpate::contact {

/// What friction remembers of a point of contact between organs when the last step was found.
struct PairSlip {
  int face = -1;                    ///< that the anchor is in the plane of; −1: it did not press
  std::array<double, 3> weights{};  ///< of its corners; a little beyond the face where elastic slip asks for it
  Eigen::Vector3d shear = Eigen::Vector3d::Zero();  ///< of the other organ on the own face, MPa: what the anchor will ask for again
  Eigen::Vector3d way = Eigen::Vector3d::Zero();    ///< that the point has slipped so far, mm, for the balance of energy
  Eigen::Vector3d beyond = Eigen::Vector3d::Zero();  ///< elastic slip that the bound took in the last step, mm: tells a finer mesh which way it slid
};

/// Stiffness of elastic slip, MPa/mm: that of contact at no pressure.
double slip_stiffness(const Triangle& own_rest, double softness);

/// The anchor that asks for `shear` of a point whose line ends as `meeting` says.
PairSlip anchored(const Meeting& meeting, const Triangle& own, const Triangle& other, const Eigen::Vector3d& shear, double stiffness);

/// Unknowns: corners of the own face, of the other, of the anchor's.
struct PairShear {
  PairSlip after;  ///< remembered if the step is accepted
  KnownCoulomb law;
  Eigen::Matrix<double, 18, 1> residual = Eigen::Matrix<double, 18, 1>::Zero();
  Eigen::Matrix<double, 18, 27> tangent = Eigen::Matrix<double, 18, 27>::Zero();
};

/// What a point holds on to: its anchor, whose face has these corners now; or, when it did not press, what it meets now: it slips by what both have
/// moved against each other since the last step was found, when their corners were at `own` and `other`.
struct Hold {
  PairSlip before;
  Triangle anchor, own, other;
};

/// `point`: of the same meeting, with pressure; `mu`: see Pass::friction; `beside`: what the law answers in a run close to this one, if so.
PairShear pair_shear(const Meeting& meeting, const PairPoint& point, const Triangle& own_rest, const Triangle& own, const Triangle& other,
                     const Hold& hold, double mu, double softness, const KnownCoulomb* beside = nullptr);

}  // namespace palpate::contact
