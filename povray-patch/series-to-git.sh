#!/bin/sh
# Opens the patch series as a git repository, one commit a patch, for editing or
# for moving to another POV-Ray version. git-to-series.sh writes it back.
#
#   series-to-git.sh UPSTREAM_ARCHIVE FOLDER

set -eu
[ $# -eq 2 ] || { echo "usage: series-to-git.sh UPSTREAM_ARCHIVE FOLDER" >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
[ ! -e "$2" ] || { echo "$2 exists already" >&2; exit 1; }
mkdir -p "$2"
tar xzf "$1" -C "$2" --strip-components=1
cd "$2"
git init -q .
git config user.name tilt-lens
git config user.email dev@tilt-lens.invalid
git config core.autocrlf false
git add -f source vfe unix
git commit -q -m "upstream"
git tag upstream
grep -v '^#' "$here/series" | while read -r patch; do
	git apply --index "$here/patches/$patch"
	# The text above the first "diff" is the commit message.
	sed '/^diff --git/,$d; s/^Subject: //' "$here/patches/$patch" | git commit -q -F -
done
git log --oneline upstream..HEAD
