#!/usr/bin/env bash
# Packs the program for the platform of this machine: an archive, on Debian and its kin a package too, and their checksums.
#
#   packaging/dist.sh OUT_FOLDER [PROGRAM]    PROGRAM is built if it is not given
#   packaging/dist.sh --archive TARGET        prints the name of the archive for this target of Rust
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

version=$(sed -n 's/^version = "\(.*\)"$/\1/p' Cargo.toml | head -n 1)
folder_for() { echo "glimray-$version-$1"; }
archive_for() {
	case $1 in
		*-windows-*) echo "$(folder_for "$1").zip" ;;
		*) echo "$(folder_for "$1").tar.gz" ;;
	esac
}
case ${1-} in
	'') sed -n 's/^# \{0,1\}//p' "$0" | sed 1d >&2 && exit 2 ;;
	--archive) archive_for "$2" && exit ;;
esac

mkdir -p "$1"
out=$(realpath "$1")
target=$(rustc --version --verbose | sed -n 's/^host: //p')
# Files have the time of the commit, so that equal programs are packed to equal bytes.
SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct 2>/dev/null || date +%s)}
export SOURCE_DATE_EPOCH
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# On Windows the C and C++ runtimes are linked in: not every machine has them.
case $target in *-windows-msvc) export RUSTFLAGS="${RUSTFLAGS-} -C target-feature=+crt-static" ;; esac
program=${2-}
if [ -z "$program" ]; then
	cargo build --release --locked
	program=${CARGO_TARGET_DIR:-target}/release/glimray
fi
[ ! -e "$program.exe" ] || program=$program.exe
[ "$("$program" --version)" = "glimray $version" ] || { echo "$program is not glimray $version." >&2 && exit 1; }

pack=$work/$(folder_for "$target")
mkdir -p "$pack"/{man,completions}
cp "$program" README.md CHANGELOG.md LICENSE-APACHE LICENSE-MIT "$pack"
"$program" man "$pack/man" >"$work/pages"
for shell in bash zsh fish powershell; do "$program" completions "$shell" >"$pack/completions/glimray.$shell"; done
cargo run --quiet --profile ci --locked --package glimray-notices -- "$target" "$pack"
cp "$(rustc --print sysroot)/share/doc/rust/COPYRIGHT-library.html" "$pack/RUST-LICENSES.html"

cp "$pack/glimray.cdx.json" "$out/$(folder_for "$target").cdx.json"
archive=$(archive_for "$target")
rm -f "$out/$archive"
cd "$work"
case $archive in
	# Windows has bsdtar, which writes ZIP archives.
	*.zip) "$(cygpath "$SYSTEMROOT")/System32/tar.exe" -a -c -f "$(cygpath -w "$out/$archive")" "$(folder_for "$target")" ;;
	*)
		fixed=()
		! tar --version | grep -q GNU ||
			fixed=(--sort=name --mtime="@$SOURCE_DATE_EPOCH" --owner=0 --group=0 --numeric-owner '--mode=go=rX,u+rw')
		# An empty list is an error in the Bash of macOS.
		tar -c -f - ${fixed[@]+"${fixed[@]}"} "$(folder_for "$target")" | gzip -9 -n >"$out/$archive"
		;;
esac
cd - >/dev/null

# The package for Debian, Ubuntu and their kin.
if command -v dpkg-deb && command -v dpkg-shlibdeps; then
	architecture=$(dpkg --print-architecture)
	root=$work/root doc=$work/root/usr/share/doc/glimray
	put() { # FILE PATH: with the rights of a file
		install -D -m 644 "$1" "$root/usr/share/$2"
	}
	install -D -s -m 755 "$program" "$root/usr/bin/glimray"
	for page in "$pack"/man/*.1; do put "$page" "man/man1/${page##*/}"; done
	put "$pack/completions/glimray.bash" bash-completion/completions/glimray
	put "$pack/completions/glimray.zsh" zsh/vendor-completions/_glimray
	put "$pack/completions/glimray.fish" fish/vendor_completions.d/glimray.fish
	put assets/desktop/glimray.desktop applications/glimray.desktop
	put assets/desktop/glimray.svg icons/hicolor/scalable/apps/glimray.svg
	put assets/desktop/glimray.png icons/hicolor/256x256/apps/glimray.png
	put assets/desktop/glimray.xml mime/packages/glimray.xml
	put assets/desktop/glimray.thumbnailer thumbnailers/glimray.thumbnailer
	put assets/desktop/glimray.metainfo.xml metainfo/glimray.metainfo.xml
	sed -i "s/@VERSION@/$version/; s/@DATE@/$(date -u -d "@$SOURCE_DATE_EPOCH" +%F)/" "$root/usr/share/metainfo/glimray.metainfo.xml"
	for file in README.md CHANGELOG.md RUST-LICENSES.html THIRD-PARTY-LICENSES.txt glimray.cdx.json; do put "$pack/$file" "doc/glimray/$file"; done
	gzip -9 -n "$root"/usr/share/man/man1/* "$doc"/{CHANGELOG.md,RUST-LICENSES.html,THIRD-PARTY-LICENSES.txt,glimray.cdx.json}
	{
		cat <<-END
			glimray is licensed under MIT or Apache-2.0, at your option. On Debian systems the text of the latter is in
			/usr/share/common-licenses/Apache-2.0. The notices of the crates in the program are in THIRD-PARTY-LICENSES.txt.gz, and
			those of the standard library of Rust in RUST-LICENSES.html.gz.

		END
		cat LICENSE-MIT
	} >"$doc/copyright"
	chmod 644 "$doc/copyright"

	# The libraries that the program is linked with: `dpkg-shlibdeps` reads the control file of a source package.
	mkdir -p "$work/debian" "$root/DEBIAN"
	printf 'Source: glimray\n\nPackage: glimray\nArchitecture: any\n' >"$work/debian/control"
	linked=$(cd "$work" && dpkg-shlibdeps -O root/usr/bin/glimray 2>/dev/null | sed 's/^shlibs:Depends=//')
	(cd "$root" && find usr -type f | LC_ALL=C sort | xargs -d '\n' md5sum >DEBIAN/md5sums)
	# Recommended is what the window loads when it opens (winit, xkbcommon, wayland-client, wgpu); the portal shows its dialogs.
	cat >"$root/DEBIAN/control" <<-END
		Package: glimray
		Version: $version
		Architecture: $architecture
		Maintainer: The glimray authors
		Installed-Size: $(du -k -s "$root/usr" | cut -f 1)
		Depends: $linked, libvulkan1, mesa-vulkan-drivers | vulkan-icd
		Recommends: libegl1, libgl1-mesa-dri, libwayland-client0, libwayland-egl1, libx11-6, libx11-xcb1, libxcb1, libxcursor1, libxi6, libxkbcommon0, libxkbcommon-x11-0
		Suggests: xdg-desktop-portal
		Section: graphics
		Priority: optional
		Description: GPU ray tracer for 3D models and scenes
		 glimray renders glTF, OBJ, PLY and STL models and scenes of its own to
		 pictures and films by path tracing, and shows them in a window with an
		 editor. It runs on any Vulkan driver, also on that of Mesa which needs no
		 GPU, and without a display.
	END
	dpkg-deb --root-owner-group -Zxz --build "$root" "$out/glimray_${version}_$architecture.deb" >/dev/null
	# The oldest C library that has all that the program calls.
	echo "glibc $(objdump -T "$program" | grep -o 'GLIBC_[0-9.]*' | sort -Vu | tail -n 1 | cut -d _ -f 2) or newer"
fi >"$work/told"
tail -n 1 "$work/told"

cd "$out"
if command -v sha256sum >/dev/null; then sum=(sha256sum); else sum=(shasum -a 256); fi
files=(glimray[-_]"$version"[-_]*)
"${sum[@]}" "${files[@]}" >SHA256SUMS
printf '%s\n' "${files[@]/#/$out/}"
