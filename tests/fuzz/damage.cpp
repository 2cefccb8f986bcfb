// SPDX-License-Identifier: AGPL-3.0-or-later

#include "damage.h"

#include <zlib.h>

#include <algorithm>

namespace
{

/// A place in the file, half of the time among the first 400 bytes, where headers are.
size_t Place(const std::string& bytes, Random& random)
{
	const size_t end = random.Chance(0.5) ? std::min<size_t>(400, bytes.size()) : bytes.size();
	return static_cast<size_t>(random.Below(int(end)));
}

size_t Length(size_t most, Random& random)
{
	return std::min(most, size_t(1) << random.Below(12));
}

/// One number of 1, 2, 4 or 8 bytes, in either byte order.
void EditNumber(std::string& bytes, Random& random)
{
	static const std::uint64_t extremes[] = { 0, 1, 2, 3, 4, 8, 16, 32, 33, 255, 256, 30000, 32767, 32768, 65535, 65536, 0x7fffffff, 0x80000000, 0xffffffff,
		0xfffffff0, 0x40000000, 200000000, 0x7fffffffffffffff, 0xffffffffffffffff };
	const std::uint64_t value = random.Chance(0.8) ? extremes[random.Below(int(sizeof(extremes) / sizeof(extremes[0])))] : random.Bits();
	const size_t width = size_t(1) << random.Below(4), at = Place(bytes, random);
	const bool big_endian = random.Chance(0.5);
	for (size_t i = 0; i < width && at + i < bytes.size(); ++i)
		bytes[at + i] = static_cast<char>(value >> (8 * (big_endian ? width - 1 - i : i)));
}

void DamageOnce(std::string& bytes, const std::string& other, Random& random)
{
	const size_t at = Place(bytes, random);
	switch (random.Below(12))
	{
	case 0:
	case 6:
	case 7:
		for (int n = 1 + random.Below(3); n > 0; --n)
			bytes[Place(bytes, random)] ^= static_cast<char>(1 << random.Below(8));
		break;
	case 1:
		bytes.resize(at + 1);
		break;
	case 2:
	{
		const size_t from = Place(other, random);
		bytes.insert(at, other, from, Length(other.size() - from, random));
		break;
	}
	case 3:
	{
		const size_t from = Place(bytes, random), length = Length(std::min(bytes.size() - from, bytes.size() - at), random);
		bytes.replace(at, length, bytes.substr(from, length));
		break;
	}
	case 4:
		bytes.erase(at, Length(bytes.size() - 1, random));
		break;
	case 5:
		for (size_t i = at, end = at + Length(bytes.size() - at, random); i < end; ++i)
			bytes[i] = static_cast<char>(random.Bits());
		break;
	default:
		EditNumber(bytes, random);
	}
	if (bytes.empty())
		bytes = "x";
}

/// PNG: 8 bytes, then chunks of length, name, data, CRC-32 of name and data.
void MendPng(std::string& bytes)
{
	const auto byte = [&](size_t i) { return static_cast<unsigned char>(bytes[i]); };
	for (size_t at = 8; at + 12 <= bytes.size();)
	{
		const size_t length = size_t(byte(at)) << 24 | size_t(byte(at + 1)) << 16 | size_t(byte(at + 2)) << 8 | byte(at + 3);
		if (length > bytes.size() - at - 12)
			return;
		const uLong crc = crc32(0, reinterpret_cast<const Bytef*>(bytes.data() + at + 4), static_cast<uInt>(length + 4));
		for (size_t i = 0; i < 4; ++i)
			bytes[at + 8 + length + i] = static_cast<char>(crc >> (24 - 8 * i));
		at += length + 12;
	}
}

}

std::string Damaged(std::string bytes, const std::string& other, Random& random)
{
	const bool png = bytes.compare(0, 4, "\x89PNG") == 0;
	// Mostly one: most files with several are refused at the first.
	for (int n = random.Chance(0.7) ? 1 : 2 + random.Below(3); n > 0; --n)
		DamageOnce(bytes, other, random);
	if (png && random.Chance(0.5))
		MendPng(bytes);
	return bytes;
}
