// Contact between faces: the tangent against differences of the residual, no net force or moment, and who is found to be inside whom.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <solver/contact/organ_contact.hpp>
#include <tests/verify/shapes.hpp>

using namespace palpate;
using namespace palpate::verify;
using contact::Triangle;

namespace {

constexpr double softness = 0.01, carried = 0.05;

/// A face looking up, another one looking down at a slant and a little below it.
struct Pair {
  Triangle tall{Vector3d(0, 0, 0), Vector3d(8, 0, 8), Vector3d(0, 8, 8)};  // of a thick body: decides how far back a line looks
  Triangle rest{Vector3d(0, 0, 0), Vector3d(1, 0.1, 0), Vector3d(0.2, 1.1, 0)};
  std::array<Vector3d, 6> corners{Vector3d(0.01, 0, 0.02), Vector3d(1.1, 0.1, 0), Vector3d(0.2, 1.1, 0.03),
                                  Vector3d(-1, -1, 0.001), Vector3d(0, 3, 0.011), Vector3d(3, -1, 0.031)};

  contact::PairPoint operator()(const std::array<Vector3d, 6>& at) const {
    const std::vector<Triangle> both = {{at[0], at[1], at[2]}, {at[3], at[4], at[5]}};
    const auto met = contact::meetings({{0}, {1}, false, 0}, {tall, tall}, both);
    for (const auto& meeting : met)
      if (meeting.q == 3) return contact::pair_point(meeting, rest, both[0], both[1], carried, softness);
    throw std::logic_error("the point meets nothing");
  }
};

}  // namespace

TEST(OrganContact, TangentIsTheDerivative) {
  Pair pair;
  const auto whole = pair(pair.corners);
  ASSERT_GT(whole.pressure, 0);
  ASSERT_LT(whole.pressure, carried + 2 * softness);
  Eigen::Matrix<double, 18, 18> numeric;
  const double h = 1e-6;
  for (int i = 0; i < 18; ++i) {
    auto plus = pair.corners, minus = pair.corners;
    plus[i / 3](i % 3) += h;
    minus[i / 3](i % 3) -= h;
    numeric.col(i) = (pair(plus).residual - pair(minus).residual) / (2 * h);
  }
  EXPECT_LE((numeric - whole.tangent).norm(), 1e-6 * whole.tangent.norm());
}

TEST(OrganContact, ForcesAndMomentsCancel) {
  const Pair pair;
  const auto point = pair(pair.corners);
  Vector3d force = Vector3d::Zero(), moment = Vector3d::Zero();
  double largest = 0;
  for (int a = 0; a < 6; ++a) {
    const Vector3d f = point.residual.segment<3>(3 * a);
    force += f;
    moment += pair.corners[a].cross(f);
    largest = std::max(largest, f.norm());
  }
  EXPECT_GT(largest, 0);
  EXPECT_LE(force.norm(), 1e-14 * largest);
  EXPECT_LE(moment.norm(), 1e-13 * largest);
}
