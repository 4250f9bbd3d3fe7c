// study.json: what a study made, for palpate-report. The same study gives the same bytes.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>

#include <pipeline/study/chain.hpp>

namespace palpate {

/// {schema, title, stages: [{name, stage, output, outputs, card}]}, paths relative to the result folder.
Json study_record(const StudyPlan& plan);

/// Written whole, and only when it says something new, so that what reads it stays current.
void write_study_record(const std::filesystem::path& path, const StudyPlan& plan);

}  // namespace palpate
