# The stages of the small study one by one; sourced by the tests of tests/every.
# SPDX-License-Identifier: GPL-3.0-or-later
small_study=$PWD/tests/every/small_study
all_stages="phantom import segment surface mesh remesh solve compare report"

# make_small_study <bin> <folder>: runs the whole study, quietly.
make_small_study() {
  mkdir -p "$2"
  cp "$small_study"/*.toml "$2/"
  "$1/palpate" run "$2/study.toml" --quiet >/dev/null
}

# call_stage <bin> <stage> <study folder> <output folder> [options]: one stage on the study's files, its outputs elsewhere.
call_stage() {
  local bin=$1 stage=$2 from=$3/result to=$4 study=$3
  shift 4
  case $stage in
    phantom) set -- "$study/phantom.toml" "$to/dicom" "$to/truth" "$@" ;;
    import) set -- "$from/dicom" "$to/scan.nii.gz" "$@" ;;
    segment) set -- "$from/scan.nii.gz" "$to/labels.nii.gz" "$@" ;;
    surface) set -- "$from/labels.nii.gz" "$to/surface.vtp" --edge=4 "$@" ;;
    mesh) set -- "$from/surface.vtp" "$to/mesh.vtu" --edge=6 "$@" ;;
    remesh) set -- "$from/mesh.vtu" "$to/remeshed.vtu" "$@" ;;
    solve) set -- "$study/soft.toml" "$to/soft" --mesh "$from/mesh.vtu" "$@" ;;
    compare) set -- "$from" "$to/compare" "$@" ;;
    report) set -- "$from" "$to/report.html" "$@" ;;
    *) echo "no call for the stage $stage" >&2; return 99 ;;
  esac
  exec_stage "$bin/palpate-$stage" "$@" </dev/null
}

# Replaced by a test that wants the process itself in the background.
exec_stage() { "$@"; }

# bytes_of <folder>: every file with its hash, cards aside (they carry times).
bytes_of() { (cd "$1" && find . -type f -not -name '*.card.json' -print0 | sort -z | xargs -0 -r sha256sum); }
