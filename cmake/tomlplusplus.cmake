# TOML (settings.cpp).
# SPDX-License-Identifier: GPL-3.0-or-later
# Headers: toml\+\+/.*
# Homes: include/palpate
find_package(tomlplusplus REQUIRED)
