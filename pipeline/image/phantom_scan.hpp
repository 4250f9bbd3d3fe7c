// The scan of a phantom: partial volume by supersampling, coil bias, Rician noise; and its true labels on the same lattice.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>

#include <palpate/volume.hpp>
#include <pipeline/image/phantom_spec.hpp>

namespace palpate {

struct PhantomImages {
  Volume<std::uint16_t> scan;  ///< stored values
  Labels organ;                ///< 1 where at least half of the voxel's samples lie in the organ
  Labels parts;                ///< there, the label of the part with most samples
};

/// Same result for every number of threads.
PhantomImages render(const PhantomSpec& spec, std::uint64_t seed, int threads);

}  // namespace palpate
