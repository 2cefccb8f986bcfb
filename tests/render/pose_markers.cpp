// SPDX-License-Identifier: AGPL-3.0-or-later
//
// A scene of markers whose pixels OpenCV's tilted sensor model predicts.
//
//   pose_markers make                 writes camera.yml, points.csv and markers.inc here
//   pose_markers check PICTURE LIMIT  exit 0: every marker of PICTURE within LIMIT pixels of points.csv
//
// The camera is rolled and looks along no axis. Nothing of tiltcal is used.

#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>

#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

const int WIDTH = 900, HEIGHT = 600;
const double RADIUS = 2.5;   // world units: some 4 px, so that the picture of a sphere is centred to 0.002 px

/// Scene units are centimetres here; y up, left-handed. OpenCV's world has y negated.
std::vector<cv::Point3d> World()
{
	std::vector<cv::Point3d> points;
	for (int i = 0; i < 4; ++i)
		for (int j = 0; j < 3; ++j)
			points.emplace_back(-180 + 120 * i + 7 * j, -110 + 105 * j - 9 * i, 80 * ((i * 5 + j * 3) % 4) - 60);
	return points;
}

void Make()
{
	const cv::Matx33d K(1180, 0, 441, 0, 1180, 380, 0, 0, 1);
	const std::vector<double> coefficients{ -0.1, 0.05, 0.001, -0.0015, 0, 0, 0, 0, 0, 0, 0, 0, 0.13, -0.07 };
	cv::FileStorage camera("camera.yml", cv::FileStorage::WRITE);
	camera << "image_width" << WIDTH << "image_height" << HEIGHT << "camera_matrix" << cv::Mat(K) << "distortion_coefficients" << cv::Mat(coefficients);
	std::vector<cv::Point3d> mirrored;
	for (const cv::Point3d& p : World())
		mirrored.emplace_back(p.x, -p.y, p.z);
	std::vector<cv::Point2d> pixels;
	cv::projectPoints(mirrored, cv::Vec3d(0.25, -0.35, 0.3), cv::Vec3d(15, -60, 700), K, coefficients, pixels);
	std::ofstream csv("points.csv"), inc("markers.inc");
	csv.precision(12);
	csv << "u_px,v_px,x,y,z\n";
	const std::vector<cv::Point3d> world = World();
	for (size_t i = 0; i < world.size(); ++i)
	{
		const cv::Point3d& p = world[i];
		if (pixels[i].x < 10 || pixels[i].y < 10 || pixels[i].x > WIDTH - 11 || pixels[i].y > HEIGHT - 11)
			throw std::runtime_error("a marker is outside the picture");
		csv << pixels[i].x << ',' << pixels[i].y << ',' << p.x << ',' << p.y << ',' << p.z << '\n';
		inc << "sphere { <" << p.x << ", " << p.y << ", " << p.z << ">, " << RADIUS << " pigment { rgb 1 } finish { emission 1 ambient 0 diffuse 0 } }\n";
	}
	if (!csv.flush() || !inc.flush())
		throw std::runtime_error("cannot write");
}

/// Centre of light within 12 pixels of (u, v).
cv::Point2d Centre(const cv::Mat& picture, double u, double v)
{
	double sum = 0, x = 0, y = 0;
	for (int j = std::max(0, int(v) - 12); j <= std::min(picture.rows - 1, int(v) + 12); ++j)
		for (int i = std::max(0, int(u) - 12); i <= std::min(picture.cols - 1, int(u) + 12); ++i)
		{
			const double light = picture.at<ushort>(j, i);
			sum += light;
			x += light * i;
			y += light * j;
		}
	if (sum == 0)
		throw std::runtime_error("no marker near " + std::to_string(u) + ", " + std::to_string(v));
	return { x / sum, y / sum };
}

bool Check(const std::string& file, double limit)
{
	const cv::Mat picture = cv::imread(file, cv::IMREAD_GRAYSCALE | cv::IMREAD_ANYDEPTH);
	if (picture.empty() || picture.type() != CV_16UC1)
		throw std::runtime_error(file + " is no picture of 16 bits");
	std::ifstream csv("points.csv");
	std::string line;
	std::getline(csv, line);
	double worst = 0;
	int markers = 0;
	while (std::getline(csv, line))
	{
		double u, v;
		if (std::sscanf(line.c_str(), "%lf,%lf", &u, &v) != 2)
			throw std::runtime_error("points.csv: " + line);
		const cv::Point2d found = Centre(picture, u, v);
		worst = std::max(worst, std::hypot(found.x - u, found.y - v));
		++markers;
	}
	std::printf("%d markers, worst %.3f px\n", markers, worst);
	return markers > 0 && worst <= limit;
}

}

int main(int argc, char** argv)
try
{
	const std::string command = argc > 1 ? argv[1] : "";
	if (command == "make" && argc == 2)
		return Make(), 0;
	if (command == "check" && argc == 4)
		return Check(argv[2], std::stod(argv[3])) ? 0 : 1;
	throw std::runtime_error("usage: pose_markers make | check PICTURE LIMIT");
}
catch (const std::exception& error)
{
	std::fprintf(stderr, "pose_markers: %s\n", error.what());
	return 2;
}
