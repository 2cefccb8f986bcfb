// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The inputs of inputs.h for clang's libFuzzer, which follows coverage. TILT_LENS_FUZZ_KIND: json, csv, yml, xml or line.
// `--seeds FOLDER` as the only arguments writes the whole inputs of that kind, to begin with.

#include "inputs.h"

#include "calibrate/quiet.h"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace
{

InputKind kind = InputKind::JSON;
std::string folder;

}

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv)
{
	static const tiltcal::QuietLibraries quiet;
	const char* const name = std::getenv("TILT_LENS_FUZZ_KIND");
	for (const InputKind k : { InputKind::JSON, InputKind::CSV, InputKind::YAML, InputKind::XML, InputKind::LINE })
		if (name && std::strcmp(name, NameOf(k)) == 0)
			kind = k;
	std::string place = (std::filesystem::temp_directory_path() / "libfuzzer-XXXXXX").string();
	if (!mkdtemp(place.data()))
		std::abort();
	folder = place;
	if (*argc != 3 || std::strcmp((*argv)[1], "--seeds") != 0)
		return 0;
	std::filesystem::create_directories((*argv)[2]);
	int n = 0;
	for (const Input& seed : InputSeeds(folder))
		if (seed.kind == kind)
			std::ofstream((*argv)[2] + ("/seed-" + std::to_string(++n)), std::ios::binary) << seed.bytes;
	std::_Exit(n ? 0 : 1);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
	try
	{
		TryInput({ kind, std::string(reinterpret_cast<const char*>(data), size) }, folder);
	}
	catch (const std::exception& e)
	{
		std::fprintf(stderr, "FAILURE: %s\n", e.what());
		std::abort();
	}
	return 0;
}
