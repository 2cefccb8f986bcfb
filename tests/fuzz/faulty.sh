#!/bin/sh
# SPDX-License-Identifier: AGPL-3.0-or-later
#
# Stands in for POV-Ray where the fuzzer is tested itself: goes wrong as FAULT says.
case "$FAULT" in
	crash) kill -s SEGV $$ ;;
	hang) sleep 60 ;;
	sanitizer) echo "optics.h:1:2: runtime error: 1e+308 is outside the range"; exit 0 ;;
	no-picture) exit 0 ;;
	no-line) echo "Fatal error in parser: Cannot parse input."; exit 1 ;;
	refuse) echo "File 's.pov' line 1: Parse Error: tilt_lens: never."; exit 1 ;;
	wrong-line) echo "File 's.pov' line 999: Parse Error: No matching }"; exit 1 ;;
esac
