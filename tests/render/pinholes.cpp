// SPDX-License-Identifier: AGPL-3.0-or-later

#include "pinholes.h"
#include "support/run_povray.h"

#include <fstream>
#include <future>

namespace fs = std::filesystem;

namespace
{

constexpr double PI = 3.14159265358979323846;
// POV-Ray sleeps through most of a short frame, hence more processes than cores. An even number, for the two halves.
constexpr int PROCESSES = 16;

// The camera's axes in the world, as POV-Ray's location, look_at and sky (y) mean them. Left-handed.
std::array<Vector, 3> Axes(const Camera& camera)
{
	const Vector z = Unit(Plus(camera.look_at, Times(camera.location, -1)));
	const Vector x = Unit(Cross({0, 1, 0}, z));
	return {x, Cross(z, x), z};
}

std::string Placement(const Camera& camera)
{
	std::string matrix = "matrix <";
	for (const Vector& v : Axes(camera))
		matrix += Sdl(v[0]) + ", " + Sdl(v[1]) + ", " + Sdl(v[2]) + ", ";
	const Vector& at = camera.location;
	return matrix + Sdl(at[0]) + ", " + Sdl(at[1]) + ", " + Sdl(at[2]) + "> ";
}

// The viewing window: direction, right, up.
std::array<Vector, 3> Window(const Camera& camera)
{
	const double depth = camera.angle > 0 ? ASPECT / 2 / std::tan(Radians(camera.angle) / 2) : camera.image_distance;
	return {Vector{camera.centre_x, camera.centre_y, depth}, Vector{ASPECT, 0, 0}, Vector{camera.up_x, 1, 0}};
}

// van der Corput's sequence: Halton's, one base per dimension.
double RadicalInverse(int base, int i)
{
	double value = 0, digit = 1.0 / base;
	for (; i > 0; i /= base, digit /= base)
		value += digit * (i % base);
	return value;
}

// Whether a point of the lens, right and up of its centre, lies within the blades' polygon.
bool WithinBlades(const Camera& camera, double x, double y)
{
	for (int k = 0; k < camera.blades; ++k)
	{
		const double azimuth = Radians(camera.blade_rotation) + (2 * k + 1) * PI / camera.blades;
		if (x * std::sin(azimuth) + y * std::cos(azimuth) > camera.aperture_diameter / 2 * std::cos(PI / camera.blades))
			return false;
	}
	return true;
}

// Points that fill the lens evenly, one a frame.
std::vector<Vector> LensPoints(const Camera& camera, int frames)
{
	const Lens lens = LensOf(camera);
	const Vector first = camera.blades > 0 ? Vector{1, 0, 0} : Unit(Cross(lens.n, {0.36, 0.48, 0.8}));
	const Vector second = Cross(lens.n, first);
	std::vector<Vector> points;
	for (int i = 1; int(points.size()) < frames; ++i)
	{
		const double radius = camera.aperture_diameter / 2 * std::sqrt(RadicalInverse(2, i)), turn = 2 * PI * RadicalInverse(3, i);
		const double x = radius * std::cos(turn), y = radius * std::sin(turn);
		if (WithinBlades(camera, x, y))
			points.push_back(Plus(Times(first, x), Times(second, y)));
	}
	return points;
}

// The shift inside the pixel makes the mean a box filter over it, as the camera's own samples are.
std::array<Vector, 3> WindowOfFrame(const Camera& camera, int i)
{
	const auto [centre, right, up] = Window(camera);
	return {Plus(centre, Plus(Times(right, (RadicalInverse(5, i) - 0.5) / WIDTH), Times(up, (RadicalInverse(7, i) - 0.5) / HEIGHT))), right, up};
}

// The pinhole camera of frame i (from 1 on) through lens point S in one colour: location, direction, right, up, in
// the camera's own frame.
std::array<Vector, 4> Pinhole(const Camera& camera, int colour, const Vector& S, int i)
{
	const Lens lens = LensOf(camera, colour);

	const auto [direction, right, up] = WindowOfFrame(camera, i);
	// A colour whose image is larger shows less of the scene: across the lens axis by that much.
	const auto L = [&](const Vector& v) {
		const Vector along = Times(lens.n, Dot(v, lens.n));
		return Plus(along, Times(Plus(v, Times(along, -1)), 1 / (1 + camera.lateral[colour])));
	};
	const auto M = [&](const Vector& v) { return Plus(L(v), Times(S, -Dot(lens.q, L(v)))); };
	return {S, M(direction), M(right), M(up)};
}

// The second rim as a thing of the scene, in the camera's own frame: seen directly only, black, and wide.
std::string Rim(const Camera& camera)
{
	if (camera.rim_radius == 0)
		return "";
	const Vector n = LensOf(camera).n;
	return "disc { " + Sdl(Times(n, camera.rim_distance)) + ", " + Sdl(n) + ", 50, " + Sdl(camera.rim_radius) +
		" pigment { rgb 0 } finish { ambient 0 diffuse 0 } no_shadow no_reflection " + Placement(camera) + camera.moves + " }\n";
}

// A rim behind the lens cannot be a thing of the scene, where light goes from the pinhole on. It keeps back what on its way from
// the lens point to the sensor crosses its plane outside of it: straight lines in the world.
void KeepBackBehind(const Camera& camera, const Vector& S, int i, Picture& picture)
{
	if (camera.rear_radius == 0)
		return;
	const Vector centre = InWorld(camera, {0, 0, 0}), from = InWorld(camera, S), n = LensOf(camera).n;
	const Vector axis = Plus(InWorld(camera, n), Times(centre, -1)), rim = Plus(centre, Times(axis, -camera.rear_distance));
	const auto [direction, right, up] = WindowOfFrame(camera, i);
	for (int y = 0; y < HEIGHT; ++y)
		for (int x = 0; x < WIDTH; ++x)
		{
			// The window, turned about the lens centre, is the sensor.
			const Vector v = Plus(direction, Plus(Times(right, (x + 0.5) / WIDTH - 0.5), Times(up, 0.5 - (y + 0.5) / HEIGHT)));
			const Vector way = Plus(InWorld(camera, Times(v, -1)), Times(from, -1));
			const double share = Dot(axis, Plus(rim, Times(from, -1))) / Dot(axis, way);
			const Vector off = Plus(Plus(from, Times(way, share)), Times(rim, -1));
			if (Dot(off, off) > camera.rear_radius * camera.rear_radius)
				for (std::size_t c = 0; c < 3; ++c)
					picture.rgb[3 * std::size_t(y * WIDTH + x) + c] = 0;
		}
}

// The sum of a batch of pinhole pictures, rendered as one animation in a folder of its own.
Picture SumOfPinholes(const Camera& camera, int colour, const fs::path& scene, const fs::path& work, const std::string& stock,
	const std::vector<Vector>& lens_points, int first, int frames)
{
	fs::create_directories(work);
	std::ofstream file(work / "frames.pov");
	file << "#include \"" << scene.string() << "\"\n" << Rim(camera) << "#declare Frames = array[" << frames << "][4] {\n";
	for (int i = first; i < first + frames; ++i)
	{
		const auto frame = Pinhole(camera, colour, lens_points[std::size_t(i - 1)], i);
		file << "\t{" << Sdl(frame[0]) << ", " << Sdl(frame[1]) << ", " << Sdl(frame[2]) << ", " << Sdl(frame[3]) << "},\n";
	}
	file << "}\n#declare F = frame_number - 1;\ncamera { perspective location Frames[F][0] direction Frames[F][1]"
			" right Frames[F][2] up Frames[F][3] " << Placement(camera) << camera.moves << " }\n";
	file.close();
	RunPovray(stock, work, "frames.pov", "frame.exr", WIDTH, HEIGHT, {"+KFI1", "+KFF" + std::to_string(frames)});
	Picture sum;
	const int digits = int(std::to_string(frames).size());
	for (int i = 1; i <= frames; ++i)
	{
		std::ostringstream name;
		name << "frame" << std::setw(digits) << std::setfill('0') << i << ".exr";
		Picture picture = ReadExr((work / name.str()).string());
		fs::remove(work / name.str());
		KeepBackBehind(camera, lens_points[std::size_t(first + i - 2)], first + i - 1, picture);
		if (i == 1)
			sum = picture;
		else
			for (std::size_t k = 0; k < sum.rgb.size(); ++k)
				sum.rgb[k] += picture.rgb[k];
	}
	return sum;
}

}

// povray-patch/lens/MODEL.md. The plane recedes towards (sin phi, cos phi); the lens normal follows from n/f = q + e_z/w.
Lens LensOf(const Camera& camera, int colour)
{
	// A colour for which the lens has more power: n/f grows along n, and q with it.
	if (camera.axial[colour] != 0)
	{
		Camera green = camera;
		green.axial[colour] = 0;
		const Lens lens = LensOf(green, colour);
		return {Plus(lens.q, Times(lens.n, camera.axial[colour])), lens.n};
	}
	const double phi = Radians(camera.tilt_direction), tilt = Radians(camera.tilt);
	const double U = camera.focal_distance, w = camera.image_distance;
	if (camera.tilts_lens)
	{
		const Vector n{-std::sin(phi) * std::sin(tilt), -std::cos(phi) * std::sin(tilt), std::cos(tilt)};
		const double s = (1 / U + 1 / w) / n[2];
		return {Plus(Times(n, s), {0, 0, -1 / w}), n};
	}
	Vector q = Times({-std::sin(phi) * std::tan(tilt), -std::cos(phi) * std::tan(tilt), 1}, 1 / U);
	if (camera.in_world)
	{
		// normal.(location + P) = normal.point, in the camera's frame.
		const auto [x, y, z] = Axes(camera);
		const double distance = Dot(camera.normal, Plus(camera.point, Times(camera.location, -1)));
		q = Times({Dot(camera.normal, x), Dot(camera.normal, y), Dot(camera.normal, z)}, 1 / distance);
	}
	return {q, Unit(Plus(q, {0, 0, 1 / w}))};
}

Vector InWorld(const Camera& camera, const Vector& point)
{
	const auto [x, y, z] = Axes(camera);
	return Plus(camera.location, Plus(Times(x, point[0]), Plus(Times(y, point[1]), Times(z, point[2]))));
}

int Seen(const Camera& camera, int x, int y)
{
	const Vector n = LensOf(camera).n;
	const auto [centre, right, up] = Window(camera);
	int corners = 0;
	for (int dx : {0, 1})
		for (int dy : {0, 1})
		{
			const Vector v = Plus(centre, Plus(Times(right, double(x + dx) / WIDTH - 0.5), Times(up, 0.5 - double(y + dy) / HEIGHT)));
			corners += Dot(n, v) > 0;
		}
	return corners == 4 ? 1 : corners == 0 ? -1 : 0;
}

// The mean, and from the difference of its two halves the error that it may have itself. The halves follow each other
// in Halton's sequence; odd and even would be the inner and the outer half of the lens.
static Picture MeanInColour(const Camera& camera, int colour, const fs::path& scene, const fs::path& work, const std::string& stock,
	int frames, double& standard_error)
{
	const std::vector<Vector> lens_points = LensPoints(camera, frames);
	std::vector<std::future<Picture>> batches;
	for (int b = 0; b < PROCESSES; ++b)
		batches.push_back(std::async(std::launch::async, SumOfPinholes, camera, colour, scene, work / ("batch" + std::to_string(b)),
			stock, lens_points, 1 + b * (frames / PROCESSES), frames / PROCESSES));
	Picture halves[2];
	for (int b = 0; b < PROCESSES; ++b)
	{
		const Picture sum = batches[std::size_t(b)].get();
		Picture& half = halves[2 * b / PROCESSES];
		if (half.rgb.empty())
			half = {sum.width, sum.height, std::vector<double>(sum.rgb.size(), 0.0), {}};
		for (std::size_t k = 0; k < sum.rgb.size(); ++k)
			half.rgb[k] += sum.rgb[k] * 2 / frames;
	}
	standard_error = RmsDifference(halves[0], halves[1]) / 2;
	for (std::size_t k = 0; k < halves[0].rgb.size(); ++k)
		halves[0].rgb[k] = (halves[0].rgb[k] + halves[1].rgb[k]) / 2;
	return halves[0];
}

// A camera whose lens treats colours differently takes one mean for each.
Picture MeanOfPinholes(const Camera& camera, const fs::path& scene, const fs::path& work, const std::string& stock,
	int frames, double& standard_error)
{
	if (camera.Splits())
	{
		Picture all;
		for (int colour = 0; colour < 3; ++colour)
		{
			const Picture one = MeanInColour(camera, colour, scene, work, stock, frames, standard_error);
			if (colour == 0)
				all = one;
			for (std::size_t k = std::size_t(colour); k < all.rgb.size(); k += 3)
				all.rgb[k] = one.rgb[k];
		}
		return all;
	}
	return MeanInColour(camera, 1, scene, work, stock, frames, standard_error);
}

std::string SceneWithTiltLens(const Camera& camera, const fs::path& scene, int samples)
{
	std::string words = camera.words;
	if (words.empty() && camera.in_world)
		words = "focal_plane " + Sdl(camera.point) + ", " + Sdl(camera.normal);
	else if (words.empty())
		words = "focal_distance " + Sdl(camera.focal_distance) + " tilt_direction " + Sdl(camera.tilt_direction) +
			(camera.tilts_lens ? " lens_tilt " : " focal_plane_tilt ") + Sdl(camera.tilt);
	if (camera.words.empty())
		words += " image_distance " + Sdl(camera.image_distance) + " aperture_diameter " + Sdl(camera.aperture_diameter) + " " + camera.effects;

	std::string text;
	if (!camera.scene.empty())
		text = "#declare Oracle_Placement = transform { " + camera.scene + " };\n";
	text += "#include \"" + scene.string() + "\"\ncamera {\n\ttilt_lens { " + words + " }\n\t";
	const bool shears = camera.up_x != 0 || camera.centre_x != 0 || camera.centre_y != 0;
	if (shears) // right, up and direction of an ordinary camera, sheared, and only then put in its place
		text += "location <0, 0, 0> right x * " + Sdl(ASPECT) + " up y direction z * " + Sdl(camera.image_distance) +
			" matrix <1, 0, 0, " + Sdl(camera.up_x) + ", 1, 0, " + Sdl(camera.centre_x / camera.image_distance) + ", " +
			Sdl(camera.centre_y / camera.image_distance) + ", 1, 0, 0, 0> " + Placement(camera);
	else
		text += "location " + Sdl(camera.location) + " right x * " + Sdl(ASPECT) + " up y" +
			(camera.angle > 0 ? " angle " + Sdl(camera.angle) : "") + " look_at " + Sdl(camera.look_at);
	return text + "\n\t" + camera.outside + " " + camera.moves + "\n\tblur_samples " + std::to_string(samples) + " variance 0\n}\n";
}
