#!/usr/bin/env bash
# Six of the sixty indentations of bench/robustness: full depth (40 % of the organ's thickness), forces balanced to 0.1 %, energy to 1 % (in eight
# steps, the work's own quadrature is little better), no face's point deeper than 1 % of the face.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
bin=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

PYTHONDONTWRITEBYTECODE=1 python3 bench/robustness/indentations.py "$bin" "$folder" 1 12 31 40 41 56
python3 - "$folder/table.csv" <<'PY'
import csv, sys
rows = list(csv.reader(open(sys.argv[1])))
assert len(rows) == 6, rows
for row in rows:
    assert row[6] == "0", row
    assert float(row[10]) <= 1e-3 and float(row[11]) <= 0.01 and float(row[14]) <= 0.01 and row[15] == "", row
PY
