// How many threads OpenCV may use, in this whole program.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace palpate {

/// Results do not depend on it: every pixel is computed by itself.
void use_image_threads(int threads);

}  // namespace palpate
