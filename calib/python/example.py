# SPDX-License-Identifier: AGPL-3.0-or-later
"""example.py FOLDER: calibrates from the demo's photographs (scenes/boxes/photos/target) and looks through the lens."""
import sys
from pathlib import Path

import numpy as np
import tiltcal

photos = Path(sys.argv[1])
found = tiltcal.calibrate(
	sorted(photos.glob("untilted-*.jpg")), {"plus5": sorted(photos.glob("plus5-*.jpg"))},
	board="12x9", square_mm=25, pitch_mm=0.02, edges_per_photo=40, progress=print)
print(f"{found.model}, {found.grade}: tilt {found.tilt('plus5')[0]:.2f} +- {found.tilt('plus5')[1]:.2f} degrees")

camera = found.camera("plus5")
# What every 100th pixel sees, and where on these rays it is sharp: q.P = 1 is the plane of focus.
pixels = np.stack(np.meshgrid(np.arange(0, camera.width, 100), np.arange(0, camera.height, 100)), axis=-1)
rays = camera.unproject(pixels)                       # (12, 18, 3)
sharp = rays / (rays @ camera.plane_of_focus)[..., None]
print(f"sharp from {sharp[..., 2].min():.0f} to {sharp[..., 2].max():.0f} mm away")
wall = 700 * rays / rays[..., 2:]                     # a wall 700 mm away
print(f"blur on the wall: {camera.blur(wall).min():.1f} to {camera.blur(wall).max():.1f} px")
