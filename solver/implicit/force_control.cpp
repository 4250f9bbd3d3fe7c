// Tools that are controlled by force: [K b; c d][Δu; Δs] = −[r; excess], by elimination of the nodes with the factored K.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/implicit/equilibrium.hpp>

#include <algorithm>
#include <cmath>

namespace palpate::implicit {
namespace {

/// A tool that touches nothing has no stiffness to go by: it advances by this part of an element until it does; and by no step more than that.
constexpr double seeking = 0.25, longest = 0.5;
/// Stiffness, of a shear modulus times an element's size, below which nothing is touched.
constexpr double nothing = 1e-9;

double along(const Eigen::VectorXd& nodal, const Eigen::Vector3d& axis) {
  double sum = 0;
  for (int i = 0; i < nodal.size(); i += 4) sum += nodal.segment<3>(i).dot(axis);
  return sum;
}

}  // namespace

/// `step` comes with the nodes' answer to −r alone. False where the tangent is singular.
bool Equilibrium::add_travels(const ContactSums& contact, const std::vector<double>& excess, const LinearGoal& to, Increment& step) {
  std::vector<int> tools;
  for (std::size_t i = 0; i < model_.tools.size(); ++i)
    if (model_.tools[i].force_controlled) tools.push_back(static_cast<int>(i));
  const int count = static_cast<int>(tools.size());
  std::vector<Eigen::VectorXd> answers;  // of the nodes to a unit of each travel
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(count, count);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
  for (int j = 0; j < count; ++j) {
    Eigen::VectorXd answer = -contact.tools[tools[j]].by_travel;
    for (int i = 0; i < answer.size(); ++i)
      if (fixed_[i]) answer(i) = 0;
    if (!solve_linear(to, answer)) return false;
    answers.push_back(std::move(answer));
  }
  for (int i = 0; i < count; ++i) {
    const auto& sums = contact.tools[tools[i]];
    for (int j = 0; j < count; ++j) stiffness(i, j) = sums.along_by_nodes.dot(answers[j]);
    stiffness(i, i) -= along(sums.by_travel, model_.tools[tools[i]].axis);  // the tool moved, the nodes held
    right(i) = -excess[tools[i]] - sums.along_by_nodes.dot(step.nodal);
  }
  for (int i = 0; i < count; ++i) {
    if (std::abs(stiffness(i, i)) > nothing * force_floor_ / 1e-4 / element_size_) continue;
    stiffness.row(i).setZero();
    stiffness.col(i).setZero();
    stiffness(i, i) = 1;
    right(i) = excess[tools[i]] < 0 ? seeking * element_size_ : 0;
  }
  const Eigen::VectorXd travels = stiffness.partialPivLu().solve(right);
  for (int j = 0; j < count; ++j) {
    step.travels[tools[j]] = std::clamp(travels(j), -longest * element_size_, longest * element_size_);
    step.nodal += step.travels[tools[j]] * answers[j];
  }
  return true;
}

}  // namespace palpate::implicit
