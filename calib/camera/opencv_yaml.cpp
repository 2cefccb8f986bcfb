// SPDX-License-Identifier: AGPL-3.0-or-later

#include "lens/optics.h"
#include "camera/opencv_yaml.h"

#include <tiltcal/error.h>
#include "base/files.h"
#include "base/plain_text.h"
#include "model/tilt_angles.h"

#include <Eigen/LU>
#include <fmt/format.h>
#include <opencv2/core.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <optional>
#include <sstream>

namespace tiltcal
{

namespace
{

using Eigen::Matrix3d;

/// OpenCV's R(tauX, tauY): columns are its lens axes in the sensor's frame (y down).
Matrix3d TauRotation(double tau_x, double tau_y)
{
	const double cx = std::cos(tau_x), sx = std::sin(tau_x), cy = std::cos(tau_y), sy = std::sin(tau_y);
	Matrix3d rx, ry;
	rx << 1, 0, 0, 0, cx, sx, 0, -sx, cx;
	ry << cy, 0, -sy, 0, 1, 0, sy, 0, cy;
	return ry * rx;
}

/// The same for the axes that Project distorts in (BasisOfLensPlane).
Matrix3d LensAxes(const Vec3<double>& n)
{
	const tilt_lens::LensBasis<double> basis = tilt_lens::BasisOfLensPlane(n);
	Matrix3d axes;
	axes << basis.a.x, -basis.b.x, n.x,
		-basis.a.y, basis.b.y, -n.y,
		basis.a.z, -basis.b.z, n.z;
	return axes;
}

/// The tangential terms are a vector in the lens plane, (p2, p1); `turn` takes its lens axes to others.
Distortion Turned(const Distortion& d, const Matrix3d& turn)
{
	const Eigen::Vector2d t = turn.topLeftCorner<2, 2>() * Eigen::Vector2d(d[3], d[2]);
	return { d[0], d[1], t[1], t[0], d[4] };
}

struct Tau
{
	double x, y;
};

Tau TauOfNormal(const Vec3<double>& n) { return { std::atan2(-n.y, std::hypot(n.x, n.z)), std::atan2(-n.x, n.z) }; }

/// Poses and all, the sample's file has some 100 kB.
const size_t MOST_BYTES = 16 << 20;

/// OpenCV's parsers call themselves for each list in a list, until the stack is full; its own files have three.
const int MOST_NESTED = 200;

/// Of a matrix; the largest that is read has 14.
const int MOST_ROWS = 100;

void CheckNesting(const std::string& text, const std::string& file)
{
	int brackets = 0, tags = 0, lead = 0;
	bool leading = true;
	for (size_t i = 0; i < text.size(); ++i)
	{
		const char c = text[i], next = i + 1 < text.size() ? text[i + 1] : ' ';
		brackets = std::max(0, brackets + (c == '[' || c == '{') - (c == ']' || c == '}'));
		tags = std::max(0, tags + (c == '<' && (std::isalpha(static_cast<unsigned char>(next)) || next == '_')) - (c == '<' && next == '/'));
		// Blocks of YAML: by indentation, or by dashes in one line.
		leading = c == '\n' || (leading && std::strchr(" \t-?:", c));
		lead = leading && c != '\n' ? lead + 1 : 0;
		if (brackets > MOST_NESTED || tags > MOST_NESTED || lead > MOST_NESTED)
			throw FileError(fmt::format("{}: has lists in lists in lists, {} deep; give the file that OpenCV's calibration sample writes", file, MOST_NESTED));
	}
}

/// Where the tag that begins at `at` ends, behind its >; none: nowhere. What is quoted may hold one.
std::optional<size_t> EndOfTag(const std::string& text, size_t at)
{
	if (text.compare(at, 4, "<!--") == 0)
	{
		const size_t end = text.find("-->", at + 4);
		return end == std::string::npos ? std::nullopt : std::optional(end + 3);
	}
	char quote = 0;
	for (size_t i = at; i < text.size(); ++i)
		if (quote ? text[i] == quote : text[i] == '"' || text[i] == '\'')
			quote = quote ? 0 : text[i];
		else if (text[i] == '>' && !quote)
			return i + 1;
	return std::nullopt;
}

/// OpenCV's XML parser reads on where a text ends within a tag.
void CheckTags(const std::string& text, const std::string& file)
{
	size_t last = 0;
	for (size_t at = 0; (at = text.find('<', last)) != std::string::npos;)
		if (const std::optional<size_t> end = EndOfTag(text, at))
			last = *end;
		else
			throw FileError(fmt::format("{}: is cut off or damaged: a tag of its XML does not end; copy it again", file));
	const std::string whole = "</opencv_storage>";
	if (last < whole.size() || text.compare(last - whole.size(), whole.size(), whole) != 0)
		throw FileError(fmt::format("{}: is cut off, or not OpenCV's: it does not end with {}", file, whole));
}

/// OpenCV's YAML parser does not come back from some texts with a line that is indented less than its document's first; a first one at the margin leaves no room for such.
void CheckMargin(const std::string& text, const std::string& file)
{
	std::istringstream lines(text);
	bool first = true;
	std::string line;
	for (int number = 1; std::getline(lines, line); ++number)
	{
		const bool begins = line.compare(0, 3, "---") == 0, ends = line.compare(0, 3, "...") == 0;
		const size_t content = line.find_first_not_of(" \t", begins || ends ? 3 : 0);
		first = first || begins || ends;
		if (!first || content == std::string::npos || line[content] == '#' || line[0] == '%')
			continue;
		if (content > 0)
			throw FileError(fmt::format("{}, line {}: the first key of its YAML is not at the beginning of a line; give the file that OpenCV's calibration sample writes", file, number));
		first = false;
	}
}

/// For a comment of YAML, where nothing may end the line, and of XML, which has no -- in it.
std::string CommentLine(const std::string& text)
{
	std::string out = OneLine(text);
	for (size_t at = 0; (at = out.find("--", at)) != std::string::npos;)
		out.insert(at + 1, " ");
	return out;
}

/// FileStorage takes the format from the suffix.
void CheckSuffix(const std::string& option, const std::string& file)
{
	const std::string suffix = std::filesystem::path(file).extension().string();
	if (suffix != ".yml" && suffix != ".yaml" && suffix != ".xml")
		throw UsageError(fmt::format("{} {}: the suffix says the format: .yml, .yaml or .xml", option, file));
}

cv::Mat ReadMatrix(const cv::FileStorage& in, const std::string& file, const std::string& key, const char* shape)
{
	cv::Mat m;
	try
	{
		// OpenCV makes room for what they say before it looks at what there is.
		const cv::FileNode node = in[key], rows = node["rows"], columns = node["cols"];
		if (rows.isInt() && columns.isInt() && int(rows) > 0 && int(rows) <= MOST_ROWS && int(columns) > 0 && int(columns) <= MOST_ROWS)
			node >> m;
	}
	catch (const cv::Exception&)
	{
		m.release();
	}
	if (m.empty() || m.channels() != 1)
		throw FileError(fmt::format("{}: {} is missing or no matrix (!!opencv-matrix) of {}; give the file that OpenCV's calibration sample writes", file, key, shape));
	cv::Mat real;
	m.convertTo(real, CV_64F);
	if (!cv::checkRange(real))
		throw FileError(fmt::format("{}: {} holds a number that is not finite", file, key));
	return real;
}

int ReadSize(const cv::FileStorage& in, const std::string& file, const std::string& key)
{
	const cv::FileNode node = in[key];
	if (!node.isInt() || int(node) < 1 || int(node) > MOST_PIXELS_A_SIDE)
		throw FileError(fmt::format("{}: {} is missing or no number of pixels; add it, such as '{}: 1800'", file, key, key));
	return int(node);
}

void ReadCameraMatrix(const cv::Mat& K, const std::string& file, OpenCvCamera& c)
{
	if (K.rows != 3 || K.cols != 3)
		throw FileError(fmt::format("{}: camera_matrix is {}x{}, not 3x3", file, K.rows, K.cols));
	c.fx = K.at<double>(0, 0);
	c.fy = K.at<double>(1, 1);
	c.centre = { K.at<double>(0, 2), K.at<double>(1, 2) };
	if (!(c.fx > 0 && c.fy > 0))
		throw Refused(fmt::format("{}: camera_matrix has focal lengths {} and {}, not above 0", file, c.fx, c.fy));
	if (K.at<double>(0, 1) != 0 || K.at<double>(1, 0) != 0 || K.at<double>(2, 0) != 0 || K.at<double>(2, 1) != 0 || K.at<double>(2, 2) != 1)
		throw Refused(fmt::format("{}: camera_matrix is not [fx 0 cx; 0 fy cy; 0 0 1]: tilt_lens has no skew", file));
	if (std::abs(c.fx / c.fy - 1) > 0.005)
		throw Refused(fmt::format("{}: fx {:.2f} and fy {:.2f} differ by more than half a percent: tiltcal's pixels are square; calibrate with CALIB_FIX_ASPECT_RATIO",
			file, c.fx, c.fy));
}

void ReadCoefficients(const cv::Mat& all, const std::string& file, OpenCvCamera& c)
{
	const char* const names[] = { "k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6", "s1", "s2", "s3", "s4", "tauX", "tauY" };
	const cv::Mat d = all.reshape(1, 1);
	const int n = d.cols;
	if ((all.rows != 1 && all.cols != 1) || (n != 4 && n != 5 && n != 8 && n != 12 && n != 14))
		throw FileError(fmt::format("{}: distortion_coefficients is {}x{}; OpenCV has 4, 5, 8, 12 or 14", file, all.rows, all.cols));
	for (int k = 5; k < std::min(n, 12); ++k)
		if (d.at<double>(k) != 0)
			throw Refused(fmt::format("{}: distortion_coefficients has {} = {}: tilt_lens knows k1, k2, p1, p2, k3 and the tilt; "
				"calibrate without CALIB_RATIONAL_MODEL and CALIB_THIN_PRISM_MODEL", file, names[k], d.at<double>(k)));
	for (int k = 0; k < std::min(n, 5); ++k)
		c.distortion[static_cast<size_t>(k)] = d.at<double>(k);
	if (n == 14)
	{
		c.tau_x = d.at<double>(12);
		c.tau_y = d.at<double>(13);
		if (!(std::cos(c.tau_x) > 0 && std::cos(c.tau_y) > 0))
			throw Refused(fmt::format("{}: tauX {} and tauY {} are not between -pi/2 and pi/2 (radians)", file, c.tau_x, c.tau_y));
	}
}

}

std::string LostInOpenCv()
{
	return "OpenCV's model has no blur: aperture, plane of focus, field curvature, the lens's own blur, sigmas and the poses are not in the file";
}

Matrix3d OpenCvFromCamera(const Vec3<double>& n)
{
	const Tau tau = TauOfNormal(n);
	return TauRotation(tau.x, tau.y).transpose() * Eigen::Vector3d(1, -1, 1).asDiagonal();
}

OpenCvCamera ToOpenCv(const StateCamera& camera)
{
	const Vec3<double> n = camera.LensNormal();
	const Tau tau = TauOfNormal(n);
	const double f = camera.ImageDistancePx() / n.z;
	return { f, f, { camera.principal_point[0] + f * n.x, camera.principal_point[1] - f * n.y },
		Turned(camera.distortion, TauRotation(tau.x, tau.y).transpose() * LensAxes(n)), tau.x, tau.y };
}

void FromOpenCv(const OpenCvCamera& opencv, StateCamera& camera)
{
	const Matrix3d axes = TauRotation(opencv.tau_x, opencv.tau_y);
	const Vec3<double> n{ axes(0, 2), -axes(1, 2), axes(2, 2) };
	const double f = std::sqrt(opencv.fx * opencv.fy);
	camera.image_distance_mm = f * n.z * camera.pitch_mm;
	camera.principal_point = { opencv.centre[0] - f * n.x, opencv.centre[1] + f * n.y };
	camera.distortion = Turned(opencv.distortion, LensAxes(n).transpose() * axes);
	// Any plane will do that the lens images, such as the one at infinity: its angles are the lens's.
	const double inverse_w = 1 / camera.image_distance_mm;
	const TiltAngles angles = AnglesFromPlane(tilt_lens::PlaneFromLensTilt(n, inverse_w, 0.0), camera.image_distance_mm);
	camera.lens_tilt_deg = angles.lens_tilt;
	camera.tilt_direction_deg = angles.tilt_direction;
	camera.focus_distance_mm = std::numeric_limits<double>::infinity();
	camera.aperture_diameter_mm = 0;
	camera.field_curvature_per_mm = 0;
}

std::string OpenCvText(const StateCamera& camera, const std::string& file)
{
	CheckSuffix("`opencv`", file);
	const OpenCvCamera c = ToOpenCv(camera);
	const cv::Matx33d K(c.fx, 0, c.centre[0], 0, c.fy, c.centre[1], 0, 0, 1);
	cv::Mat coefficients = cv::Mat::zeros(camera.IsTilted() ? 14 : 5, 1, CV_64F);
	for (int k = 0; k < 5; ++k)
		coefficients.at<double>(k) = c.distortion[static_cast<size_t>(k)];
	if (camera.IsTilted())
	{
		coefficients.at<double>(12) = c.tau_x;
		coefficients.at<double>(13) = c.tau_y;
	}
	const Matrix3d rotation = OpenCvFromCamera(camera.LensNormal());
	cv::Matx33d frame;
	for (int r = 0; r < 3; ++r)
		for (int k = 0; k < 3; ++k)
			frame(r, k) = rotation(r, k);
	// In memory: a file's name may hold what FileStorage takes for options.
	cv::FileStorage out(std::filesystem::path(file).extension().string(), cv::FileStorage::WRITE | cv::FileStorage::MEMORY);
	const std::string state = fmt::format("State '{}', by tiltcal {}, model {}.", camera.state, TILTCAL_VERSION, camera.model);
	for (const std::string& line : { state, LostInOpenCv() + ".",
		std::string("The camera frame is the lens's (x right, y down, z along the lens axis): X_opencv = opencv_from_tiltcal X_tiltcal.") })
		out.writeComment(CommentLine(line));
	out << "image_width" << camera.width << "image_height" << camera.height << "camera_matrix" << cv::Mat(K)
		<< "distortion_coefficients" << coefficients << "opencv_from_tiltcal" << cv::Mat(frame);
	return out.releaseAndGetString();
}

void WriteOpenCv(const StateCamera& camera, const std::string& file) { WriteText(file, OpenCvText(camera, file)); }

StateCamera ReadOpenCv(const std::string& file, double pitch_mm, const std::string& state, double& lost_px)
{
	CheckSuffix("IN", file);
	const std::string text = WithUnixLines(ReadText(file, "the YAML or XML file of OpenCV's calibration", MOST_BYTES));
	// OpenCV's XML parser takes one for the end and runs on behind it.
	if (text.find('\0') != std::string::npos)
		throw FileError(fmt::format("{}: is no text: it holds zero bytes", file));
	CheckNesting(text, file);
	const size_t begin = text.find_first_not_of(" \t\n");
	if (begin != std::string::npos && text[begin] == '<')
		CheckTags(text, file);
	else if (begin != std::string::npos && text[begin] != '{')
		CheckMargin(text, file);
	OpenCvCamera c;
	StateCamera camera;
	try
	{
		const cv::FileStorage in(text, cv::FileStorage::READ | cv::FileStorage::MEMORY);
		if (!in.isOpened())
			throw FileError(fmt::format("{}: cannot be read", file));
		camera.width = ReadSize(in, file, "image_width");
		camera.height = ReadSize(in, file, "image_height");
		ReadCameraMatrix(ReadMatrix(in, file, "camera_matrix", "3x3"), file, c);
		ReadCoefficients(ReadMatrix(in, file, "distortion_coefficients", "5x1 or 14x1"), file, c);
	}
	catch (const Error&)
	{
		throw;
	}
	catch (const cv::Exception& e)
	{
		throw FileError(fmt::format("{}: OpenCV cannot read it ({})", file, e.err));
	}
	catch (const std::exception& e)
	{
		throw FileError(fmt::format("{}: OpenCV cannot read it ({})", file, e.what()));
	}
	camera.pitch_mm = pitch_mm;
	camera.model = "opencv";
	FromOpenCv(c, camera);
	camera.state = !state.empty() ? state : camera.IsTilted() ? "tilted" : "untilted";
	// Half the difference of fx and fy acts on either side of the mean, in proportion to the distance from the centre.
	const double reach = std::hypot(std::max(c.centre[0], camera.width - c.centre[0]), std::max(c.centre[1], camera.height - c.centre[1]));
	lost_px = 0.5 * std::abs(c.fx / c.fy - 1) * reach;
	return camera;
}

}
