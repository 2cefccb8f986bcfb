// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILT_LENS_TESTS_RESOLVED_LENS_H
#define TILT_LENS_TESTS_RESOLVED_LENS_H

#include <string>

#include <gtest/gtest.h>

#include "lens/lens_spec.h"

/// The lens of words that are right.
inline tilt_lens::TiltLens ResolvedFor(const tilt_lens::LensSpec& spec, const tilt_lens::CameraVectors& camera)
{
	tilt_lens::TiltLens lens;
	std::string error;
	EXPECT_TRUE(ResolveTiltLens(spec, camera, lens, error)) << error;
	return lens;
}

/// What is said of words that are not.
inline std::string RefusalFor(const tilt_lens::LensSpec& spec, const tilt_lens::CameraVectors& camera)
{
	tilt_lens::TiltLens lens;
	std::string error;
	EXPECT_FALSE(ResolveTiltLens(spec, camera, lens, error));
	return error;
}

#endif
