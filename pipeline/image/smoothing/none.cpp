// No smoothing: s(x) = I(x).
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/smoothing.hpp>

namespace palpate::smoothing {

Filter none() {
  return {{"smoothing", "none", "The scan as it is.", "", {}}, [](const Scan& scan, const Amount&) { return scan; }};
}

}  // namespace palpate::smoothing
