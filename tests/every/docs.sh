#!/usr/bin/env bash
# The generated pages of docs/stages are what the programs say of themselves.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
python3 scripts/docs --check "$1"
