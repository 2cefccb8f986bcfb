// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Cameras, and how a person photographs a board with them: boards in the picture, inclined, sharp in one part and blurred
// in another, seeded. The light is that of tests/support/thin_lens_picture.h, which shares nothing with the calibrator.

#ifndef SIMULATED_CAMERA_H
#define SIMULATED_CAMERA_H

#include "support/thin_lens_picture.h"

#include <tiltcal/board.h>

#include <string>
#include <vector>

namespace cameras
{

/// Lengths mm, angles degrees.
struct Camera
{
	std::string name;
	double focal_length = 45, f_number = 2.8, focus_distance = 700;   ///< the latter from the lens; infinity: HUGE_VAL, beyond it: < 0
	int width = 1200, height = 800;
	double pitch = 0.02;
	tiltcal::Board board;                      ///< its size is chosen by SizeOfBoard where it is 0
	std::vector<std::pair<double, double>> tilts;   ///< of the lens, and direction
	double k1 = 0;
	bool shared_poses = false;
	int photos = 5;                            ///< per state
	/// A prescription's file: the photographs are traced through that glass, scaled to the focal length and stopped to the f-number, which
	/// tilts about its stop. Poses are then chosen as for the thin lens; k1 has no meaning. Empty: the thin lens.
	std::string glass{};
	/// Every board is photographed at this f-number too, without moving; 0: not.
	double stopped_to = 0;
	/// How much of the picture the board fills at the plane of focus, where its size is chosen. A large one is in the picture only beyond that plane, a small one on both sides.
	double fill = 0.85;
	/// Of the thin lens, in its own measures: `radius` in radii of the opening at f_number, `distance` in focal lengths.
	std::vector<synthetic::Rim> rims{};
	int lens_points = 800;   ///< of a picture; 300 leave 1e-4 of a blur

	double ImageDistance() const;
	double Aperture() const { return focal_length / f_number; }
};

/// The table: name, and what it is.
std::vector<Camera> AllCameras();

/// So that many can be tried: of no more than so many megapixels, the same sensor in larger pixels, and by fewer points of the lens.
Camera Quick(Camera camera, double megapixels);

/// A camera drawn at random: lens, sensor, focus, board and tilt, all that AllCameras() spans.
Camera RandomCamera(unsigned seed);

/// The middle of the board, mm from its first corner or circle.
Eigen::Vector2d MiddleOf(const tiltcal::Board& board);

/// The scenes of every state, the untilted one first. `seed` chooses the poses. Throws std::runtime_error where no pose
/// keeps the blur measurable.
std::vector<std::vector<synthetic::Scene>> PhotographAll(Camera& camera, unsigned seed);

}

#endif
