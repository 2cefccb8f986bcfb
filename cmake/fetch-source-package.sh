#!/bin/sh
# Downloads a Debian source package without touching the machine's apt settings:
# a temporary deb-src entry is derived from the machine's own sources, and apt
# works on lists of its own in a temporary folder.
#
#   fetch-source-package.sh PACKAGE FOLDER

set -eu
package=$1
folder=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT INT TERM
chmod 755 "$work"
mkdir -p "$work/lists/partial" "$work/cache/archives/partial" "$work/sources"

# The archive that offers the binary package is the one to ask for its source.
uri=$(apt-cache policy "$package" | awk '$1 ~ /^[0-9]+$/ && $2 ~ /^[a-z+]+:/ { print $2; exit }')
if [ -z "$uri" ]; then
	echo "apt knows no package $package; run apt-get update" >&2
	exit 1
fi

# deb822 files: the paragraphs that name that archive, as deb-src.
for file in /etc/apt/sources.list.d/*.sources; do
	[ -f "$file" ] || continue
	grep -v '^#' "$file" | awk -v RS= -v ORS='\n\n' -v uri="${uri%/}" 'index($0, uri)' |
		sed 's/^Types:.*/Types: deb-src/' >> "$work/sources/source.sources"
done
# One-line files: the lines that name it.
for file in /etc/apt/sources.list /etc/apt/sources.list.d/*.list; do
	[ -f "$file" ] || continue
	awk -v uri="${uri%/}" '$1 == "deb" && index($0, uri)' "$file" |
		sed 's/^deb /deb-src /' >> "$work/sources/source.list"
done

set -- -o Dir::Etc::sourcelist=/dev/null -o Dir::Etc::sourceparts="$work/sources" \
	-o Dir::State::lists="$work/lists" -o Dir::Cache="$work/cache" \
	-o Acquire::Retries=2 -o APT::Sandbox::User=root
apt-get "$@" -q update
mkdir -p "$folder"
cd "$folder"
apt-get "$@" -q source --download-only "$package"
