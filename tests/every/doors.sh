#!/usr/bin/env bash
# The doors are shut, and scripts/check-doors fails for each kind of breach planted in a copy of the sources.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
root=$PWD
scripts/check-doors

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
copy=$folder/copy
mkdir "$copy"
cp -r CMakeLists.txt cmake include pipeline solver tests scripts "$copy/"
[ ! -d loop ] || cp -r loop "$copy/"
"$root/scripts/check-doors" "$copy" >/dev/null

head_lines() { printf '// A planted breach.\n// SPDX-License-Identifier: GPL-3.0-or-later\n'; }

# expect_breach <message> <file>: the planted file is found, with this message; then it is removed.
expect_breach() {
  local said
  if said=$("$root/scripts/check-doors" "$copy" 2>&1); then echo "not found: $1" >&2; exit 1; fi
  grep -qF "$1" <<<"$said" || { echo "expected \"$1\", got: $said" >&2; exit 1; }
  rm -r "${copy:?}/$2"
}

plant() { mkdir -p "$(dirname "$copy/$1")"; cat >"$copy/$1"; }

{ head_lines; echo '#include <solver/model.hpp>'; } | plant pipeline/image/planted.cpp
expect_breach "pipeline/ includes solver/model.hpp" pipeline/image/planted.cpp
{ head_lines; echo '#include "pipeline/image/grow.hpp"'; } | plant solver/planted.cpp
expect_breach "solver/ includes pipeline/image/grow.hpp" solver/planted.cpp
{ head_lines; echo '#include <solver/model.hpp>'; } | plant loop/methods/planted.cpp
expect_breach "loop/ includes solver/model.hpp" loop/methods/planted.cpp
{ head_lines; echo '# include <pipeline/image/grow.hpp>'; } | plant include/palpate/planted.hpp
expect_breach "include/ includes pipeline/image/grow.hpp" include/palpate/planted.hpp
{ head_lines; echo '#include "../image/grow.hpp"'; } | plant pipeline/mesh/planted.cpp
expect_breach "write <palpate/…> or <room/…>" pipeline/mesh/planted.cpp
{ head_lines; echo '#include <vtkPolyData.h>'; } | plant solver/planted.cpp
expect_breach "vtkPolyData.h, but cmake/vtk.cmake says its homes are" solver/planted.cpp
{ head_lines; echo '#include <libxml/parser.h>'; } | plant solver/planted.cpp
expect_breach "belongs to no library of cmake/*.cmake" solver/planted.cpp
printf '# A library without a home.\n# SPDX-License-Identifier: GPL-3.0-or-later\nfind_package(LibXml2 REQUIRED)\n' | plant cmake/planted.cmake
expect_breach 'cmake/planted.cmake: no line "# Homes: <room>..."' cmake/planted.cmake
printf '// A file nobody may copy.\nint x;\n' | plant solver/planted.cpp
expect_breach "no SPDX line" solver/planted.cpp
printf '\n// SPDX-License-Identifier: GPL-3.0-or-later\nint x;\n' | plant solver/planted.cpp
expect_breach "its first line must say what it is" solver/planted.cpp
{ head_lines; echo "const char* data = \"$folder/scan.nii.gz\";"; } | plant solver/planted.cpp
expect_breach "a path of one machine" solver/planted.cpp
