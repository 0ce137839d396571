// SPDX-License-Identifier: BSD-3-Clause
#include "program/command_line.hpp"

int main(int argc, char** argv) { return connectivity::program::run(argc, argv); }
