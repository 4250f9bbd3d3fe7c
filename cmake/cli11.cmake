# Command lines. Home: include/palpate (command.cpp).
# SPDX-License-Identifier: GPL-3.0-or-later
find_package(CLI11 REQUIRED)
