// Scans and labels as NIfTI-1 (.nii, .nii.gz): RAS on disk, LPS in memory.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>

#include <palpate/volume.hpp>

namespace palpate {

/// Reads a 3-D image of any scalar type, slope and intercept applied. The sform is used when set, else the qform.
/// Throws Failure(unreadable) for a file that is not NIfTI, truncated, not 3-D, without orientation, or with NaN.
Scan read_scan(const std::filesystem::path& path);

/// As read_scan, for whole numbers 0..65535; anything else is Failure(unreadable).
Labels read_labels(const std::filesystem::path& path);

/// Writes float32 / uint16 with sform and qform (a sheared lattice: sform alone). Throws Failure(unreadable) when the disk is
/// full.
void write_scan(const std::filesystem::path& path, const Scan& scan);
void write_labels(const std::filesystem::path& path, const Labels& labels);

}  // namespace palpate
