//! The choice between images and buffers for an adapter: by measurement, from the cache, or as the environment says. In
//! the program a render is long enough for a measurement if its rays are many by the number of lights; here they all miss.

use crate::reference::compare::open_gpu;
use crate::support::program::{Run, SCENE, Workspace};
use glimray::gpu::Gpu;
use glimray::render::{ExecutionPolicy, Fetch, RenderSettings, Renderer, Storage, StorageTimes};
use glimray::{import, pack};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Rays of a picture of `LONG`: 640 · 480 · (1 + 700) = 215 million if all camera rays hit.
const LIGHTS: usize = 700;
const LONG: &str = "render many.scene --size 640x480 --report - -o many.png";
const SHORT: &str = "render a.scene --size 32x24 --report - -o a.png";

/// A workspace with a cache folder.
struct Cached {
    workspace: Workspace,
    folder: PathBuf,
}

impl Cached {
    fn new() -> Self {
        let workspace = Workspace::new();
        let head =
            "amb: 0.1 0.1 0.1\nsphere\npos: 0 0 900\nrad: 0.01\ndif: 1 1 1\nspe: 0 0 0\nshi: 1\n";
        let lights = "light\npos: 2 2 1\ncol: 1 1 1\n".repeat(LIGHTS);
        workspace.write("many.scene", format!("{}\n{head}{lights}", LIGHTS + 1));
        let folder = workspace.path("cache");
        Self { workspace, folder }
    }

    /// Runs the program with `GLIMRAY_FETCH` and the folder.
    fn run(&self, fetch: &str, line: &str) -> Run {
        let mut command = self.workspace.command(line);
        command.env("GLIMRAY_FETCH", fetch);
        command.env("GLIMRAY_CACHE", &self.folder);
        Run::from(command.output().expect("glimray runs"))
    }

    /// The storage and the reason in the report of a run, which must succeed without a word on the cache.
    #[track_caller]
    fn choice(&self, fetch: &str, line: &str) -> [String; 2] {
        let run = self.run(fetch, line).expect(0);
        let said = &run.stderr;
        assert!(
            !said.contains("cache") && !said.contains("warning"),
            "{said}"
        );
        let report = run.json();
        ["storage", "reason"].map(|name| report["fetch"][name].as_str().expect(name).to_owned())
    }

    /// The storage that a long render measures. A busy machine may use up the time for measuring; the next render measures
    /// again.
    #[track_caller]
    fn measured(&self) -> String {
        for _ in 0..9 {
            let [storage, reason] = self.choice("auto", LONG);
            if reason == "measurement" {
                return storage;
            }
            assert_eq!(reason, "device_type");
        }
        panic!("no render was measured");
    }

    fn file(&self) -> PathBuf {
        self.folder.join("adapters.toml")
    }

    fn text(&self) -> String {
        std::fs::read_to_string(self.file()).expect("a cache file")
    }

    fn plant(&self, text: impl AsRef<[u8]>) {
        std::fs::create_dir_all(&self.folder).expect("a folder");
        std::fs::write(self.file(), text).expect("a file");
    }

    /// An entry for the adapter of the program, for a driver whose version has `suffix`.
    fn entry(&self, storage: &str, suffix: &str) -> String {
        let report = self.run("off", SHORT).expect(0).json();
        let of = |name: &str| report["adapter"][name].as_str().expect(name).to_owned();
        let version = report["glimray"].as_str().expect("a version");
        format!(
            "[[adapters]]\nname = '{}'\nbackend = '{}'\ndriver = '{}{suffix}'\nglimray = '{version}'\nstorage = \
             '{storage}'\nimage_seconds = 1.0\nbuffer_seconds = 1.0\n",
            of("name"),
            of("backend"),
            of("driver")
        )
    }
}

/// Whether the long scene is long on this adapter.
fn is_long_here() -> bool {
    open_gpu().is_cpu()
}

#[test]
fn lavapipe_reads_images_faster_than_buffers() {
    let gpu = open_gpu();
    // A busy machine may use up the time; the kernels are compiled the next time.
    let mut tries = (0..9).map(|_| StorageTimes::measure(&gpu).expect("a measurement"));
    let times = tries.find_map(|times| times);
    let Some(StorageTimes { image, buffer }) = times else {
        assert!(!gpu.adapter().name.contains("llvmpipe"), "no times");
        return;
    };
    assert!(image > 0.0 && buffer > 0.0, "{image} {buffer}");
    if gpu.adapter().name.contains("llvmpipe") && gpu.adapter().backend == "vulkan" {
        // Also if buffers had been usual.
        let faster = StorageTimes { image, buffer }.faster(Storage::Buffer);
        assert_eq!(faster, Storage::Image, "{image} {buffer}");
    }
}

#[test]
fn only_a_clear_difference_overrules_the_kind_of_the_adapter() {
    let faster = |image, buffer, usual| StorageTimes { image, buffer }.faster(usual);
    assert_eq!(faster(1.0, 2.0, Storage::Buffer), Storage::Image);
    assert_eq!(faster(2.0, 1.0, Storage::Image), Storage::Buffer);
    assert_eq!(faster(2.0, 1.0, Storage::Buffer), Storage::Buffer);
    for usual in [Storage::Image, Storage::Buffer] {
        assert_eq!(faster(1.0, 0.95, usual), usual);
        assert_eq!(faster(0.95, 1.0, usual), usual);
    }
}

#[test]
fn the_policy_says_where_the_scene_is_read_from() {
    let scene = import::load(Path::new("assets/scenes/spheres_and_triangles.scene"));
    let scene = scene.expect("a scene");
    let packed = Arc::new(pack::scene(&scene).expect("a packed scene"));
    let view = packed.frame(&scene.frame(0.0)).expect("a packed frame");
    let gpu: Gpu = open_gpu();
    let usual = match gpu.is_cpu() {
        true => Storage::Image,
        false => Storage::Buffer,
    };
    for (fetch, storage, expected) in [
        (Fetch::Auto, None, usual),
        (Fetch::Auto, Some(Storage::Image), Storage::Image),
        (Fetch::Auto, Some(Storage::Buffer), Storage::Buffer),
        (Fetch::Packet, Some(Storage::Buffer), Storage::Buffer),
        (Fetch::Image, Some(Storage::Buffer), Storage::Image),
        (Fetch::Buffer, Some(Storage::Image), Storage::Buffer),
    ] {
        let settings = RenderSettings {
            size: (8, 8),
            samples: 1,
            ..RenderSettings::default()
        };
        let policy = ExecutionPolicy {
            fetch,
            storage,
            ..ExecutionPolicy::default()
        };
        let renderer = Renderer::new(gpu.clone(), packed.clone(), &view, settings, policy);
        let found = renderer.expect("a renderer").storage();
        assert_eq!(found, expected, "{fetch:?} {storage:?}");
    }
}

#[test]
fn a_long_render_measures_once() {
    if !is_long_here() {
        return;
    }
    let cached = Cached::new();
    let storage = cached.measured();
    let text = cached.text();
    assert!(text.contains(&format!("storage = \"{storage}\"")), "{text}");
    let picture = cached.workspace.read("many.png");
    assert_eq!(cached.choice("", LONG), [storage.clone(), "cache".into()]);
    assert_eq!(cached.choice("", SHORT), [storage.clone(), "cache".into()]);
    assert_eq!(cached.text(), text);
    assert_eq!(cached.workspace.read("many.png"), picture);
    let doctor = cached.run("", "doctor --json").expect(0).json();
    assert_eq!(doctor["fetch"]["storage"], *storage);
    assert_eq!(doctor["fetch"]["reason"], "cache");
    assert_eq!(cached.workspace.names("cache"), ["adapters.toml"]);
}

#[test]
fn short_renders_measure_nothing() {
    let cached = Cached::new();
    let [_, reason] = cached.choice("auto", SHORT);
    assert_eq!(reason, "device_type");
    // A little less than 200 million rays: 701 for each pixel.
    let size = "533x535";
    let line = LONG.replace("640x480", size);
    assert_eq!(cached.choice("auto", &line)[1], "device_type");
    cached
        .run("auto", "explain many.scene --size 4000x3000 --pixel 1,1")
        .expect(0);
    assert!(!cached.folder.exists());
}

#[test]
fn what_was_measured_before_is_used_for_the_same_driver_only() {
    let cached = Cached::new();
    let run = |name: &str| {
        let line = SHORT.replace("a.png", name);
        cached.choice("auto", &line)
    };
    let usual = run("usual.png");
    let other = match usual[0].as_str() {
        "image" => "buffer",
        _ => "image",
    };
    cached.plant(cached.entry(other, ""));
    assert_eq!(run("other.png"), [other, "cache"]);
    let picture = |name| cached.workspace.read(name);
    assert_eq!(picture("usual.png"), picture("other.png"));
    cached.plant(cached.entry(other, ".1"));
    assert_eq!(run("usual.png"), usual);
    // A measurement keeps the entries of other drivers.
    if is_long_here() {
        cached.measured();
        let text = cached.text();
        assert_eq!(text.matches("[[adapters]]").count(), 2, "{text}");
        assert_eq!(run("usual.png")[1], "cache");
    }
    let of_another_version = (cached.entry(other, "")).replace("glimray = '", "glimray = '9");
    cached.plant(of_another_version);
    assert_eq!(run("usual.png"), usual);
}

#[test]
fn a_broken_cache_is_replaced() {
    let cached = Cached::new();
    let broken: [&[u8]; 4] = [
        b"\xff\xfe\x00",
        b"[[adapters]]\nname = 3\n",
        b"adapters = 'none'",
        b"",
    ];
    for text in broken {
        cached.plant(text);
        assert_eq!(cached.choice("auto", SHORT)[1], "device_type");
    }
    let wrong = cached.entry("cards", "");
    cached.plant(wrong);
    assert_eq!(cached.choice("auto", SHORT)[1], "device_type");
    if is_long_here() {
        cached.measured();
        assert_eq!(cached.choice("auto", SHORT)[1], "cache");
    }
}

#[test]
fn a_cache_that_cannot_be_written_is_no_error() {
    if !is_long_here() {
        return;
    }
    // A file where the folder should be, and a folder where the file should be.
    let mut cached = Cached::new();
    cached.folder = cached.workspace.path("a.scene").join("cache");
    cached.measured();
    assert_eq!(cached.workspace.read("a.scene"), SCENE.as_bytes());
    let cached = Cached::new();
    std::fs::create_dir_all(cached.file()).expect("a folder");
    cached.measured();
    assert_eq!(cached.workspace.names("cache"), ["adapters.toml"]);
}

#[test]
fn the_environment_overrides_the_cache() {
    let cached = Cached::new();
    for (planted, other) in [("image", "buffer"), ("buffer", "image")] {
        cached.plant(cached.entry(planted, ""));
        let text = cached.text();
        assert_eq!(cached.choice("auto", SHORT), [planted, "cache"]);
        assert_eq!(cached.choice(other, LONG), [other, "environment"]);
        assert_eq!(cached.choice("off", LONG)[1], "device_type");
        assert_eq!(cached.text(), text);
    }
}

#[test]
fn an_unknown_choice_is_refused() {
    let cached = Cached::new();
    let message = "error: cannot choose how kernels read the scene (GLIMRAY_FETCH=cards): there is no such choice. Set it \
                   to image, buffer, auto or off.";
    for line in [
        "render a.scene",
        "animate a.scene -o a_%d.png --frames 1..2",
        "bench --quick --only course",
        "explain a.scene --pixel 1,1",
        "doctor",
    ] {
        let run = cached.run("cards", line).expect(2);
        assert_eq!(run.stderr.trim_end(), message);
    }
    assert_eq!(cached.workspace.made(), ["many.scene"]);
}

/// A grid of little triangles, each many times, as binary PLY: more bytes than one binding of lavapipe's buffers holds.
#[test]
fn a_choice_that_the_limits_forbid_is_reported() {
    let limit = open_gpu().adapter().max_binding_bytes;
    const SIDE: u32 = 60;
    const TRIANGLE_BYTES: u64 = 48;
    let cells = u64::from(SIDE * SIDE);
    let copies = limit / (2 * cells * TRIANGLE_BYTES) + 1;
    if copies > 1000 {
        return;
    }
    let mut ply = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float \
         z\nelement face {}\nproperty list uchar uint vertex_indices\nend_header\n",
        (SIDE + 1) * (SIDE + 1),
        2 * cells * copies
    )
    .into_bytes();
    for index in 0..(SIDE + 1) * (SIDE + 1) {
        let place = [index % (SIDE + 1), index / (SIDE + 1), 0];
        for at in place {
            ply.extend((at as f32).to_le_bytes());
        }
    }
    for cell in (0..copies).flat_map(|_| 0..SIDE * SIDE) {
        let first = cell / SIDE * (SIDE + 1) + cell % SIDE;
        let across = first + SIDE + 2;
        for corners in [[first, first + 1, across], [first, across, across - 1]] {
            ply.push(3);
            for corner in corners {
                ply.extend(corner.to_le_bytes());
            }
        }
    }
    let cached = Cached::new();
    cached.workspace.write("large.ply", ply);
    let line = "render large.ply --bare --integrator depth --size 32x24 --report - -o large.png";
    let run = cached.run("buffer", line).expect(0);
    run.says(
        "warning: the scene is read from images, not from buffers as GLIMRAY_FETCH says: it is too large for the buffers \
         of this adapter. `glimray doctor` prints its limits.",
    );
    let report = run.json();
    assert_eq!(report["fetch"]["storage"], "image");
    assert_eq!(report["fetch"]["reason"], "limits");
}
