# TOML. Home: include/palpate (settings.cpp).
# SPDX-License-Identifier: GPL-3.0-or-later
find_package(tomlplusplus REQUIRED)
