#!/bin/sh
# Writes the commits that stand on top of the tag `upstream` as the patch series,
# one patch a commit, named after its subject.
#
#   git-to-series.sh FOLDER

set -eu
[ $# -eq 1 ] || { echo "usage: git-to-series.sh FOLDER" >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
cd "$1"
rm -f "$here"/patches/*.patch
: > "$here/series"
n=0
for commit in $(git rev-list --reverse upstream..HEAD); do
	n=$((n + 1))
	name=$(git log -1 --format=%f "$commit" | tr '[:upper:]' '[:lower:]' | cut -c1-60)
	patch=$(printf '%04d-%s.patch' "$n" "$name")
	{
		git log -1 --format='Subject: %B' "$commit"
		git diff --no-color --no-ext-diff "$commit~" "$commit" -- | grep -v '^index '
	} > "$here/patches/$patch"
	echo "$patch" >> "$here/series"
done
cat "$here/series"
