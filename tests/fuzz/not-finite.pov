// SPDX-License-Identifier: AGPL-3.0-or-later
// The fuzzer must see this: a sky that is not a number.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { tilt_lens { lens_tilt 5 } location <0, 1, -5> look_at 0 aperture 0.3 blur_samples 16 }
background { rgb 1e308*1e308 - 1e308*1e308 }
sphere { 0, 1 pigment { rgb 0.5 } }
