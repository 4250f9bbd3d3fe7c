// main() of every executable.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <palpate/command.hpp>

int main(int argc, char** argv) { return palpate::run_program(argc, argv, usage, run); }
