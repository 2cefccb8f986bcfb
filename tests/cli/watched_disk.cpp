// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Preloaded (LD_PRELOAD) into a program: WATCHED_DISK=FILE receives a line for every fsync ("fsync PATH") and rename ("rename FROM<tab>TO"), in
// their order; where WATCHED_DISK_FAILS=N is set too, the N-th fsync is refused as a broken disk refuses (EIO).

#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <dlfcn.h>
#include <mutex>
#include <string>
#include <unistd.h>

namespace
{

void Note(const std::string& line)
{
	static std::mutex one;
	const std::lock_guard<std::mutex> guard(one);
	if (const char* const file = std::getenv("WATCHED_DISK"))
		if (std::FILE* const out = std::fopen(file, "a"))
		{
			std::fprintf(out, "%s\n", line.c_str());
			std::fclose(out);
		}
}

template<typename Function>
Function Next(const char* name)
{
	return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

}

extern "C" int fsync(int descriptor)
{
	static int count = 0;
	char path[PATH_MAX] = "";
	if (readlink(("/proc/self/fd/" + std::to_string(descriptor)).c_str(), path, sizeof path - 1) < 0)
		path[0] = '\0';
	Note(std::string("fsync ") + path);
	const char* const fails = std::getenv("WATCHED_DISK_FAILS");
	if (fails && ++count == std::atoi(fails))
	{
		errno = EIO;
		return -1;
	}
	return Next<int (*)(int)>("fsync")(descriptor);
}

extern "C" int rename(const char* from, const char* to)
{
	Note(std::string("rename ") + from + "\t" + to);
	return Next<int (*)(const char*, const char*)>("rename")(from, to);
}
