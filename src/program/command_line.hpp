// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The command line: options in, exit status out.
///
/// Exit status: 0, or the number of the Status of the error (base/status.h), so that each kind of
/// error has its own. The error itself is one sentence on stderr.

namespace connectivity::program {

int run(int argc, const char* const* argv);

}  // namespace connectivity::program
