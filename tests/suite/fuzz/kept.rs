//! Files that glimray writes for itself: films, checkpoints and manifests. They are made by today's writer, so that none is
//! of a version that is refused at once.

use crate::film::{bytes, film, stratified};
use crate::reference::compare::start;
use crate::reference::scenes;
use crate::support::program::{Run, Workspace};
use glimray::render::{Antialias, Film, Integrator, RenderSettings, Renderer};
use std::fs;
use std::path::Path;
use std::process::Command;
use xxhash_rust::xxh3::xxh3_128;

/// How the films among the seeds are made anew.
pub const UPDATE: &str =
    "If it is a film, run: UPDATE_SEEDS=1 cargo test --profile ci --test suite fuzz::kept";

/// Small films of every kind, by name.
fn films() -> Vec<(&'static str, Film)> {
    let scene = scenes::spheres();
    let plain = stratified(70, (5, 4));
    let of = |settings: RenderSettings| film(&scene, &settings);
    let part = |crop, sample_range| {
        of(RenderSettings {
            crop: Some(crop),
            sample_range: Some(sample_range),
            ..stratified(150, (7, 5))
        })
    };
    let holes = part([0, 0, 3, 2], 0..150).merge(&part([4, 1, 7, 5], 64..128));
    vec![
        ("plain", of(plain.clone())),
        ("range", holes.expect("one picture")),
        (
            "crop",
            of(RenderSettings {
                crop: Some([1, 1, 3, 3]),
                ..plain.clone()
            }),
        ),
        (
            "layers",
            of(RenderSettings {
                integrator: Integrator::Path,
                features: true,
                ..stratified(70, (2, 2))
            }),
        ),
        (
            "adaptive",
            of(RenderSettings {
                antialias: Antialias::Adaptive,
                noise: 0.002,
                ..plain
            }),
        ),
    ]
}

/// The seeds are in the repository for the fuzzer, which has no device. Those that it cannot read are found here, and made
/// anew if `UPDATE_SEEDS` is set.
#[test]
fn films_of_todays_writer_are_accepted() {
    for (name, film) in films() {
        let written = bytes(&film);
        assert!(super::targets::film(&written), "{name}");
        if std::env::var_os("UPDATE_SEEDS").is_some() {
            let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fuzz/seeds/film");
            fs::write(folder.join(format!("{name}.film")), &written).expect("a seed");
        }
    }
}

/// Every number of the header with every odd value, the checksum being right.
#[test]
fn forged_headers_of_films_are_read_or_refused() {
    let written = bytes(&films()[0].1);
    for at in 12..written.len().min(400) {
        for number in [0, 1, 0x7fc0_0000, 0x7f80_0000, 0x7fff_ffff, u32::MAX] {
            let mut forged = written.clone();
            forged[at..at + 4].copy_from_slice(&u32::to_le_bytes(number));
            super::targets::film(&forged);
        }
    }
}

/// Checkpoints of one render, and the renderer that goes on from them.
pub struct Checkpoints {
    pub good: Vec<Vec<u8>>,
    renderer: Renderer,
}

impl Checkpoints {
    pub fn new() -> Self {
        let mut renderer = Self::renderer();
        let mut good = Vec::new();
        while !renderer.is_done() && good.len() < 4 {
            renderer.step().expect("a step");
            let mut written = Vec::new();
            let checkpoint = renderer.checkpoint().expect("a checkpoint");
            checkpoint.write(&mut written).expect("written");
            good.push(written);
        }
        Self { good, renderer }
    }

    fn renderer() -> Renderer {
        let settings = stratified(130, (24, 18));
        let (settings, policy) = crate::reference::compare::sliced(
            &settings,
            glimray::render::Slicing {
                max_groups: 3,
                max_samples: 20,
                ..Default::default()
            },
        );
        start(&scenes::spheres(), &(settings, policy)).expect("a renderer")
    }

    /// Whether the render goes on from the checkpoint, whose checksum is put right first. It is then finished.
    pub fn read(&mut self, bytes: &[u8]) -> bool {
        let mut bytes = bytes.to_vec();
        if let Some((content, digest)) = bytes.split_last_chunk_mut::<16>() {
            *digest = xxh3_128(content).to_le_bytes();
        }
        if let Err(error) = self.renderer.resume(&bytes[..]) {
            let said = error.to_string();
            assert!(!said.contains(char::is_control), "{said:?}");
            return false;
        }
        let mut steps = 0;
        while !self.renderer.is_done() {
            self.renderer.step().expect("a step");
            steps += 1;
            assert!(steps < 10_000, "the render does not end");
        }
        true
    }
}

/// The manifest of a farm, and the farm.
pub struct Manifests {
    pub good: Vec<u8>,
    workspace: Workspace,
}

impl Manifests {
    pub fn new() -> Self {
        let workspace = Workspace::moving();
        workspace
            .run("farm plan a.toml --size 8x6 --samples 2 --frames 0..3 --parts 2 --dir farm -o f_%d.png")
            .expect(0);
        let good = workspace.read("farm/manifest.json");
        Self { good, workspace }
    }

    /// Whether `farm status` accepts the manifest, whose checksum is put right first.
    pub fn read(&self, bytes: &[u8]) -> bool {
        let mut bytes = bytes.to_vec();
        let key = b"\"checksum\": \"";
        if let Some(at) = bytes.windows(key.len()).position(|part| part == key) {
            let value = at + key.len()..at + key.len() + 32;
            if value.end <= bytes.len() {
                bytes[value.clone()].fill(b'0');
                let sum = format!("{:032x}", xxh3_128(&bytes));
                bytes[value].copy_from_slice(sum.as_bytes());
            }
        }
        self.workspace.write("farm/manifest.json", &bytes);
        let mut command: Command = self.workspace.command("farm status farm");
        let run = Run::from(command.output().expect("glimray runs"));
        let code = run.code.expect("an exit code");
        assert!([0, 3].contains(&code), "{code}: {}", run.stderr);
        let is_line = run.stderr.lines().count() <= 1;
        assert!(
            is_line && !run.stderr.contains('\u{202e}'),
            "{}",
            run.stderr
        );
        code == 0
    }
}
