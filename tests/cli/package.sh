#!/bin/sh
# SPDX-License-Identifier: AGPL-3.0-or-later
#
# The Debian package without installing it: it is packed from the build folder, shares no file with the distribution's
# povray, and its programs run by their links from wherever it is unpacked. (package_in_clean_root.sh installs it.)
#
#   package.sh BUILD CPACK WORK
#
# Exits 77 (skipped) where there is no dpkg.
set -u
build=$1 cpack=$2 work=$3
rm -rf "$work" && mkdir -p "$work/run" && cd "$work" || exit 99

fail() { echo "FAILED: $*"; exit 1; }
# run COMMAND...: as a user with an empty environment, in a folder of its own; the output goes to run.log.
run() {
	(cd run && env -i PATH=/usr/bin:/bin HOME="$work/run" "$@") > run.log 2>&1 < /dev/null ||
		fail "$*: exit code $?: $(tr '\r' '\n' < run.log | tail -8)"
}

command -v dpkg-query > /dev/null || { echo "skipped: not Debian or one of its relatives"; exit 77; }
for tool in dpkg-deb dpkg-shlibdeps file gzip; do
	command -v $tool > /dev/null || fail "no $tool; cmake/setup.sh installs what packaging needs"
done
# gzip instead of xz: what is tested here is what is inside.
"$cpack" --config "$build/CPackConfig.cmake" -B "$work" -D CPACK_DEBIAN_COMPRESSION_TYPE=gzip > cpack.log 2>&1 ||
	fail "cpack: $(tail -5 cpack.log)"
deb=$(echo povray-tilt_*.deb)
[ -f "$deb" ] || fail "cpack made no package"

# No file of the distribution's packages; folders are shared by nature.
dpkg-deb --fsys-tarfile "$deb" | tar -t | sed -n 's,^\.\(/.*[^/]\)$,\1,p' | sort > ours
dpkg -L povray povray-includes | sort -u | while read -r path; do [ -d "$path" ] || echo "$path"; done > theirs
[ -s ours ] && [ -s theirs ] || fail "an empty list of files; is the distribution's povray installed?"
comm -12 ours theirs > both
[ ! -s both ] || fail "files of the distribution's povray: $(cat both)"
for file in /usr/bin/povray-tilt /usr/bin/tiltcal /usr/bin/tiltcost /usr/bin/povray-strips /usr/bin/tiltcal-batch /etc/povray-tilt/povray.conf \
	/usr/share/doc/povray-tilt/README.md /usr/share/doc/povray-tilt/REFERENCE.md /usr/share/povray-tilt/include/tilt_lens.inc /usr/share/doc/povray-tilt/povray-patch/TILT-LENS-INC.md /usr/share/doc/povray-tilt/calib/CALIBRATING.md \
	/usr/share/doc/povray-tilt/copyright /usr/share/tilt-lens/calibration.schema.json /usr/share/tilt-lens/editors/vim/syntax/pov.vim /usr/share/tilt-lens/editors/vscode/package.json /usr/share/doc/povray-tilt/tests/cli/outside/tilts.cpp \
	/usr/lib/povray-tilt/lib/libtiltcal.so /usr/lib/povray-tilt/lib/cmake/tiltcal/tiltcalConfig.cmake /usr/lib/povray-tilt/include/tilt-lens/tiltcal/calibrate.h; do
	grep -qx "$file" ours || fail "$file is not in the package"
done

# Everything that is linked is a dependency; the configuration is known as such.
dpkg-deb --field "$deb" Depends > depends
for library in libc6 libopencv-calib3d libopenexr libboost-thread libsdl1.2debian; do
	grep -q "$library" depends || fail "does not depend on $library: $(cat depends)"
done
dpkg-deb --info "$deb" conffiles > conffiles
grep -qx /etc/povray-tilt/povray.conf conffiles || fail "povray.conf is not marked as a configuration file"

dpkg-deb --extract "$deb" root
# The one absolute link, which leads nowhere until the package is installed: here by way of the folder.
link=root/usr/lib/povray-tilt/etc/povray/3.7
[ "$(readlink "$link")" = /etc/povray-tilt ] || fail "$link does not lead to /etc/povray-tilt"
ln -sfn "$work/root/etc/povray-tilt" "$link"
bin=$work/root/usr/bin
examples=$work/root/usr/share/doc/povray-tilt/examples
for program in "$bin"/*; do
	gzip -t "$work/root/usr/share/man/man1/$(basename "$program").1.gz" || fail "no man page of $program"
done

run "$bin/tiltcal" --version
version=$(dpkg-deb --field "$deb" Version)
[ "$(cat run.log)" = "tiltcal $version" ] || fail "tiltcal says '$(cat run.log)', the package $version"
run "$bin/tiltcal" target --board 6x5 --square 20 --out board.pdf
[ -s run/board.pdf ] || fail "no board.pdf"

# Its include files are those of the package: with them away, nothing else is found.
cat > run/scene.pov <<'END'
#version 3.7;
#include "colors.inc"
#include "tilt_lens.inc"
global_settings { assumed_gamma 1 }
camera { tilt_lens { aperture_diameter 0.3 TL_Focus_Pull(5, 9, 0) } location -5*z look_at 0 }
sphere { 0, 1 pigment { Red } finish { emission 1 } }
END
run "$bin/povray-tilt" scene.pov +W40 +H30 -D
! grep -Eq 'cannot open (the system|an INI)' run.log || fail "povray-tilt misses its configuration: $(cat run.log)"
run "$bin/povray-tilt" "$examples/first-tilt/first-tilt.pov" "+L$examples/first-tilt" +W48 +H27 -D
run "$bin/tiltcost" scene.pov +W96 +H72 +WT1 --pilot-time 0.3s --error 0.02
grep -q '^blur_samples' run.log || fail "tiltcost answers nothing: $(cat run.log)"
mv root/usr/share/povray-tilt away
! (cd run && env -i PATH=/usr/bin:/bin HOME="$work/run" "$bin/povray-tilt" scene.pov +W40 +H30 -D) > run.log 2>&1 < /dev/null ||
	fail "povray-tilt takes its include files from elsewhere"
grep -q "Cannot open include file colors.inc" run.log || fail "povray-tilt fails for another reason: $(cat run.log)"
echo "all well: $deb, $(wc -l < ours) files and links"
cd / && rm -rf "$work"
