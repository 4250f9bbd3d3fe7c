# Command lines (arguments.cpp).
# SPDX-License-Identifier: GPL-3.0-or-later
# Headers: CLI/.*
# Homes: include/palpate
find_package(CLI11 REQUIRED)
