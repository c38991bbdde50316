//! Fuzzes the importers with mutations of valid files: `cargo run --release --example fuzz -- [CASES] [SEED]`
//!
//! Scenes in all formats, models with their materials, meshes and pictures are truncated, spliced and
//! corrupted, and their numbers replaced. A case fails if the importer panics, reports an error of several
//! lines, returns a scene that violates the invariants of `Scene`, or takes more than ten seconds or more
//! memory than allowed. Failures are written to `target/fuzz`, with the seed of the case in the name;
//! `target/fuzz/current` is the file being read, in case the importer hangs. Small fixed failures belong in
//! `tests/corpus`, which the tests read.

use glimray::image::Image;
use glimray::scene::{Background, Scene};
use glimray::{import, output};
use std::error::Error;
use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Time limit for reading one file; all files are small.
const MOST_TIME: Duration = Duration::from_secs(10);

/// A text mesh that uses every property that is read.
const PLY: &str = "ply\nformat ascii 1.0\ncomment a square\nelement vertex 4\nproperty float x\n\
    property float y\nproperty double z\nproperty float nx\nproperty float ny\nproperty float nz\n\
    property float u\nproperty float v\nelement face 2\nproperty list uchar int vertex_indices\n\
    end_header\n0 0 0 0 0 1 0 0\n1 0 0 0 0 1 1 0\n1 1 0 0 0 1 1 1\n0 1 0.5 0 0 1 0 1\n3 0 1 2\n3 0 2 3\n";

/// A seed file, and the scene that references it if it is not a scene itself.
struct Seed {
    name: String,
    bytes: Vec<u8>,
    scene: PathBuf,
    /// Memory limit for reading it, in bytes, in addition to eight times its size.
    memory: u64,
}

/// SplitMix64 (Steele, Lea and Flood 2014).
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        bits ^ (bits >> 31)
    }

    fn below(&mut self, count: usize) -> usize {
        (self.bits() % count.max(1) as u64) as usize
    }

    fn of<'a, T>(&mut self, choices: &'a [T]) -> &'a T {
        &choices[self.below(choices.len())]
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let mut number = |default: u64| arguments.next().map_or(Ok(default), |text| text.parse());
    let (cases, seed) = (number(5000)?, number(1)?);
    let folder = tempfile::tempdir()?;
    let seeds = seeds(folder.path())?;
    let found = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/fuzz");
    fs::create_dir_all(&found)?;
    std::panic::set_hook(Box::new(|_| {}));
    let (mut finds, mut read) = (0, 0);
    for case in seed..seed + cases {
        let mut random = Random(case);
        let from = random.of(&seeds);
        let bytes = damaged(from, &seeds, &mut random);
        let path = folder.path().join(&from.name);
        fs::write(found.join("current"), &bytes)?;
        fs::write(&path, &bytes)?;
        match judge(from, bytes.len()) {
            Ok(is_read) => read += u64::from(is_read),
            Err(why) => {
                finds += 1;
                let name = format!("{case}_{}", from.name);
                println!("{name}: {why}");
                fs::write(found.join(name), &bytes)?;
            }
        }
        fs::write(&path, &from.bytes)?;
    }
    fs::remove_file(found.join("current"))?;
    println!(
        "{cases} cases from {seed}: {read} read, {} refused, {finds} found",
        cases - read - finds
    );
    match finds {
        0 => Ok(()),
        _ => Err("there are finds in target/fuzz".into()),
    }
}

/// Copies the files that the seeds reference to `folder`.
fn seeds(folder: &Path) -> Result<Vec<Seed>, Box<dyn Error>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut files: Vec<(String, Vec<u8>)> = Vec::new();
    for source in ["assets/scenes", "tests/corpus"] {
        for entry in fs::read_dir(root.join(source))? {
            let path = entry?.path();
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            files.push((name.into_owned(), fs::read(&path)?));
        }
    }
    files.push(("square.ply".into(), PLY.into()));
    let pixel = |i: u32| [i % 13, i / 13, i % 7].map(|c| c as f32 / 13.0);
    let image = Image {
        width: 13,
        height: 9,
        pixels: (0..13 * 9)
            .map(|i| {
                let [r, g, b] = pixel(i);
                [r, g, b, 1.0]
            })
            .collect(),
    };
    for name in ["p.png", "p.jpg", "p.hdr", "p.exr"] {
        output::save(folder.join(name), &image)?;
        files.push((name.into(), fs::read(folder.join(name))?));
    }
    files.sort();
    let mut seeds = Vec::new();
    for (name, bytes) in files {
        fs::write(folder.join(&name), &bytes)?;
        let (scene, memory) = match name.rsplit('.').next() {
            // The TOML parser needs up to 800 bytes for each value, and there may be many.
            Some("toml") => (name.clone(), 512),
            Some("scene" | "nff" | "obj") => (name.clone(), 128),
            Some("mtl") => ("lighthouse.obj".into(), 128),
            Some("ply") => (
                naming(folder, &name, "[[objects]]\nmesh = { file = '%' }")?,
                128,
            ),
            Some("png" | "jpg" | "hdr" | "exr") => (
                naming(folder, &name, "background = { picture = '%' }")?,
                1 << 10,
            ),
            _ => continue,
        };
        seeds.push(Seed {
            name,
            bytes,
            scene: folder.join(scene),
            memory: memory << 20,
        });
    }
    Ok(seeds)
}

/// A scene that references a file.
fn naming(folder: &Path, name: &str, text: &str) -> Result<String, Box<dyn Error>> {
    let scene = format!("names_{}.toml", name.replace('.', "_"));
    fs::write(folder.join(&scene), text.replace('%', name))?;
    Ok(scene)
}

/// The seed after a few mutations.
fn damaged(from: &Seed, seeds: &[Seed], random: &mut Random) -> Vec<u8> {
    const NUMBERS: [&str; 16] = [
        "nan",
        "-nan",
        "inf",
        "1e400",
        "-1e400",
        "3.4e38",
        "-3.4e38",
        "1e-45",
        "-0",
        "0",
        "-1",
        "65536",
        "4294967296",
        "99999999999999999999",
        "1e30",
        ".",
    ];
    let mut bytes = from.bytes.clone();
    for _ in 0..1 + random.below(3) {
        let at = random
            .below(bytes.len() + 1)
            .min(bytes.len().saturating_sub(1));
        if bytes.is_empty() {
            break;
        }
        let slice = |bytes: &[u8], random: &mut Random, most: usize| {
            let start = random.below(bytes.len());
            bytes[start..(start + random.below(most)).min(bytes.len())].to_vec()
        };
        match random.below(9) {
            0 => bytes[at] ^= 1 << random.below(8),
            1 => bytes[at] = *random.of(&[0, 1, 0x7f, 0x80, 0xff, b'\n', b'"', b'[', b'-']),
            2 => bytes.truncate(at),
            3 => {
                let other = random.of(seeds);
                let piece = slice(&other.bytes, random, 200);
                bytes.splice(at..at, piece);
            }
            4 => {
                let piece = slice(&bytes, random, 80);
                let times = 1 + random.below(30);
                bytes.splice(at..at, piece.repeat(times));
            }
            5 => {
                let end = (at + random.below(40)).min(bytes.len());
                bytes.drain(at..end);
            }
            _ => {
                let is_digit = |b: &u8| b.is_ascii_digit() || b"+-.e".contains(b);
                let Some(start) = bytes[at..].iter().position(|b| b.is_ascii_digit()) else {
                    continue;
                };
                let start = at + start;
                let length = bytes[start..].iter().take_while(|b| is_digit(b)).count();
                let number = random.of(&NUMBERS).bytes();
                bytes.splice(start..start + length, number);
            }
        }
    }
    bytes.truncate(1 << 20);
    bytes
}

/// Whether the file was read, or rejected correctly.
fn judge(seed: &Seed, length: usize) -> Result<bool, String> {
    let before = memory("VmRSS:");
    // Resets the peak memory of the process on Linux.
    let _ = fs::write("/proc/self/clear_refs", "5");
    let started = Instant::now();
    let outcome = catch_unwind(AssertUnwindSafe(|| import::load(&seed.scene)));
    let took = started.elapsed();
    let peak = memory("VmHWM:").saturating_sub(before);
    if took > MOST_TIME {
        return Err(format!("took {took:.1?}"));
    }
    if peak > seed.memory + 8 * length as u64 {
        return Err(format!("took {} MiB", peak >> 20));
    }
    match outcome {
        Err(panic) => {
            let text = panic.downcast_ref::<String>().cloned();
            let text = text.or_else(|| panic.downcast_ref::<&str>().map(|&text| text.into()));
            Err(format!("panics: {}", text.unwrap_or_default()))
        }
        Ok(Err(error)) => match error.to_string() {
            text if text.lines().count() != 1 => Err(format!("says {text:?}")),
            _ => Ok(false),
        },
        Ok(Ok(scene)) => broken(&scene).map_or(Ok(true), Err),
    }
}

/// A memory statistic of this process in bytes; 0 if the system does not provide it.
fn memory(what: &str) -> u64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix(what));
    let number = line.and_then(|line| line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok());
    number.unwrap_or_default() << 10
}

/// The invariants that `scene` violates.
fn broken(scene: &Scene) -> Option<String> {
    let is_color = |c: &glam::Vec3| c.is_finite() && c.min_element() >= 0.0;
    for material in &scene.materials {
        let colors = [
            material.diffuse,
            material.specular,
            material.ambient,
            material.emission,
            material.reflect,
            material.transmit,
        ];
        if !colors.iter().all(is_color) {
            return Some(format!("a colour of {material:?}"));
        }
    }
    if !scene.lights.iter().all(|light| is_color(&light.color)) {
        return Some("the colour of a light".into());
    }
    let mut texels = scene.pictures.iter().flat_map(|picture| picture.linear());
    if !texels.all(|texel| is_color(&texel.truncate()) && (0.0..=1.0).contains(&texel.w)) {
        return Some("a texel".into());
    }
    if matches!(&scene.background, Background::Color(color) if !is_color(color)) {
        return Some("the background".into());
    }
    for mesh in &scene.meshes {
        let count = mesh.positions.len();
        let has_all = mesh.normals.len() == count
            && mesh.materials.len() == count
            && (mesh.uvs.is_empty() || mesh.uvs.len() == count);
        let is_in = |&i: &u32| (i as usize) < count;
        let is_unit = |n: &glam::Vec3| (n.length() - 1.0).abs() < 1e-5;
        if !(has_all
            && mesh.triangles.iter().flatten().all(is_in)
            && mesh.positions.iter().all(|p| p.is_finite())
            && mesh.normals.iter().all(is_unit)
            && mesh
                .materials
                .iter()
                .all(|&m| (m as usize) < scene.materials.len()))
        {
            return Some(format!("the mesh `{}`", mesh.name));
        }
    }
    if scene.cameras.is_empty() || scene.materials.is_empty() {
        return Some("no camera or no material".into());
    }
    let bounds = scene.bounds();
    match bounds {
        Some((min, max)) if !(min.is_finite() && max.is_finite()) => {
            Some(format!("bounds {min} to {max}"))
        }
        _ => None,
    }
}
