// Values of DICOM elements.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/dicom_values.hpp>

#include <gdcmByteValue.h>
#include <gdcmSequenceOfItems.h>
#include <gdcmTrace.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <sstream>

namespace palpate {

void silence_gdcm() {
  gdcm::Trace::DebugOff();
  gdcm::Trace::WarningOff();
  gdcm::Trace::ErrorOff();
}

std::string text_value(const gdcm::DataSet& data, gdcm::Tag tag) {
  if (!data.FindDataElement(tag)) return "";
  const gdcm::ByteValue* bytes = data.GetDataElement(tag).GetByteValue();
  if (!bytes || bytes->GetLength() == 0) return "";
  std::string text(bytes->GetPointer(), bytes->GetLength());
  const auto is_padding = [](char c) { return c == ' ' || c == '\0' || c == '\t'; };
  while (!text.empty() && is_padding(text.back())) text.pop_back();
  std::size_t begin = 0;
  while (begin < text.size() && is_padding(text[begin])) ++begin;
  return text.substr(begin);
}

std::optional<std::vector<double>> number_values(const gdcm::DataSet& data, gdcm::Tag tag) {
  std::istringstream parts(text_value(data, tag));
  std::vector<double> values;
  for (std::string part; std::getline(parts, part, '\\');) {
    const auto first = part.find_first_not_of(" +");
    const auto last = part.find_last_not_of(" \0");
    if (first == std::string::npos) return std::nullopt;
    double value = 0;
    const char* end = part.data() + last + 1;
    const auto [stop, error] = std::from_chars(part.data() + first, end, value);
    if (error != std::errc() || stop != end || !std::isfinite(value)) return std::nullopt;
    values.push_back(value);
  }
  if (values.empty()) return std::nullopt;
  return values;
}

std::optional<double> number_value(const gdcm::DataSet& data, gdcm::Tag tag) {
  const auto values = number_values(data, tag);
  return values ? std::optional(values->front()) : std::nullopt;
}

std::optional<int> short_value(const gdcm::DataSet& data, gdcm::Tag tag) {
  if (!data.FindDataElement(tag)) return std::nullopt;
  const gdcm::ByteValue* bytes = data.GetDataElement(tag).GetByteValue();
  if (!bytes || bytes->GetLength() < 2) return std::nullopt;
  std::uint16_t value = 0;
  std::memcpy(&value, bytes->GetPointer(), sizeof value);
  return value;
}

gdcm::SmartPointer<gdcm::SequenceOfItems> sequence_value(const gdcm::DataSet& data, gdcm::Tag tag) {
  if (!data.FindDataElement(tag)) return nullptr;
  auto items = data.GetDataElement(tag).GetValueAsSQ();
  return items && items->GetNumberOfItems() > 0 ? items : nullptr;
}

}  // namespace palpate
