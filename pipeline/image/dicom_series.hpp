// A stack of slices read into memory: real value = slope · stored + intercept, slice by slice.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <palpate/progress.hpp>
#include <palpate/volume.hpp>
#include <pipeline/image/dicom_geometry.hpp>

namespace palpate {

/// Throws Failure(unreadable) naming the file: truncated, undecodable, colour, another size than its header says.
Scan read_slices(const SliceStack& stack, Progress& progress);

}  // namespace palpate
