//! The choice between images and buffers for an adapter: by its kind, as the environment says, or as its limits demand.

use crate::reference::compare::open_gpu;
use crate::support::program::{Run, Workspace};
use glimray::gpu::Gpu;
use glimray::render::{ExecutionPolicy, Fetch, RenderSettings, Renderer, Storage};
use glimray::{import, pack};
use std::path::Path;
use std::sync::Arc;

const SMALL: &str = "render a.scene --size 32x24 --report - -o a.png";

/// Runs the program with `GLIMRAY_FETCH`.
fn run(workspace: &Workspace, fetch: &str, line: &str) -> Run {
    let mut command = workspace.command(line);
    command.env("GLIMRAY_FETCH", fetch);
    Run::from(command.output().expect("glimray runs"))
}

/// The storage and the reason in the report of a run, which must succeed without a warning.
#[track_caller]
fn choice(workspace: &Workspace, fetch: &str, line: &str) -> [String; 2] {
    let run = run(workspace, fetch, line).expect(0);
    assert!(!run.stderr.contains("warning"), "{}", run.stderr);
    let report = run.json();
    ["storage", "reason"].map(|name| report["fetch"][name].as_str().expect(name).to_owned())
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
fn the_environment_overrides_the_kind_of_the_adapter() {
    let workspace = Workspace::new();
    let usual = match open_gpu().is_cpu() {
        true => "image",
        false => "buffer",
    };
    let mut pictures = Vec::new();
    for (fetch, storage, reason) in [
        ("", usual, "device_type"),
        ("auto", usual, "device_type"),
        ("image", "image", "environment"),
        ("buffer", "buffer", "environment"),
    ] {
        assert_eq!(choice(&workspace, fetch, SMALL), [storage, reason]);
        pictures.push(workspace.read("a.png"));
        assert_eq!(
            choice(&workspace, fetch, "doctor --json"),
            [storage, reason]
        );
    }
    assert!(pictures.iter().all(|picture| *picture == pictures[0]));
}

#[test]
fn an_unknown_choice_is_refused() {
    let workspace = Workspace::new();
    let message = "error: cannot choose how kernels read the scene (GLIMRAY_FETCH=cards): there is no such choice. Set it \
                   to image, buffer or auto.";
    for line in [
        "render a.scene",
        "animate a.scene -o a_%d.png --frames 1..2",
        "bench --quick --only course",
        "explain a.scene --pixel 1,1",
        "doctor",
    ] {
        let run = run(&workspace, "cards", line).expect(2);
        assert_eq!(run.stderr.trim_end(), message);
    }
    assert!(workspace.made().is_empty(), "{:?}", workspace.made());
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
    let workspace = Workspace::new();
    workspace.write("large.ply", ply);
    let line = "render large.ply --bare --integrator depth --size 32x24 --report - -o large.png";
    let run = run(&workspace, "buffer", line).expect(0);
    run.says(
        "warning: the scene is read from images, not from buffers as GLIMRAY_FETCH says: it is too large for the buffers \
         of this adapter. `glimray doctor` prints its limits.",
    );
    let report = run.json();
    assert_eq!(report["fetch"]["storage"], "image");
    assert_eq!(report["fetch"]["reason"], "limits");
}
