// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// A file in the making: written beside its place under another name, renamed when it is complete.
///
/// Invariant: at `path` stands the old file or the whole new one, never a part.

#include <string>

namespace connectivity {

class PendingFile {
public:
    /// Throws Error{file} if the folder of `path` does not exist or cannot be written to, or `path`
    /// is a folder.
    explicit PendingFile(std::string path);
    ~PendingFile();  ///< removes what was not committed
    PendingFile(const PendingFile&) = delete;
    PendingFile& operator=(const PendingFile&) = delete;

    const std::string& path() const { return path_; }
    const std::string& temporary() const { return temporary_; }  ///< write here

    /// Puts the file in its place. Throws Error{file}.
    void commit();

private:
    std::string path_, temporary_;
    bool committed_ = false;
};

}  // namespace connectivity
