# Software drivers of Debian's archive, each in a tree of its own under `$out`: functions for the scripts beside this one,
# which run in the repository's root and set `out`, `glimray` and `suite`.

# Debian's archive, as the sources of apt name it.
archive=$(apt-get indextargets --format '$(SITE)' 'Origin: Debian' 'Identifier: Packages' | head -n 1)

unpack() { # DRIVER: makes its tree, if there is none
	local release=$1 packages=(mesa-vulkan-drivers libegl1 libgl1-mesa-dri)
	case $1 in
		trixie | trixie-backports | sid) ;;
		swiftshader) packages=() release=trixie ;;
		*) echo "There is no driver $1: trixie, trixie-backports, sid, swiftshader." >&2 && exit 2 ;;
	esac
	[ -e "$out/$1/unpacked" ] || unpack_packages "$1" "$release" "${packages[@]}" >"$out/$1.txt" 2>&1
}

unpack_packages() { # DRIVER RELEASE PACKAGE…
	local apt=$out/$1/apt tree=$out/$1/tree release package
	rm -rf "${out:?}/$1"
	mkdir -p "$apt"/{lists,archives}/partial "$tree"/{proc,dev,sys,tmp} "$tree"/usr/{bin,sbin,lib,lib64}
	ln -s usr/bin usr/sbin usr/lib usr/lib64 "$tree"
	touch "$apt/status"
	# Backports need the release that they are for.
	for release in "$2" "${2%-backports}"; do
		echo "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $archive $release main"
	done | uniq >"$apt/sources.list"
	local options=(--quiet -o Dir::State="$apt" -o Dir::State::status="$apt/status" -o Dir::Cache="$apt"
		-o Dir::Etc::SourceList="$apt/sources.list" -o Dir::Etc::SourceParts=- -o APT::Sandbox::User=root
		-o APT::Default-Release="$2")
	apt-get "${options[@]}" update &&
		apt-get "${options[@]}" install --yes --download-only --no-install-recommends \
			libc6 libgcc-s1 libstdc++6 libvulkan1 "${@:3}" || return
	for package in "$apt"/archives/*.deb; do dpkg-deb -x "$package" "$tree" || return; done
	# SwiftShader needs nothing that the browser depends on.
	if [ "$1" = swiftshader ]; then
		(cd "$apt" && apt-get "${options[@]}" download chromium-common &&
			dpkg-deb --fsys-tarfile chromium-common_*.deb | tar -x -C "$tree" --wildcards '*swiftshader*') || return
	fi
	touch "$out/$1/unpacked"
}

inside() { # DRIVER COMMAND…: runs it in the tree of the driver, or with the installed one, with caches of its own
	local driver=$1 tree=$out/$1/tree folder manifest=/usr/share/vulkan/icd.d/lvp_icd.json map=()
	export XDG_CACHE_HOME=$out/$1/cache
	shift
	if [ "$driver" = installed ]; then
		"$@"
		return
	fi
	[ "$driver" != swiftshader ] || manifest=/usr/lib/chromium/vk_swiftshader_icd.json
	[ "$(id -u)" -eq 0 ] || map=(--map-root-user)
	local folders=(/proc /dev /sys /tmp "$PWD" "$out" "${glimray%/*/*}" "${suite%/*}")
	for folder in "${folders[@]}"; do mkdir -p "$tree$folder"; done
	# shellcheck disable=SC2016 # The inner shell expands it.
	VK_DRIVER_FILES=$manifest timeout "$limit" unshare "${map[@]}" --mount bash -c '
		tree=$1
		while shift && [ "$1" != -- ]; do mount --rbind "$1" "$tree$1" || exit; done
		shift
		exec unshare --root="$tree" --wd="$PWD" "$@"' bash "$tree" "${folders[@]}" -- "$@"
}
