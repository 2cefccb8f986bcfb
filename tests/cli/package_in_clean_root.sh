#!/bin/sh
# SPDX-License-Identifier: AGPL-3.0-or-later
#
# The Debian package in a clean root of the machine's own release, made from the machine's own mirror: installed by apt beside
# the distribution's povray, used by a user who is not root, removed without trace.
#
#   package_in_clean_root.sh FOLDER SCENES WORK CACHE
#
# FOLDER holds the package, the newest of its kind is taken. CACHE keeps downloaded packages from one run to the next.
# Exits 77 (skipped) where it may not make a root.
set -eu
folder=$1 scenes=$2 work=$3 cache=$4
if [ "$(id -u)" -ne 0 ]; then
	echo "skipped: needs root, for debootstrap and chroot"
	exit 77
fi
fail() { echo "FAILED: $*"; exit 1; }
deb=$(ls -t "$folder"/povray-tilt_*.deb 2> /dev/null | head -1)
[ -f "$deb" ] || fail "no package in $folder; run cmake --build --preset package"
for tool in debootstrap chroot; do
	command -v $tool > /dev/null || fail "no $tool; cmake/setup.sh installs what packaging needs"
done
root=$work/root
mounted=""
clean() {
	for place in $mounted; do umount "$root/$place" || return; done
	rm -rf "$work"
}
mkdir -p "$cache/archives/partial" "$cache/debootstrap"
for place in proc cache; do ! mountpoint -q "$root/$place" || fail "$root/$place is still mounted; unmount it"; done
rm -rf "$work"
mkdir -p "$root"
trap clean EXIT
trap 'exit 130' INT TERM
say() { echo "$(date +%T) $*"; }

# The archive that offers povray, and its release.
uri=$(apt-cache policy povray | awk '$1 ~ /^[0-9]+$/ && $2 ~ /^[a-z+]+:/ { print $2; exit }')
release=$(. /etc/os-release; echo "${VERSION_CODENAME:-}")
[ -n "$uri" ] && [ -n "$release" ] || fail "apt knows no archive of povray, or the system no name of its release; run apt-get update"
say "debootstrap $release $uri"
debootstrap --variant=minbase --cache-dir="$cache/debootstrap" "$release" "$root" "$uri" > "$work/debootstrap.log" 2>&1 ||
	fail "debootstrap: $(tail -5 "$work/debootstrap.log")"

# The same sources as outside, security updates included.
rm -f "$root/etc/apt/sources.list"
for file in /etc/apt/sources.list.d/*.sources; do
	[ -f "$file" ] || continue
	awk -v RS= -v ORS='\n\n' -v uri="${uri%/}" 'index($0, uri)' "$file" >> "$root/etc/apt/sources.list.d/machine.sources"
done
for file in /etc/apt/sources.list /etc/apt/sources.list.d/*.list; do
	[ -f "$file" ] || continue
	awk -v uri="${uri%/}" '$1 == "deb" && index($0, uri)' "$file" >> "$root/etc/apt/sources.list"
done
cp /etc/resolv.conf /etc/hosts "$root/etc/"
printf '#!/bin/sh\nexit 101\n' > "$root/usr/sbin/policy-rc.d"
chmod 755 "$root/usr/sbin/policy-rc.d"
# Speed, not durability: the root lives for a minute.
echo force-unsafe-io > "$root/etc/dpkg/dpkg.cfg.d/speed"
printf 'Dir::Cache::archives "/cache/archives";\nAPT::Keep-Downloaded-Packages "true";\nBinary::apt-get::APT::Keep-Downloaded-Packages "true";\nAPT::Sandbox::User "root";\n' > "$root/etc/apt/apt.conf.d/99cache"
mkdir -p "$root/cache" "$root/home/tester"
mount --bind "$cache" "$root/cache"; mounted="cache"
mount -t proc proc "$root/proc"; mounted="proc cache"
cp "$deb" "$root/povray-tilt.deb"
chown nobody "$root/home/tester"

inside() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive LC_ALL=C ${http_proxy:+http_proxy="$http_proxy"} "$@"; }
apt() { inside apt-get -q -y --no-install-recommends "$@" > "$work/apt.log" 2>&1 || fail "apt-get $*: $(tail -8 "$work/apt.log")"; }
# user COMMAND...: by nobody, in /home/tester.
user() {
	chroot --userspec=nobody:nogroup "$root" env -i PATH=/usr/bin:/bin HOME=/home/tester LC_ALL=C \
		sh -c 'cd /home/tester && exec "$@"' sh "$@" > "$work/user.log" 2>&1 < /dev/null
}
must() { user "$@" || fail "$*: exit code $?: $(tr '\r' '\n' < "$work/user.log" | tail -8)"; }
# traces: files by the package's names, dpkg's and apt's own records aside.
traces() {
	(cd "$root" && find . -xdev \( -path ./var/lib/dpkg -o -path ./var/lib/apt -o -path ./var/log -o -path ./cache -o -path ./proc \
		-o -path ./home \) -prune -o \( -name '*povray-tilt*' -o -name 'tiltc*' \) ! -path ./povray-tilt.deb -print | sort)
}

say "the distribution's povray"
apt update
apt install povray povray-includes
stock=$(sha256sum < "$root/usr/bin/povray")
must povray --version
cp "$work/user.log" "$work/version-before"
say "povray-tilt"
apt install /povray-tilt.deb
say "installed: $(inside dpkg-query -W -f '${Status} ${Version}\n' povray-tilt), $(inside dpkg-query -W | wc -l) packages in all"

# The stock povray is what it was.
[ "$(sha256sum < "$root/usr/bin/povray")" = "$stock" ] || fail "/usr/bin/povray has changed"
must povray --version
cmp -s "$work/user.log" "$work/version-before" || fail "povray --version says something else than before"
grep -q 'POV-Ray 3\.7\.' "$work/user.log" || fail "povray --version: $(head -3 "$work/user.log")"
tilted=/usr/share/doc/povray-tilt/examples/first-tilt
if user povray $tilted/first-tilt.pov +L$tilted +W48 +H27 -D; then fail "the stock povray knows tilt_lens"; fi
grep -q tilt_lens "$work/user.log" || fail "the stock povray fails for another reason: $(tail -5 "$work/user.log")"
printf '#include "colors.inc"\ncamera { location -5*z look_at 0 }\nsphere { 0, 1 pigment { Red } }\n' > "$root/home/tester/plain.pov"
must povray plain.pov +W40 +H30 -D

say "the package's programs"
cmp -s "$scenes/first-tilt/first-tilt.pov" "$root$tilted/first-tilt.pov" || fail "the example is not the repository's scene"
must povray-tilt $tilted/first-tilt.pov +L$tilted +W96 +H54 -D +Ofirst-tilt.png
grep -q 'Tilt lens' "$work/user.log" || fail "povray-tilt reports no tilted lens"
! grep -Eq 'cannot open (the system|an INI)' "$work/user.log" || fail "povray-tilt misses its configuration"
[ -s "$root/home/tester/first-tilt.png" ] || fail "no picture"
must povray-tilt plain.pov +W40 +H30 -D
must tiltcal --version
must tiltcal --help
must tiltcal target --board 6x5 --square 20 --out board.svg --out board.inc
must tiltcost --help
must tiltcost $tilted/first-tilt.pov +L$tilted +W96 +H54 --pilot-time 0.5s --error 0.02
for page in povray-tilt tiltcal tiltcost; do
	gzip -t "$root/usr/share/man/man1/$page.1.gz" || fail "no man page $page(1)"
done

say "removing"
apt remove povray-tilt
left=$(traces)
[ "$left" = ./etc/povray-tilt ] || fail "after remove (configuration stays until purge): $left"
apt purge povray-tilt
left=$(traces)
[ -z "$left" ] || fail "after purge: $left"
must povray plain.pov +W40 +H30 -D
say "all well"
