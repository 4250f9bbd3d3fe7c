// What else explains it: one effect in place of several, one in place of another.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <loop/methods/search.hpp>

namespace palpate::loop {

/// One effect that explains as well as several is the better explanation.
void simplify(Finding& finding);

/// Every active effect is exchanged for every other; a better exchange becomes the model, near ones become alternatives.
void exchange(Session& session, Finding& finding);

}  // namespace palpate::loop
