# Two small kidney label maps at native spacing (4 and 5 mm slices) become surfaces and meshes that pass every check.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
masks=${PALPATE_SHARED_DATA:-$PWD/../shared/data}/masks/kits19_kidneys
if [ ! -d "$masks" ]; then echo "SKIPPED: no $masks"; exit 0; fi
bench/quality/kits19.sh "$1" case_00038 case_00039
