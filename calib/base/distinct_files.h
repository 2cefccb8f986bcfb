// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What a program writes is none of what it reads, and no two of them are one file.

#ifndef TILTCAL_DISTINCT_FILES_H
#define TILTCAL_DISTINCT_FILES_H

#include <string>
#include <vector>

namespace tiltcal
{

struct NamedFile
{
	std::string option, file;   ///< the option by which it was given; an empty file: it was not
};

/// Throws UsageError, which names the options, where an output is an input, also by another name or a link, or another output.
/// Devices and pipes may be given twice.
void CheckDistinct(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs);

}

#endif
