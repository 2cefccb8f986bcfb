// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The board's corners in photographs against those in renders of the same pose.
//
//   compare_corners PHOTOS.csv RENDERS.csv LIMIT
//
// Both files are `tiltcal detect --csv`: file,column,row,x_px,y_px,sigma_px. Pictures pair by their names without folder
// and suffix. Exit 0: RMS distance of every pair within LIMIT pixels and no picture or corner without partner, 1: not,
// 2: wrong usage or unreadable file.

#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

namespace
{

struct Point
{
	double x, y;
};
using Corners = std::map<std::pair<int, int>, Point>;

std::map<std::string, Corners> Read(const char* path)
{
	std::ifstream file(path);
	std::string line;
	if (!std::getline(file, line) || line.rfind("file,column,row,x_px,y_px", 0) != 0)
		throw std::runtime_error(std::string(path) + " is no list of corners");
	std::map<std::string, Corners> pictures;
	while (std::getline(file, line))
	{
		std::istringstream fields(line);
		std::string name, column, row, x, y;
		std::getline(fields, name, ',');
		std::getline(fields, column, ',');
		std::getline(fields, row, ',');
		std::getline(fields, x, ',');
		std::getline(fields, y, ',');
		pictures[std::filesystem::path(name).stem().string()][{std::stoi(column), std::stoi(row)}] = {std::stod(x), std::stod(y)};
	}
	return pictures;
}

// RMS distance, and in `mean` the mean displacement: a slip of half a pixel shows there.
double Rms(const Corners& photo, const Corners& render, Point& mean)
{
	double sum = 0;
	mean = {0, 0};
	for (const auto& [index, corner] : photo)
	{
		const Point other = render.at(index);
		const double dx = other.x - corner.x, dy = other.y - corner.y;
		sum += dx * dx + dy * dy;
		mean.x += dx / double(photo.size());
		mean.y += dy / double(photo.size());
	}
	return std::sqrt(sum / double(photo.size()));
}

}

int main(int argc, char** argv)
try
{
	if (argc != 4)
		throw std::runtime_error("usage: compare_corners PHOTOS.csv RENDERS.csv LIMIT");
	const auto photos = Read(argv[1]), renders = Read(argv[2]);
	const double limit = std::stod(argv[3]);
	bool good = !photos.empty() && photos.size() == renders.size();
	for (const auto& [name, corners] : photos)
	{
		const auto render = renders.find(name);
		if (render == renders.end() || render->second.size() != corners.size())
		{
			std::printf("%-12s not the same corners in the render\n", name.c_str());
			good = false;
			continue;
		}
		Point mean;
		const double rms = Rms(corners, render->second, mean);
		std::printf("%-12s %3zu corners, RMS distance %.3f px, mean (%+.3f, %+.3f) px%s\n", name.c_str(), corners.size(), rms,
			mean.x, mean.y, rms <= limit ? "" : "  TOO FAR");
		good = good && rms <= limit;
	}
	return good ? 0 : 1;
}
catch (const std::exception& error)
{
	std::fprintf(stderr, "compare_corners: %s\n", error.what());
	return 2;
}
