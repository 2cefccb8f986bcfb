// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What the camera wrote beside the pixels (EXIF 2.3, JEITA CP-3451C). Nominal: the focal
// length is the one engraved, at infinity, in whole millimetres; the f-number is rounded
// to the marked stop. A manual or adapted lens writes nothing, or the last lens's numbers.

#ifndef TILTCAL_EXIF_H
#define TILTCAL_EXIF_H

#include <tiltcal/photo.h>

#include <string>

namespace tiltcal
{

struct PictureFile;

/// Facts of a JPEG, PNG or TIFF; OpenEXR has none. What is absent, damaged or no sensible
/// number is left out; never throws for what is in the file. `width`, pixels, is the decoded
/// picture's: a picture that was scaled or cropped since has another pitch than EXIF says, so none.
PhotographFacts ReadFacts(const PictureFile& picture, int width);

/// The same by name, with the width from EXIF itself. Throws FileError when the file cannot be read.
PhotographFacts ReadFacts(const std::string& file);

/// "Canon EOS 6D, TS-E45mm f/2.8, 45 mm, f/2.8"; what is missing is left out.
std::string Describe(const PhotographFacts& facts);

}

#endif
