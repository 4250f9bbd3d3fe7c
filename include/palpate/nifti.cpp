// NIfTI-1 by the reference library. x_ras = diag(−1, −1, 1) x_lps.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <palpate/nifti.hpp>

#include <nifti1_io.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>

#include <palpate/errors.hpp>

namespace palpate {
namespace {

using Image = std::unique_ptr<nifti_image, decltype(&nifti_image_free)>;

[[noreturn]] void unreadable(const std::filesystem::path& path, const std::string& what, const std::string& next = "") {
  throw Failure(ExitCode::unreadable, what, path.string(), next);
}

/// The library takes a short file for a whole one with zeros at the end: count the bytes, and let zlib verify their checksum.
void expect_every_byte(const nifti_image& image, const std::filesystem::path& path) {
  const std::unique_ptr<gzFile_s, decltype(&gzclose)> file(gzopen(image.iname, "rb"), gzclose);
  const std::size_t expected = image.iname_offset + image.nvox * image.nbyper;
  std::vector<char> block(1 << 20);
  std::size_t bytes = 0;
  int got = 0;
  while (file && (got = gzread(file.get(), block.data(), block.size())) > 0) bytes += got;
  int error = Z_OK;
  if (file) gzerror(file.get(), &error);
  if (!file || got < 0 || error != Z_OK || bytes < expected)
    unreadable(path, "truncated or damaged: " + std::to_string(bytes) + " good bytes of " + std::to_string(expected),
               "copy it again");
}

Image read_header(const std::filesystem::path& path) {
  nifti_set_debug_level(0);
  Image image(nifti_image_read(path.c_str(), 0), nifti_image_free);
  if (image && image->nifti_type == NIFTI_FTYPE_NIFTI1_1) {  // one file: not the "scan.nii" beside "scan.nii.gz"
    std::free(image->iname);
    image->iname = strdup(path.c_str());
  }
  return image;
}

/// The voxels from `iname`; false when they are not all there. (The library's own nifti_image_load would search for another name,
/// and its nifti_read_buffer would turn NaN into zero.)
bool load_voxels(nifti_image& image) {
  znzFile file = znzopen(image.iname, "rb", 1);
  if (znz_isnull(file)) return false;
  const std::size_t bytes = image.nvox * image.nbyper;
  image.data = std::calloc(1, bytes);
  const bool complete =
      image.data && znzseek(file, image.iname_offset, SEEK_SET) >= 0 && znzread(image.data, 1, bytes, file) == bytes;
  if (complete && image.swapsize > 1 && image.byteorder != nifti_short_order())
    nifti_swap_Nbytes(bytes / image.swapsize, image.swapsize, image.data);
  znzclose(file);
  return complete;
}

Image read_image(const std::filesystem::path& path) {
  Image image = read_header(path);
  if (!image) unreadable(path, "not a NIfTI image", "dcm2niix or palpate-import writes one");
  if (image->nx < 1 || image->ny < 1 || image->nz < 1 || image->nvox != std::size_t(image->nx) * image->ny * image->nz)
    unreadable(path, "not a three-dimensional image", "extract one volume");
  if (image->sform_code <= 0 && image->qform_code <= 0)
    unreadable(path, "no orientation: neither sform nor qform is set", "write it with the orientation of its scan");
  expect_every_byte(*image, path);
  if (!load_voxels(*image)) unreadable(path, "cannot read the voxels", "copy it again");
  return image;
}

Grid grid_of(const nifti_image& image, const std::filesystem::path& path) {
  const mat44& m = image.sform_code > 0 ? image.sto_xyz : image.qto_xyz;
  Grid grid;
  grid.size = {static_cast<int>(image.nx), static_cast<int>(image.ny), static_cast<int>(image.nz)};
  const double to_mm = image.xyz_units == NIFTI_UNITS_METER ? 1000 : image.xyz_units == NIFTI_UNITS_MICRON ? 0.001 : 1;
  for (int row = 0; row < 3; ++row) {
    const double sign = (row < 2 ? -1 : 1) * to_mm;
    for (int column = 0; column < 3; ++column) grid.lps_from_voxel.columns[column][row] = sign * m.m[row][column];
    grid.lps_from_voxel.origin[row] = sign * m.m[row][3];
  }
  const double volume = grid.lps_from_voxel.determinant();
  if (!(std::abs(volume) > 1e-12) || !std::isfinite(volume)) unreadable(path, "the voxel axes are not independent");
  return grid;
}

template <class Stored, class Visit>
void visit_as(const nifti_image& image, const Visit& visit) {
  const Stored* data = static_cast<const Stored*>(image.data);
  const double slope = image.scl_slope != 0 ? image.scl_slope : 1, intercept = image.scl_slope != 0 ? image.scl_inter : 0;
  for (std::size_t i = 0; i < image.nvox; ++i) visit(static_cast<double>(data[i]) * slope + intercept);
}

/// Calls `visit` with every voxel's value, slope and intercept applied; x fastest.
template <class Visit>
void visit_values(const nifti_image& image, const std::filesystem::path& path, const Visit& visit) {
  switch (image.datatype) {
    case DT_UINT8: return visit_as<std::uint8_t>(image, visit);
    case DT_INT8: return visit_as<std::int8_t>(image, visit);
    case DT_UINT16: return visit_as<std::uint16_t>(image, visit);
    case DT_INT16: return visit_as<std::int16_t>(image, visit);
    case DT_UINT32: return visit_as<std::uint32_t>(image, visit);
    case DT_INT32: return visit_as<std::int32_t>(image, visit);
    case DT_UINT64: return visit_as<std::uint64_t>(image, visit);
    case DT_INT64: return visit_as<std::int64_t>(image, visit);
    case DT_FLOAT32: return visit_as<float>(image, visit);
    case DT_FLOAT64: return visit_as<double>(image, visit);
    default:
      unreadable(path, std::string("voxels of type ") + nifti_datatype_string(image.datatype), "convert it to a scalar type");
  }
}

/// A sheared lattice (a tilted gantry) has no quaternion: its file then carries the sform alone.
bool is_orthogonal(const Grid& grid) {
  const auto& [a, b, c] = grid.lps_from_voxel.columns;
  const double cosine =
      std::max({std::abs(dot(unit(a), unit(b))), std::abs(dot(unit(b), unit(c))), std::abs(dot(unit(c), unit(a)))});
  return cosine <= 1e-4;
}

void set_orientation(nifti_image& image, const Grid& grid) {
  for (int row = 0; row < 3; ++row) {
    const double sign = row < 2 ? -1 : 1;
    for (int column = 0; column < 3; ++column) image.sto_xyz.m[row][column] = sign * grid.lps_from_voxel.columns[column][row];
    image.sto_xyz.m[row][3] = sign * grid.lps_from_voxel.origin[row];
  }
  image.sto_xyz.m[3][3] = 1;
  image.sform_code = NIFTI_XFORM_SCANNER_ANAT;
  image.qform_code = is_orthogonal(grid) ? NIFTI_XFORM_SCANNER_ANAT : NIFTI_XFORM_UNKNOWN;
  image.sto_ijk = nifti_mat44_inverse(image.sto_xyz);
  nifti_mat44_to_quatern(image.sto_xyz, &image.quatern_b, &image.quatern_c, &image.quatern_d, &image.qoffset_x, &image.qoffset_y,
                         &image.qoffset_z, &image.dx, &image.dy, &image.dz, &image.qfac);
  image.pixdim[1] = image.dx;
  image.pixdim[2] = image.dy;
  image.pixdim[3] = image.dz;
  image.xyz_units = NIFTI_UNITS_MM;
}

template <class Voxel>
void write_volume(const std::filesystem::path& path, const Volume<Voxel>& volume, int datatype) {
  const int dims[8] = {3, volume.grid.size[0], volume.grid.size[1], volume.grid.size[2], 1, 1, 1, 1};
  nifti_set_debug_level(0);
  Image image(nifti_make_new_nim(dims, datatype, 1), nifti_image_free);
  if (!image) throw std::bad_alloc();
  std::memcpy(image->data, volume.voxels.data(), volume.voxels.size() * sizeof(Voxel));
  set_orientation(*image, volume.grid);
  nifti_set_filenames(image.get(), path.c_str(), 0, 1);
  nifti_image_write(image.get());
  // The library does not say whether it could write: read back.
  const Image written = read_header(path);
  if (!written || !load_voxels(*written) ||
      std::memcmp(written->data, volume.voxels.data(), volume.voxels.size() * sizeof(Voxel)) != 0)
    throw Failure(ExitCode::unreadable, "cannot write the image", path.string(), "check free space (df -h) and permissions");
}

}  // namespace

Scan read_scan(const std::filesystem::path& path) {
  const Image image = read_image(path);
  Scan scan{grid_of(*image, path), {}};
  scan.voxels.reserve(image->nvox);
  visit_values(*image, path, [&](double v) {
    if (!std::isfinite(v)) unreadable(path, "voxels that are not finite numbers", "replace NaN and infinities");
    scan.voxels.push_back(static_cast<float>(v));
  });
  return scan;
}

Labels read_labels(const std::filesystem::path& path) {
  const Image image = read_image(path);
  Labels labels{grid_of(*image, path), {}};
  labels.voxels.reserve(image->nvox);
  visit_values(*image, path, [&](double v) {
    if (!(v >= 0 && v <= 65535) || v != std::floor(v))
      unreadable(path, "not labels: voxels that are not whole numbers from 0 to 65535");
    labels.voxels.push_back(static_cast<std::uint16_t>(v));
  });
  return labels;
}

void write_scan(const std::filesystem::path& path, const Scan& scan) { write_volume(path, scan, DT_FLOAT32); }
void write_labels(const std::filesystem::path& path, const Labels& labels) { write_volume(path, labels, DT_UINT16); }

}  // namespace palpate
