// Instruments, then shortcuts.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/register.hpp>

namespace palpate::loop {

const std::vector<Effect>& all_effects() {
  static const std::vector<Effect> list = [] {
    std::vector<Effect> both = instruments::all();
    for (Effect& effect : shortcuts::all()) both.push_back(std::move(effect));
    return both;
  }();
  return list;
}

}  // namespace palpate::loop
