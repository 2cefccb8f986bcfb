// SPDX-License-Identifier: AGPL-3.0-or-later

#include "model/picture_view.h"

#include "model/projection.h"

namespace tiltcal
{

namespace
{

/// Whether the ideal point (x, y) is on the branch that holds the lens axis: the polynomial does not turn back on the way there.
bool IsBeforeTheFold(const double* k, double x, double y)
{
	const int STEPS = 64;   // as in tilt_lens::IsInvertible
	for (int i = 1; i <= STEPS; ++i)
	{
		double j[4];
		tilt_lens::DistortJacobian(k, x * i / STEPS, y * i / STEPS, j);
		if (!(j[0] * j[3] - j[1] * j[2] > 0))
			return false;
	}
	return true;
}

bool HasDistortion(const PictureView& view) { return view.distortion != std::array<double, 5>{}; }

Vec3<double> SeenDirection(const PictureView& view, const Point& pixel)
{
	return { (pixel[0] - view.principal_point[0]) / view.w_px, -(pixel[1] - view.principal_point[1]) / view.w_px, 1 };
}

}

std::optional<Point> PixelOf(const PictureView& view, const Vec3<double>& P)
{
	const double depth = Dot(P, view.normal);
	if (!(depth > 0) || !(P.z > 0))
		return std::nullopt;
	const PictureOf<double> picture = MakePicture(view.w_px, view.distortion.data(), view.principal_point.data(), view.normal);
	if (HasDistortion(view) && !IsBeforeTheFold(view.distortion.data(), Dot(P, picture.basis.a) / depth, -Dot(P, picture.basis.b) / depth))
		return std::nullopt;
	Point pixel;
	picture.Project(P, pixel.data());
	return pixel;
}

std::optional<Vec3<double>> DirectionOf(const PictureView& view, const Point& pixel)
{
	const Vec3<double> v = SeenDirection(view, pixel);
	if (!HasDistortion(view))
		return v;
	const double depth = Dot(v, view.normal);
	if (!(depth > 0))
		return std::nullopt;
	const tilt_lens::LensBasis<double> basis = tilt_lens::BasisOfLensPlane(view.normal);
	const double X = Dot(v, basis.a) / depth, Y = -Dot(v, basis.b) / depth;
	double x = X, y = Y;
	if (!tilt_lens::Undistort(view.distortion.data(), X, Y, x, y) || !IsBeforeTheFold(view.distortion.data(), x, y))
		return std::nullopt;
	return depth * (x * basis.a - y * basis.b + view.normal);
}

std::optional<Point> FirstFold(const PictureView& view, int width, int height)
{
	const int STEPS = 32;
	const double BEYOND = 1.01;
	for (int j = 0; j <= STEPS; ++j)
		for (int i = 0; i <= STEPS; ++i)
		{
			const Point pixel{ 0.5 * (width - 1) + BEYOND * width * (double(i) / STEPS - 0.5), 0.5 * (height - 1) + BEYOND * height * (double(j) / STEPS - 0.5) };
			if (Dot(SeenDirection(view, pixel), view.normal) > 0 && !DirectionOf(view, pixel))
				return pixel;
		}
	return std::nullopt;
}

}
