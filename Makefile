# For a fresh Debian or Ubuntu with Rust: `make demo` makes a picture, `make test` runs every check.

CARGO ?= cargo
# One profile throughout, so that demo, tests, lints and docs share what they compile.
FLAGS := --release --locked
GLIMRAY := $(or $(CARGO_TARGET_DIR),target)/release/glimray

# Mesa's device-select layer complains on machines without a desktop session (see src/app/mesa.rs).
export NODEVICE_SELECT := 1

# A test that lacks one of these fails instead of being skipped (tests/suite/support/skip.rs): what
# `make test` builds, or installs with apt-get, and FFmpeg where it is installed; it would double what is downloaded.
comma := ,
ifneq ($(shell command -v apt-get),)
GLIMRAY_REQUIRE ?= examples,gl,xvfb$(if $(shell command -v ffmpeg >/dev/null && command -v ffprobe),$(comma)ffmpeg)
export GLIMRAY_REQUIRE
endif

# Followed by names of Debian packages.
install = sh -c 'echo "missing, to be installed: $$*"; \
	command -v apt-get >/dev/null || { echo "There is no apt-get: install them by hand." >&2; exit 1; }; \
	as_root=; [ "$$(id -u)" -eq 0 ] || as_root=sudo; \
	$$as_root apt-get update && \
	$$as_root env DEBIAN_FRONTEND=noninteractive apt-get install --yes --no-remove --no-install-recommends "$$@"' install

.DEFAULT_GOAL := help
# Steps share a build, so none runs beside another.
.NOTPARALLEL:
.PHONY: help demo test bench docs gallery build compiler display driver opengl lint features headless wasm

help:
	@echo 'make demo      render the showcase scene to glimray.png'
	@echo 'make test      format, lints, documentation, all tests'
	@echo 'make bench     measure speed on built-in scenes'
	@echo 'make docs      build the manual with mdBook and check its links'
	@echo 'make gallery   render the pictures of README.md again'
	@echo 'Where no Vulkan adapter is found, each first installs the Vulkan loader and the software'
	@echo 'driver of Mesa (Debian and Ubuntu, with apt-get).'

demo: build driver
	$(GLIMRAY) demo -o glimray.png

# Tests are built first, the program with them: `driver` needs it.
test: lint features headless wasm
	$(CARGO) test $(FLAGS) --no-run
	@$(MAKE) --no-print-directory driver opengl display
	$(CARGO) test $(FLAGS)

bench: build driver
	$(GLIMRAY) bench

# The commands are those that README.md and the manual's gallery show with each picture; the pictures of the window
# are taken of a real one.
gallery: build driver display
	@grep -oh 'glimray [a-z]* [^`]*-o assets/gallery/[^` ]*' README.md docs/src/guide/gallery.md | while read -r _ arguments; do \
		echo "glimray $$arguments"; \
		$(GLIMRAY) $$arguments --quiet || exit; \
	done
	$(CARGO) test $(FLAGS) --test suite -- --ignored pictures_of_the_window_for_the_readme

# The pages lie as deep in the site as they do in the repository, and the folders that they link to beside them: a link
# to a picture or a source works in both places. Tests check the links without mdBook.
MDBOOK_VERSION := 0.5.4
TOOLS := $(abspath $(or $(CARGO_TARGET_DIR),target)/tools)
SITE := $(abspath $(or $(CARGO_TARGET_DIR),target)/site)
LINKED := assets benches examples shaders src tests build.rs
docs:
	@[ -x $(TOOLS)/bin/mdbook ] || $(CARGO) install mdbook --version $(MDBOOK_VERSION) --locked \
		--no-default-features --features search --root $(TOOLS)
	rm -rf $(SITE)
	mkdir -p $(SITE)
	$(TOOLS)/bin/mdbook build docs --dest-dir $(SITE)/docs/book
	cp -R $(LINKED) $(SITE)
	docs/check-links.sh $(SITE)/docs/book
	@echo $(SITE)/docs/book/index.html

build: compiler
	$(CARGO) build $(FLAGS)

# FLIP, by which `compare` judges pictures, is C++.
compiler:
	@command -v c++ >/dev/null || { $(install) g++; }

# Exit code 5 of `doctor`: there is no usable adapter.
driver:
	@if [ "$$(uname -s)" != Linux ]; then exit 0; fi; \
	status=0; $(GLIMRAY) doctor --backend vulkan >/dev/null 2>&1 || status=$$?; \
	if [ $$status -ne 5 ]; then exit 0; fi; \
	$(install) libvulkan1 mesa-vulkan-drivers && $(GLIMRAY) doctor --backend vulkan

# The second driver that scenes are rendered with. Without it that test is skipped.
opengl:
	@if [ "$$(uname -s)" != Linux ]; then exit 0; fi; \
	status=0; $(GLIMRAY) doctor --backend gl >/dev/null 2>&1 || status=$$?; \
	if [ $$status -eq 5 ] && command -v apt-get >/dev/null; then $(install) libegl1 libgl1-mesa-dri; fi

# An X server without a screen, and a program that moves its mouse. Without them tests of the real
# window are skipped.
display:
	@if [ "$$(uname -s)" = Linux ] && command -v apt-get >/dev/null && \
		! { command -v Xvfb && command -v xdotool; } >/dev/null; then $(install) xvfb xdotool; fi

lint: compiler
	@$(CARGO) fmt --version >/dev/null && $(CARGO) clippy --version >/dev/null || \
		rustup component add rustfmt clippy
	$(CARGO) fmt --check
	$(CARGO) clippy $(FLAGS) --all-targets -- --deny warnings
	RUSTDOCFLAGS=--deny=warnings $(CARGO) doc $(FLAGS) --no-deps

# The library alone, and with each feature by itself: what they share is built once.
features: compiler
	@for feature in '' archive cli gl parallel video viewer; do \
		echo "without default features, with: $${feature:-none}"; \
		$(CARGO) clippy --quiet $(FLAGS) --lib --bins --no-default-features --features "$$feature" \
			-- --deny warnings || exit; \
	done

# Without default features there is nothing of a window system, of the program, or of C and C++.
headless:
	@if $(CARGO) tree --locked --no-default-features --edges normal --prefix none | \
		grep -E '^(winit|softbuffer|smithay|wayland|x11|xcb|xkb|sdl|glfw|gtk|egui|minifb)'; \
	then echo 'The crates above need a window system.' >&2; exit 1; fi
	@if $(CARGO) tree --locked --no-default-features --edges normal,build --prefix none | \
		grep -E '^(clap|miette|indicatif|console|signal-hook|terminal_size|nv-flip|openh264|rayon|cc) '; \
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
	if ! has_debian_rustc && command -v apt-get >/dev/null; then $(install) rustc-web rust-web-src; fi; \
	if has_debian_rustc; then \
		RUSTC_BOOTSTRAP=1 RUSTC=$(DEBIAN_RUSTC) $(CARGO) $(WASM) -Z build-std=std,panic_abort \
			--target-dir $(or $(CARGO_TARGET_DIR),target)/wasm; exit; \
	fi; \
	echo 'skipped: there is no compiler for wasm32-unknown-unknown (wasm)' >&2; \
	case ",$$GLIMRAY_REQUIRE," in *,wasm,*) exit 1;; esac
