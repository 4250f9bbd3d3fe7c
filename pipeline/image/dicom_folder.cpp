// Sorting the files of a folder into series.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/dicom_folder.hpp>

#include <algorithm>
#include <cstdlib>

#include <palpate/errors.hpp>
#include <pipeline/image/guarded.hpp>

namespace palpate {
namespace fs = std::filesystem;
namespace {

std::vector<fs::path> files_below(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::string or_none(const std::string& text) { return text.empty() ? "(none)" : text; }

std::string list_of(const std::vector<DicomSeries>& series) {
  std::string list;
  for (const DicomSeries& s : series)
    list += "\n  number " + or_none(s.name.number) + "  " + or_none(s.name.modality) + "  " + std::to_string(s.frames.size()) + " images  \"" +
            s.name.description + "\"  uid " + or_none(s.name.uid);
  return list;
}

std::string lower(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

std::string counts(const DicomFolder& folder) {
  std::string text;
  for (const auto& [modality, count] : folder.objects_without_image) text += ", " + std::to_string(count) + " " + or_none(modality);
  if (folder.foreign_files > 0) text += ", " + std::to_string(folder.foreign_files) + " not DICOM";
  return text.empty() ? "" : text.substr(2);
}

}  // namespace

DicomFolder scan_dicom_folder(const fs::path& path) {
  const auto files = files_below(path);
  if (files.empty()) throw Failure(ExitCode::unreadable, "the folder is empty", path.string(), "a folder with the DICOM files of a scan");
  run_guarded([&](const NowReading& now_reading) {  // a rehearsal: a damaged file may end the process
    for (const fs::path& file : files) {
      now_reading(file.string());
      read_dicom_header(file);
    }
  });
  DicomFolder folder;
  std::map<SeriesName, DicomSeries> by_name;
  for (const fs::path& file : files) {
    auto header = read_dicom_header(file);
    if (!header) {
      ++folder.foreign_files;
    } else if (header->frames.empty()) {
      ++folder.objects_without_image[header->series.modality];
    } else {
      // One UID is one series, whatever else its files disagree on; files without UID go together when nothing tells them apart.
      SeriesName key = header->series;
      if (!key.uid.empty()) key = {key.uid, "", "", "", "", ""};
      auto& series = by_name[key];
      if (series.frames.empty()) series.name = header->series;
      series.frames.insert(series.frames.end(), header->frames.begin(), header->frames.end());
    }
  }
  for (auto& [key, series] : by_name) folder.series.push_back(std::move(series));
  std::stable_sort(folder.series.begin(), folder.series.end(), [](const DicomSeries& a, const DicomSeries& b) {
    return std::atol(a.name.number.c_str()) < std::atol(b.name.number.c_str());
  });
  if (folder.series.empty())
    throw Failure(ExitCode::unreadable, folder.objects_without_image.empty() ? "no DICOM file in the folder" : "no DICOM image in the folder",
                  path.string() + " (" + counts(folder) + ")", "a folder with the DICOM files of a scan");
  return folder;
}

const DicomSeries& choose_series(const DicomFolder& folder, const std::string& wanted) {
  const auto& all = folder.series;
  if (wanted.empty()) {
    if (all.size() == 1) return all.front();
    throw Failure(ExitCode::misuse, std::to_string(all.size()) + " series in the folder:" + list_of(all), "", "choose one: --series UID, number or description");
  }
  std::vector<const DicomSeries*> exact, similar;
  for (const DicomSeries& s : all) {
    if (s.name.uid == wanted || s.name.number == wanted || s.name.description == wanted) exact.push_back(&s);
    if (lower(s.name.description).find(lower(wanted)) != std::string::npos) similar.push_back(&s);
  }
  const auto& found = exact.empty() ? similar : exact;
  if (found.size() == 1) return *found.front();
  throw Failure(ExitCode::misuse, (found.empty() ? "no series is called " : "several series are called ") + wanted + list_of(all), "--series",
                "the UID of one of these");
}

}  // namespace palpate
