// Values of DICOM elements as text and numbers, and silence from GDCM. Only for the .cpp files that speak to GDCM.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <gdcmDataSet.h>

#include <optional>
#include <string>
#include <vector>

namespace palpate {

/// Turns off GDCM's own messages: ours say what matters.
void silence_gdcm();

/// The text of an element without padding; empty when absent.
std::string text_value(const gdcm::DataSet& data, gdcm::Tag tag);
/// The numbers of a DS or IS element, separated by backslashes; nothing when absent, empty or one of them is damaged or not finite.
std::optional<std::vector<double>> number_values(const gdcm::DataSet& data, gdcm::Tag tag);
/// The first of them.
std::optional<double> number_value(const gdcm::DataSet& data, gdcm::Tag tag);
/// An unsigned short.
std::optional<int> short_value(const gdcm::DataSet& data, gdcm::Tag tag);
/// A sequence; null when absent or empty.
gdcm::SmartPointer<gdcm::SequenceOfItems> sequence_value(const gdcm::DataSet& data, gdcm::Tag tag);

}  // namespace palpate
