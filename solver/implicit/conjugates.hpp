// Forces and the places they move, channel by channel: work is ∫ force · d(place).
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <array>

namespace palpate::implicit {

/// Of one channel and one state, N and mm, or a load factor and its potential in N mm: as many of the one as of the other.
struct Conjugates {
  Eigen::VectorXd force, place;
};

/// The first five bring energy to the organs; the others take it.
enum class Channel { tools, held, loads, supports, growth, friction, adhesion, tissue };
constexpr int channel_count = 8, bringing_channels = 5;

using Channels = std::array<Conjugates, channel_count>;

}  // namespace palpate::implicit
