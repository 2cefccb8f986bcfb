// SPDX-License-Identifier: AGPL-3.0-or-later
//
// File names in, whole files out.

#ifndef TILTCAL_FILES_H
#define TILTCAL_FILES_H

#include <functional>
#include <string>
#include <vector>

namespace tiltcal
{

/// A folder's name in a pattern for ExpandGlobs: what would match others there stands for itself.
std::string AsPattern(const std::string& folder);

/// Every file that the patterns match (* ? [..] and plain names), sorted so that
/// numbers count as numbers (photo-2 before photo-10), without duplicates.
/// Throws FileError when a pattern matches nothing; `option` is named in the message.
std::vector<std::string> ExpandGlobs(const std::vector<std::string>& patterns, const std::string& option);

/// Throws FileError unless `file` is there and regular: reading a folder fails later and in
/// other words, and opening a pipe waits for its writer. `what` it should be, such as "a picture".
void NeedRegularFile(const std::string& file, const std::string& what);

/// A whole text file of at most `most` bytes, for parsers. Throws FileError.
std::string ReadText(const std::string& file, const std::string& what, size_t most = 64 << 20);

/// Creates the folder (and its parents) and proves that a file can be written in it.
/// Throws FileError, which says to give another with `input` where one is named. Called before the work starts, not after it.
void PrepareFolder(const std::string& folder, const std::string& input = "out");

/// PrepareFolder for the folder that `file`, or what it links to, is to be written in. A device must be writable itself.
void PrepareFolderOf(const std::string& file);

/// A FileSet (file_set.h) of one file: an interrupted run leaves the old file or none.
/// `write` returns false, or throws Error, when it cannot. Throws FileError.
void WriteAtomically(const std::string& file, const std::function<bool(const std::string& temporary)>& write);

/// WriteAtomically for text.
void WriteText(const std::string& file, const std::string& text);

/// File name without folder and suffix.
std::string Stem(const std::string& file);

/// File name without folder.
std::string BaseName(const std::string& file);

/// folder/name
std::string Join(const std::string& folder, const std::string& name);

}

#endif
