// Writing an MR series with GDCM.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/dicom_write.hpp>

#include <gdcmDataSet.h>
#include <gdcmWriter.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <sstream>

#include <palpate/errors.hpp>
#include <palpate/text_file.hpp>

namespace palpate {
namespace {

constexpr const char* mr_image_storage = "1.2.840.10008.5.1.4.1.1.4";

std::uint64_t fnv1a(const std::string& text, std::uint64_t hash) {
  for (unsigned char c : text) hash = (hash ^ c) * 1099511628211u;
  return hash;
}

void put(gdcm::DataSet& data, std::uint16_t group, std::uint16_t element, gdcm::VR::VRType vr, std::string value) {
  if (value.size() % 2) value += vr == gdcm::VR::UI ? '\0' : ' ';
  gdcm::DataElement e(gdcm::Tag(group, element));
  e.SetVR(vr);
  e.SetByteValue(value.data(), static_cast<std::uint32_t>(value.size()));
  data.Replace(e);
}

void put_short(gdcm::DataSet& data, std::uint16_t group, std::uint16_t element, std::uint16_t value) {
  put(data, group, element, gdcm::VR::US, std::string(reinterpret_cast<const char*>(&value), sizeof value));
}

/// Text that fits a long string (LO) or person name: 64 bytes of UTF-8, no backslash, no control characters.
std::string long_string(std::string text) {
  std::replace_if(text.begin(), text.end(), [](unsigned char c) { return c < 32 || c == '\\' || c == '^' || c == '='; }, ' ');
  if (text.size() > 64) {
    std::size_t end = 64;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;
    text.resize(end);
  }
  return text;
}

std::string joined(const Vec3& a) { return decimal_string(a[0]) + "\\" + decimal_string(a[1]) + "\\" + decimal_string(a[2]); }

void put_patient_and_study(gdcm::DataSet& d, const SeriesFacts& facts) {
  using VR = gdcm::VR;
  put(d, 0x0010, 0x0010, VR::PN, facts.patient_name);
  put(d, 0x0010, 0x0020, VR::LO, "PHANTOM");
  put(d, 0x0010, 0x0030, VR::DA, "");
  put(d, 0x0010, 0x0040, VR::CS, "O");
  put(d, 0x0020, 0x000d, VR::UI, uid_of(facts.identity + "/study"));
  put(d, 0x0008, 0x0020, VR::DA, "");
  put(d, 0x0008, 0x0030, VR::TM, "");
  put(d, 0x0008, 0x0050, VR::SH, "");
  put(d, 0x0008, 0x0090, VR::PN, "");
  put(d, 0x0020, 0x0010, VR::SH, "1");
}

void put_series(gdcm::DataSet& d, const SeriesFacts& facts) {
  using VR = gdcm::VR;
  put(d, 0x0008, 0x0060, VR::CS, "MR");
  put(d, 0x0020, 0x000e, VR::UI, uid_of(facts.identity + "/series"));
  put(d, 0x0020, 0x0011, VR::IS, std::to_string(facts.series_number));
  put(d, 0x0008, 0x103e, VR::LO, long_string(facts.description));
  put(d, 0x0018, 0x0015, VR::CS, facts.body_part);
  if (!facts.laterality.empty()) put(d, 0x0020, 0x0060, VR::CS, facts.laterality);
  put(d, 0x0018, 0x5100, VR::CS, "HFS");
  put(d, 0x0020, 0x0052, VR::UI, uid_of(facts.identity + "/frame of reference"));
  put(d, 0x0020, 0x1040, VR::LO, "");
  put(d, 0x0008, 0x0070, VR::LO, "Palpate");
  put(d, 0x0008, 0x1090, VR::LO, "palpate-phantom");
}

/// MR Image module; the sequence is a spin echo that nobody ran.
void put_mr_image(gdcm::DataSet& d) {
  using VR = gdcm::VR;
  put(d, 0x0008, 0x0005, VR::CS, "ISO_IR 192");
  put(d, 0x0008, 0x0008, VR::CS, "ORIGINAL\\PRIMARY\\OTHER");
  put(d, 0x0008, 0x0016, VR::UI, mr_image_storage);
  put(d, 0x0018, 0x0020, VR::CS, "SE");
  put(d, 0x0018, 0x0021, VR::CS, "NONE");
  put(d, 0x0018, 0x0022, VR::CS, "");
  put(d, 0x0018, 0x0023, VR::CS, "2D");
  put(d, 0x0018, 0x0080, VR::DS, "500");
  put(d, 0x0018, 0x0081, VR::DS, "15");
  put(d, 0x0018, 0x0091, VR::IS, "1");
}

void put_plane(gdcm::DataSet& d, const Grid& grid, double slice_thickness_mm) {
  using VR = gdcm::VR;
  const auto& steps = grid.lps_from_voxel.columns;
  put(d, 0x0020, 0x0037, VR::DS, joined(unit(steps[0])) + "\\" + joined(unit(steps[1])));
  // PixelSpacing: between rows first, then between columns.
  put(d, 0x0028, 0x0030, VR::DS, decimal_string(norm(steps[1])) + "\\" + decimal_string(norm(steps[0])));
  put(d, 0x0018, 0x0050, VR::DS, decimal_string(slice_thickness_mm));
  put(d, 0x0018, 0x0088, VR::DS, decimal_string(norm(steps[2])));
}

void put_pixel_format(gdcm::DataSet& d, const Volume<std::uint16_t>& scan) {
  using VR = gdcm::VR;
  put_short(d, 0x0028, 0x0002, 1);
  put(d, 0x0028, 0x0004, VR::CS, "MONOCHROME2");
  put_short(d, 0x0028, 0x0010, static_cast<std::uint16_t>(scan.grid.size[1]));
  put_short(d, 0x0028, 0x0011, static_cast<std::uint16_t>(scan.grid.size[0]));
  put_short(d, 0x0028, 0x0100, 16);
  put_short(d, 0x0028, 0x0101, 16);
  put_short(d, 0x0028, 0x0102, 15);
  put_short(d, 0x0028, 0x0103, 0);
  const double brightest = *std::max_element(scan.voxels.begin(), scan.voxels.end());
  put(d, 0x0028, 0x1050, VR::DS, decimal_string(std::max(1.0, std::round(brightest / 2))));
  put(d, 0x0028, 0x1051, VR::DS, decimal_string(std::max(1.0, brightest)));
}

/// What differs from slice to slice.
void put_slice(gdcm::DataSet& d, const Volume<std::uint16_t>& scan, const SeriesFacts& facts, int k) {
  using VR = gdcm::VR;
  put(d, 0x0008, 0x0018, VR::UI, uid_of(facts.identity + "/slice " + std::to_string(k)));
  put(d, 0x0020, 0x0013, VR::IS, std::to_string(k + 1));
  put(d, 0x0020, 0x0032, VR::DS, joined(scan.grid.lps_from_voxel({0, 0, double(k)})));
  const std::size_t count = std::size_t(scan.grid.size[0]) * scan.grid.size[1];
  std::string pixels(2 * count, '\0');  // the machine is little endian, as the file
  std::memcpy(pixels.data(), scan.voxels.data() + k * count, pixels.size());
  put(d, 0x7fe0, 0x0010, VR::OW, std::move(pixels));
}

}  // namespace

std::string uid_of(const std::string& text) {
  unsigned __int128 bits = fnv1a(text, 14695981039346656037u);
  bits = bits << 64 | fnv1a("second half " + text, 14695981039346656037u);
  std::string digits;
  for (; bits > 0; bits /= 10) digits.insert(digits.begin(), static_cast<char>('0' + static_cast<int>(bits % 10)));
  return "2.25." + (digits.empty() ? "0" : digits);
}

std::string decimal_string(double x) {
  if (std::abs(x) < 1e-12) x = 0;
  char text[40];
  for (int digits = 14; digits > 0; --digits) {
    std::snprintf(text, sizeof text, "%.*g", digits, x);
    if (std::strlen(text) <= 16) break;
  }
  return text;
}

void write_mr_series(const std::filesystem::path& folder, const Volume<std::uint16_t>& scan, const SeriesFacts& facts) {
  gdcm::DataSet common;
  put_patient_and_study(common, facts);
  put_series(common, facts);
  put_mr_image(common);
  put_plane(common, scan.grid, facts.slice_thickness_mm);
  put_pixel_format(common, scan);
  for (int k = 0; k < scan.grid.size[2]; ++k) {
    gdcm::Writer writer;
    gdcm::File& file = writer.GetFile();
    file.SetDataSet(common);
    put_slice(file.GetDataSet(), scan, facts, k);
    file.GetHeader().SetDataSetTransferSyntax(gdcm::TransferSyntax::ExplicitVRLittleEndian);
    std::ostringstream bytes;
    writer.SetStream(bytes);
    char name[32];
    std::snprintf(name, sizeof name, "IM_%04d.dcm", k + 1);
    if (!writer.Write()) throw Failure(ExitCode::unreadable, "cannot write a slice", (folder / name).string(), "check free space (df -h)");
    write_text(folder / name, bytes.str());
  }
}

}  // namespace palpate
