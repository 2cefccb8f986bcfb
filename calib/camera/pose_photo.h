// SPDX-License-Identifier: AGPL-3.0-or-later
//
// A pose whose points are measured in the photograph itself.

#ifndef TILTCAL_POSE_PHOTO_H
#define TILTCAL_POSE_PHOTO_H

#include "camera/pose.h"

#include <opencv2/core.hpp>

#include <string>
#include <vector>

namespace tiltcal
{

struct PhotoPose
{
	CameraPose pose;
	std::vector<PosePoint> points;         ///< those that the pose was fitted to, with their measured pixels
	/// Lines of those that it was not: outside the picture; no crossing where the camera sees them; one that is something else's.
	std::vector<int> outside, missing, strange;
};

/// Moves every point with a pixel to the crossing of edges nearest to it (find_crossing.h; one that has none near keeps its
/// pixel), fits the pose, looks for the points that are NOWHERE where this camera sees them, and fits again with those it
/// found, until no more are found. One outside the picture, no crossing, or far off the fit (hidden, say) is left out. Blurred ones
/// count less (pose_weights.h), for which it must know the scene's unit.
/// `photo`: linear, as ReadLinear gives it, at the calibrated size. `half`: window of 2 half + 1 px.
/// Throws what SolvePose throws, and UsageError: a photograph of another size.
PhotoPose SolvePoseInPhoto(const StateCamera& camera, const cv::Mat& photo, std::vector<PosePoint> points, int half, const std::string& file, double unit_mm = 1);

/// PoseText, and the lines that were left out.
std::string PhotoPoseText(const PhotoPose& solved);

/// The photograph with every point: where it is, how it was placed, and 20 times the way to where the camera sees it. 8-bit BGR.
cv::Mat DrawPosePoints(const cv::Mat& photo, const PhotoPose& solved);

}

#endif
