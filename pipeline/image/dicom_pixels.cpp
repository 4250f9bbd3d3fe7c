// Decoding with GDCM, and the checks it leaves to its caller: lengths, ends of streams, bits outside the stored ones.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/dicom_pixels.hpp>

#include <gdcmImageReader.h>
#include <gdcmSequenceOfFragments.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <string_view>

#include <palpate/errors.hpp>
#include <pipeline/image/dicom_values.hpp>
#include <pipeline/image/quiet_stderr.hpp>
#include <pipeline/image/watched_file.hpp>

namespace palpate {
namespace {

using gdcm::PixelFormat;
const gdcm::Tag pixel_data(0x7fe0, 0x0010);

[[noreturn]] void unreadable(const std::filesystem::path& path, const std::string& what, const std::string& next) {
  throw Failure(ExitCode::unreadable, what, path.string(), next);
}

[[noreturn]] void truncated(const std::filesystem::path& path) {
  unreadable(path, "the pixel data are truncated", "copy the file again from its source");
}

/// True when a compressed frame ends as its codec says: JPEG, JPEG-LS and JPEG 2000 codestreams end with the marker FF D9.
bool ends_with_marker(const gdcm::ByteValue& bytes) {
  const std::string_view data(bytes.GetPointer(), bytes.GetLength());
  const auto end = data.find_last_not_of('\0');  // padding is 00, or one FF
  return end != std::string_view::npos && data.substr(0, end + 1).rfind("\xff\xd9") + 3 >= end + 1;
}

/// The raw element must hold what the header promises: GDCM fills what is missing with zeros.
void expect_complete(const gdcm::File& file, const gdcm::Image& image, const std::filesystem::path& path) {
  if (!file.GetDataSet().FindDataElement(pixel_data)) unreadable(path, "no pixel data", "this object holds no image");
  const gdcm::DataElement& element = file.GetDataSet().GetDataElement(pixel_data);
  const gdcm::TransferSyntax& syntax = file.GetHeader().GetDataSetTransferSyntax();
  if (!syntax.IsEncapsulated()) {
    const gdcm::ByteValue* bytes = element.GetByteValue();
    if (!bytes || bytes->GetLength() < image.GetBufferLength()) truncated(path);
    return;
  }
  const gdcm::SequenceOfFragments* fragments = element.GetSequenceOfFragments();
  const int frames = image.GetNumberOfDimensions() == 3 ? image.GetDimension(2) : 1;
  if (!fragments || fragments->GetNumberOfFragments() < static_cast<std::size_t>(frames)) truncated(path);
  if (syntax == gdcm::TransferSyntax::RLELossless) return;
  const bool one_each = fragments->GetNumberOfFragments() == static_cast<std::size_t>(frames);
  for (std::size_t i = 0; i < fragments->GetNumberOfFragments(); ++i) {
    const gdcm::ByteValue* bytes = fragments->GetFragment(i).GetByteValue();
    const bool is_end = one_each || i + 1 == fragments->GetNumberOfFragments();
    if (!bytes || (is_end && !ends_with_marker(*bytes))) truncated(path);
  }
}

template <class T>
void copy_values(const std::vector<char>& buffer, std::vector<double>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    T value;
    std::memcpy(&value, buffer.data() + i * sizeof(T), sizeof(T));
    values[i] = static_cast<double>(value);
  }
}

/// Whole numbers: the stored bits only, with their sign.
template <class Unsigned>
void copy_stored_bits(const std::vector<char>& buffer, const PixelFormat& format, std::vector<double>& values) {
  const int stored = format.GetBitsStored(), shift = format.GetHighBit() + 1 - stored;
  const std::uint64_t mask = (std::uint64_t(1) << stored) - 1;
  for (std::size_t i = 0; i < values.size(); ++i) {
    Unsigned word;
    std::memcpy(&word, buffer.data() + i * sizeof(Unsigned), sizeof(Unsigned));
    const std::uint64_t bits = (std::uint64_t(word) >> shift) & mask;
    const bool negative = format.GetPixelRepresentation() == 1 && (bits >> (stored - 1) & 1);
    values[i] = static_cast<double>(static_cast<std::int64_t>(bits)) - (negative ? std::ldexp(1.0, stored) : 0.0);
  }
}

void convert(const std::vector<char>& buffer, const PixelFormat& format, std::vector<double>& values, const std::filesystem::path& path) {
  const int stored = format.GetBitsStored(), allocated = format.GetBitsAllocated();
  if (format == PixelFormat::FLOAT32) return copy_values<float>(buffer, values);
  if (format == PixelFormat::FLOAT64) return copy_values<double>(buffer, values);
  if (stored < 1 || stored > allocated || format.GetHighBit() + 1 < stored || format.GetHighBit() >= allocated)
    unreadable(path, "damaged: BitsStored and HighBit do not fit BitsAllocated", "check the file's header");
  switch (allocated) {
    case 8: return copy_stored_bits<std::uint8_t>(buffer, format, values);
    case 16: return copy_stored_bits<std::uint16_t>(buffer, format, values);
    case 32: return copy_stored_bits<std::uint32_t>(buffer, format, values);
    default: unreadable(path, "pixels of " + std::to_string(allocated) + " bits", "8, 16 and 32 bits are read");
  }
}

}  // namespace

StoredPixels read_stored_pixels(const std::filesystem::path& path) {
  silence_gdcm();
  WatchedFile file(path);
  gdcm::ImageReader reader;
  reader.SetStream(file.stream());
  std::vector<char> buffer;
  try {
    const QuietStderr quiet;
    const bool complete = reader.Read();
    const bool deflated = reader.GetFile().GetHeader().GetDataSetTransferSyntax() == gdcm::TransferSyntax::DeflatedExplicitVRLittleEndian;
    if (file.ended_early() && !deflated) truncated(path);
    if (!complete) unreadable(path, "the image cannot be read: damaged or truncated", "copy the file again from its source");
    const gdcm::Image& image = reader.GetImage();
    if (image.GetPixelFormat().GetSamplesPerPixel() != 1 || image.GetPhotometricInterpretation().GetSamplesPerPixel() != 1 ||
        image.GetPhotometricInterpretation() == gdcm::PhotometricInterpretation::PALETTE_COLOR)
      unreadable(path, "a colour image (a screen capture?), where a scan is read", "choose another series with --series");
    expect_complete(reader.GetFile(), image, path);
    buffer.resize(image.GetBufferLength());
    if (buffer.empty() || !image.GetBuffer(buffer.data()))
      unreadable(path, std::string("pixels of transfer syntax ") + reader.GetFile().GetHeader().GetDataSetTransferSyntax().GetString() +
                           " that cannot be decoded: damaged, or a variant not supported", "convert the series with another tool (dcmdjpls, gdcmconv), or copy it again");
  } catch (const Failure&) {
    throw;
  } catch (const std::exception& error) {
    unreadable(path, std::string("the image cannot be decoded: ") + error.what(), "copy the file again from its source");
  }
  const gdcm::Image& image = reader.GetImage();
  StoredPixels pixels;
  pixels.columns = static_cast<int>(image.GetDimension(0));
  pixels.rows = static_cast<int>(image.GetDimension(1));
  pixels.frames = image.GetNumberOfDimensions() == 3 ? static_cast<int>(image.GetDimension(2)) : 1;
  pixels.values.resize(std::size_t(pixels.columns) * pixels.rows * pixels.frames);
  if (buffer.size() < pixels.values.size() * image.GetPixelFormat().GetPixelSize()) truncated(path);
  convert(buffer, image.GetPixelFormat(), pixels.values, path);
  return pixels;
}

}  // namespace palpate
