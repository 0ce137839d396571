/* SPDX-License-Identifier: BSD-3-Clause */
/**
 * @file libraries.h
 * The libraries found on this machine; the table is written by CMakeLists.txt.
 */
#ifndef CONFORMANCE_LIBRARIES_H
#define CONFORMANCE_LIBRARIES_H

#include "conformance.h"

extern const conf_library* const conf_libraries[];
extern const int conf_n_libraries;

#endif
