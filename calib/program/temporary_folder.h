// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_TEMPORARY_FOLDER_H
#define TILTCAL_TEMPORARY_FOLDER_H

#include <string>

namespace tiltcal
{

/// $TMPDIR or /tmp, and a name for mkstemp and mkdtemp there that begins with `program`.
std::string TemporaryTemplate(const std::string& program);

/// A folder of its own, removed with what is in it.
class TemporaryFolder
{
public:
	/// Named by TemporaryTemplate. Throws FileError.
	explicit TemporaryFolder(const std::string& program);
	~TemporaryFolder();
	TemporaryFolder(const TemporaryFolder&) = delete;
	TemporaryFolder& operator=(const TemporaryFolder&) = delete;

	const std::string& Path() const { return path; }
	std::string File(const std::string& name) const { return path + "/" + name; }

private:
	std::string path;
};

}

#endif
