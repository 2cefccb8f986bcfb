// SPDX-License-Identifier: AGPL-3.0-or-later
//
// A test that writes files: a folder for them, which goes with it.
#pragma once
#include "program/temporary_folder.h"

#include <gtest/gtest.h>

#include <string>

class InTemporaryFolder : public testing::Test
{
protected:
	std::string At(const std::string& name) const { return folder.File(name); }

	const tiltcal::TemporaryFolder folder{ "tiltcal-test" };
};
