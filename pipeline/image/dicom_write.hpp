// An MR Image Storage series (DICOM PS3.3 A.4), one file per slice, Explicit VR Little Endian.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

#include <palpate/volume.hpp>

namespace palpate {

struct SeriesFacts {
  std::string identity;  ///< all UIDs follow from this text: the same text gives the same UIDs
  std::string patient_name;  ///< Family^Given
  std::string description;
  std::string body_part;  ///< a DICOM code: KIDNEY, COLON
  std::string laterality;    ///< L or R for one of a pair, else empty
  double slice_thickness_mm = 1;
  int series_number = 1;
};

/// A UID 2.25.<128 bits in decimal> that follows from the text (PS3.5 B.2; the bits are two 64-bit FNV-1a hashes).
std::string uid_of(const std::string& text);

/// A number as a DICOM decimal string: at most 16 characters.
std::string decimal_string(double x);

/// Writes IM_0001.dcm … into the folder, slice k = file k + 1. No dates: the study has none.
/// Throws Failure(unreadable) when the disk is full.
void write_mr_series(const std::filesystem::path& folder, const Volume<std::uint16_t>& scan, const SeriesFacts& facts);

}  // namespace palpate
