// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Rows of PNG and OpenEXR pictures, bit for bit: cut out of a picture, and put together again. What a picture says beside
// its pixels (gamma, text, channels, compression) is that of the first.
//
//   picture_rows cut FIRST LAST IN OUT     rows FIRST .. LAST of IN, 1 at the top
//   picture_rows join HEIGHT OUT PART...   the parts from the top; together they have HEIGHT rows
//
// OUT appears whole or not at all. Exit 0: done, 1: the pictures do not fit, 2: wrong usage, 3: unreadable or unwritable.
#include "cluster/rows_file.h"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <string>
#include <unistd.h>
#include <vector>

namespace
{

using namespace picture_rows;

int Number(const char* text)
{
	char* end = nullptr;
	const long value = std::strtol(text, &end, 10);
	if (end == text || *end || value < 1 || value > 1000000)
		throw Failure(2, std::string("'") + text + "' is no number of rows");
	return int(value);
}

/// To the disk before it gets its name, so that a name stands for a whole picture after a power cut too.
void Publish(const std::string& temporary, const std::string& file)
{
	const int opened = open(temporary.c_str(), O_RDONLY);
	const bool safe = opened >= 0 && fsync(opened) == 0;
	const int code = errno;
	if (opened >= 0)
		close(opened);
	if (!safe)
		throw Failure(3, file + ": cannot be written (" + std::strerror(code) + ")");
	if (std::rename(temporary.c_str(), file.c_str()) != 0)
		throw Failure(3, file + ": cannot be written (" + std::strerror(errno) + ")");
}

/// What is being written, for a job that is cancelled or has used up its time. Set before the handler, and not changed.
std::string unfinished;

void RemoveUnfinished(int signal)
{
	unlink(unfinished.c_str());
	_exit(128 + signal);
}

/// The machine too: another's process may have this number, and write into the same folder.
std::string TemporaryOf(const std::string& file)
{
	char host[256] = {};
	gethostname(host, sizeof(host) - 1);
	return file + "." + host + "." + std::to_string(getpid()) + ".new";
}

void Write(const std::vector<Piece>& pieces, const std::string& file)
{
	const std::string temporary = TemporaryOf(file);
	unfinished = temporary;
	for (const int signal : {SIGTERM, SIGINT, SIGHUP})
		std::signal(signal, RemoveUnfinished);
	try
	{
		if (IsPng(pieces[0].file))
			WritePng(pieces, temporary, file);
		else
			WriteExr(pieces, temporary, file);
		Publish(temporary, file);
	}
	catch (...)
	{
		unlink(temporary.c_str());
		throw;
	}
}

int Run(int argc, char** argv)
{
	const std::string how = argc > 1 ? argv[1] : "";
	std::vector<Piece> pieces;
	if (how == "cut" && argc == 6)
	{
		const int first = Number(argv[2]), last = Number(argv[3]);
		if (last < first)
			throw Failure(2, "the last row is above the first");
		pieces.push_back({argv[4], first - 1, last - first + 1});
		Write(pieces, argv[5]);
		return 0;
	}
	if (how == "join" && argc > 4)
	{
		const int height = Number(argv[2]);
		int sum = 0;
		for (int i = 4; i < argc; ++i)
		{
			pieces.push_back({argv[i], 0, HeightOf(argv[i])});
			sum += pieces.back().rows;
		}
		if (sum != height)
			throw Failure(1, "the parts have " + std::to_string(sum) + " rows together, not " + std::to_string(height));
		Write(pieces, argv[3]);
		return 0;
	}
	throw Failure(2, "usage: picture_rows cut FIRST LAST IN OUT, or picture_rows join HEIGHT OUT PART...");
}

}

int main(int argc, char** argv)
try
{
	std::signal(SIGXFSZ, SIG_IGN);  // a limit of file sizes is a message, not a death
	return Run(argc, argv);
}
catch (const Failure& failure)
{
	std::fprintf(stderr, "picture_rows: %s\n", failure.what());
	return failure.code;
}
catch (const std::exception& error)
{
	std::fprintf(stderr, "picture_rows: %s\n", error.what());
	return 3;
}
