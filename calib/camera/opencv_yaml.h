// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Cameras as OpenCV's calibration sample writes them (cv::FileStorage: YAML or XML by
// suffix): image_width, image_height, camera_matrix, distortion_coefficients.
//
// OpenCV's tilted model (CALIB_TILTED_MODEL, Louhichi et al. 2007; formulas in the
// documentation of calib3d) projects along the lens axis, distorts there, and then tilts
// the sensor: pixel ~ K P(tau) R(tau) (x'', y'', 1), with R = R_y(tauY) R_x(tauX), P upper
// triangular. Ours (camera.h) is pixel ~ K0 B (x'', y'', 1) with K0 the untilted matrix
// of w and principal point, and B the lens's axes in the sensor's frame. Both are "upper
// triangular times rotation", which is unique, so
//   R(tau) = B (x, y of the lens frame turned about n, so that R's element (2, 1) is 0),
//   f_x = f_y = w / n_z,   c = principal point + f (n_x, n_y)  (y down).
// OpenCV's camera frame is the lens's, ours is the sensor's: same origin, turned.

#ifndef TILTCAL_OPENCV_YAML_H
#define TILTCAL_OPENCV_YAML_H

#include "camera/state_camera.h"

#include <Eigen/Core>

namespace tiltcal
{

/// A camera in OpenCV's words: K = [f 0 c_x; 0 f c_y; 0 0 1] and k1, k2, p1, p2, k3.
struct OpenCvCamera
{
	double fx = 0, fy = 0;
	Point centre{};
	Distortion distortion{};
	double tau_x = 0, tau_y = 0;   ///< radians
};

/// Exact: both give the same pixel for the same point, x_opencv = OpenCvFromCamera(normal) x_camera.
OpenCvCamera ToOpenCv(const StateCamera& camera);

/// The rotation (and change of handedness) from our camera frame to OpenCV's, for a lens normal n.
Eigen::Matrix3d OpenCvFromCamera(const Vec3<double>& n);

/// Fills image distance (from sqrt(fx fy)), principal point, distortion and tilt of `camera`, which
/// has its pitch. Inverse of ToOpenCv where fx = fy. Focus and aperture become unknown.
void FromOpenCv(const OpenCvCamera& opencv, StateCamera& camera);

/// What is to be written to `file`, by whose suffix it is YAML or XML, with a comment on what OpenCV's model cannot hold; 5 coefficients,
/// 14 for a tilted state. Throws UsageError (suffix).
std::string OpenCvText(const StateCamera& camera, const std::string& file);

/// OpenCvText to `file`. Throws FileError too.
void WriteOpenCv(const StateCamera& camera, const std::string& file);

/// Reads what calibration programs of OpenCV write; 4 to 14 coefficients. `lost_px` receives how far a pixel at
/// the picture's edge moves because fx and fy differ, which our square pixels cannot hold.
/// Throws FileError: unreadable, a key missing. Throws Refused: fx and fy differ by more
/// than half a percent, skew, coefficients that tilt_lens has not (k4..k6, s1..s4).
StateCamera ReadOpenCv(const std::string& file, double pitch_mm, const std::string& state, double& lost_px);

/// What a file of OpenCV does not hold, one sentence.
std::string LostInOpenCv();

}

#endif
