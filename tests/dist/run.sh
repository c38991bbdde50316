#!/usr/bin/env bash
# Installs what `make dist` packs in new systems of Debian, renders there, and opens the window.
#
#   tests/dist/run.sh OUT_FOLDER PACKAGES_FOLDER [RELEASE…]
#
# Each system is made once, under OUT_FOLDER, and copied for each package. This needs Debian, and root. The window opens on
# an X server without a screen (Xvfb, xdotool), and is skipped without one.
set -euo pipefail

if [ $# -lt 2 ]; then
	echo "usage: $0 OUT_FOLDER PACKAGES_FOLDER [RELEASE…]" >&2
	exit 2
fi
mkdir -p "$1"
out=$(realpath "$1") packages=$(realpath "$2")
shift 2
[ $# -gt 0 ] || set -- bookworm trixie
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
say() { echo "dist-test: $*"; }
if ! command -v debootstrap >/dev/null || [ "$(id -u)" -ne 0 ]; then
	say 'skipped, it needs debootstrap and root'
	exit
fi
# Debian's archive, as the sources of apt name it.
mirror=$(apt-get indextargets --format '$(SITE)' 'Origin: Debian' 'Identifier: Packages' | head -n 1)
# A scene whose picture is in the repository: README.md has the command that rendered it.
scene=assets/scenes/still_life.toml picture=assets/gallery/still_life.jpg
export NODEVICE_SELECT=1 LC_ALL=C.UTF-8
unset MESA_SHADER_CACHE_DIR XDG_CACHE_HOME

inside() { # ROOT COMMAND…: with the mounts of a running system, which end with the command
	# shellcheck disable=SC2016 # The inner shell expands it.
	HOME=/root PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin unshare --mount bash -c '
		root=$1
		shift
		for folder in proc dev sys; do mount --rbind "/$folder" "$root/$folder" || exit; done
		exec chroot "$root" "$@"' bash "$@"
}

install() { # ROOT ARGUMENT…: by apt-get
	local root=$1
	shift
	inside "$root" env DEBIAN_FRONTEND=noninteractive apt-get --quiet --yes install "$@" >"$root.apt.txt" 2>&1 ||
		{ tail -n 20 "$root.apt.txt" >&2 && return 1; }
	say "$(basename "$root"): $(grep -o '[0-9]* newly installed' "$root.apt.txt")"
}

render() { # ROOT PROGRAM: the picture is that of the repository, but for roundings of the driver
	inside "$1" "$2" doctor >"$1.doctor.txt" 2>&1 || { cat "$1.doctor.txt" >&2 && return 1; }
	cp "$scene" "$1/root"
	cp "$picture" "$1/root/expected.jpg"
	inside "$1" "$2" render /root/still_life.toml --quality 80 --quiet -o /root/picture.jpg
	inside "$1" "$2" compare /root/expected.jpg /root/picture.jpg --tolerance 16 --max-share 0.5 >"$1.compare.txt" ||
		{ cat "$1.compare.txt" >&2 && return 1; }
}

thumbnail() { # ROOT: the command that file managers call makes a small picture
	local command
	cp assets/scenes/lighthouse.{obj,mtl} "$1/root"
	command=$(sed -n 's/^Exec=//p' "$1/usr/share/thumbnailers/glimray.thumbnailer")
	command=${command//%s/128} command=${command//%o//root/thumbnail} command=${command//%i//root/lighthouse.obj}
	# shellcheck disable=SC2086 # A file manager splits it too.
	inside "$1" $command
	inside "$1" glimray compare /root/thumbnail /root/thumbnail | grep -q '^size *128×128 ' ||
		{ say "$(basename "$1"): the thumbnail has another size" >&2 && return 1; }
	say "$(basename "$1"): a thumbnail is made"
}

window() { # ROOT: its window opens
	local display=:$((90 + $$ % 400)) server view found=
	if ! { command -v Xvfb && command -v xdotool; } >/dev/null; then
		say 'window skipped, it needs Xvfb and xdotool' && return
	fi
	Xvfb "$display" -screen 0 1280x800x24 >/dev/null 2>&1 &
	server=$!
	sleep 2
	# shellcheck disable=SC2016 # The inner shell expands it.
	inside "$1" env DISPLAY="$display" sh -c 'echo $$ >/root/pid; exec glimray view /root/still_life.toml' >"$1.view.txt" 2>&1 &
	view=$!
	for _ in $(seq 60); do
		kill -0 "$view" 2>/dev/null || break
		DISPLAY=$display xdotool search --onlyvisible --name glimray >/dev/null 2>&1 && found=yes && break
		sleep 1
	done
	kill "$(cat "$1/root/pid")" 2>/dev/null || true
	wait "$view" || true
	kill "$server"
	wait "$server" || true
	[ -n "$found" ] || { cat "$1.view.txt" >&2 && return 1; }
	say "$(basename "$1"): the window opens"
}

(cd "$packages" && sha256sum --check --quiet SHA256SUMS)
# Files of older versions may lie beside these.
packed() { # ENDING
	echo "$packages/$(sed -n "s/^[0-9a-f]* [ *]\(glimray[-_].*$1\)\$/\1/p" "$packages/SHA256SUMS")"
}
deb=$(packed "_$(dpkg --print-architecture)\.deb") archive=$(packed '-linux-gnu\.tar\.gz')

for release; do
	base=$out/$release
	if [ ! -d "$base" ]; then
		say "$release: making a system"
		rm -rf "$base.part"
		debootstrap --variant=minbase "$release" "$base.part" "$mirror" >"$base.txt" 2>&1 || { tail "$base.txt" >&2 && exit 1; }
		mv "$base.part" "$base"
	fi
	for root in "$base-deb" "$base-archive"; do
		rm -rf "$root"
		cp -a "$base" "$root"
		cp /etc/resolv.conf "$root/etc"
		inside "$root" apt-get --quiet --quiet update
	done

	root=$base-deb
	cp "$deb" "$root/root/glimray.deb"
	install "$root" /root/glimray.deb
	render "$root" glimray
	thumbnail "$root"
	window "$root"
	inside "$root" dpkg --verify glimray
	inside "$root" apt-get --quiet --quiet --yes purge glimray >/dev/null
	left=$(find "$root"/{etc,opt,usr,var} -name '*glimray*')
	[ -z "$left" ] || { say "$release: left behind: $left" >&2 && exit 1; }

	root=$base-archive
	tar -x -f "$archive" -C "$root/opt"
	program=/opt/$(basename "$archive" .tar.gz)/glimray
	# Without a driver it says what to install.
	status=0
	inside "$root" "$program" doctor >"$root.doctor.txt" 2>&1 || status=$?
	if [ "$status" -ne 5 ] || ! grep -q mesa-vulkan-drivers "$root.doctor.txt"; then
		cat "$root.doctor.txt" >&2
		say "$release: doctor without a driver: exit code $status" >&2
		exit 1
	fi
	install "$root" --no-install-recommends mesa-vulkan-drivers
	render "$root" "$program"
	cmp "$base-deb/root/picture.jpg" "$root/root/picture.jpg"
	say "$release: package and archive render the picture with $(sed -n 's/^ *driver //p' "$root.doctor.txt"); largest difference: $(
		sed -n 's/^largest *//p' "$root.compare.txt")"
done

# What desktops read.
entries=$(mktemp -d)
trap 'rm -rf "$entries"' EXIT
dpkg-deb -x "$deb" "$entries"
share=$entries/usr/share
if command -v desktop-file-validate >/dev/null; then desktop-file-validate "$share/applications/glimray.desktop"; fi
# Identifiers of components begin with a domain, and the project has none yet.
if command -v appstreamcli >/dev/null; then
	appstreamcli validate --no-net --override=cid-desktopapp-is-not-rdns=info "$share/metainfo/glimray.metainfo.xml"
fi
if command -v update-mime-database >/dev/null; then
	cp /usr/share/mime/packages/freedesktop.org.xml "$share/mime/packages"
	update-mime-database "$share/mime" >/dev/null 2>&1
	for type in $(sed -n 's/^MimeType=//p' "$share/applications/glimray.desktop" | tr ';' ' '); do
		grep -q ":$type:" "$share/mime/globs2" || { say "$type: no file has this type" >&2 && exit 1; }
	done
fi
say passed
