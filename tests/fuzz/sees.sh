#!/bin/sh
# SPDX-License-Identifier: AGPL-3.0-or-later
#
# sees.sh PATTERN COMMAND...: whether the command fails with exit code 1 and says what the pattern (grep's) says.
pattern=$1
shift
said=$("$@" 2>&1)
code=$?
printf '%s\n' "$said"
[ $code = 1 ] || { echo "FAILED: exit code $code, not 1"; exit 1; }
printf '%s\n' "$said" | grep -q "$pattern" || { echo "FAILED: it does not say '$pattern'"; exit 1; }
