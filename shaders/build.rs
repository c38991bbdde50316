//! Compresses the kernels in `shaders/linked` for the program to embed: plain WGSL, once for each variant;
//! `explain` is the kernel `whitted` with the feature `record`. The build fails if a source has changed since they
//! were linked; with the feature `link` it links them first. It also computes the tables of albedos.

#[cfg(feature = "link")]
#[path = "shaders/link.rs"]
mod link;

#[path = "src/pack/albedo/table.rs"]
mod albedo;

use std::{env, error::Error, fs, path::Path, process::ExitCode};

/// The sources that were linked: checksum, length and name, as `cksum` prints them in `shaders`.
const SOURCES: &str = "shaders/linked/sources.txt";

/// How hard DEFLATE tries: higher levels take longer and save a few kilobytes.
const LEVEL: u8 = 6;

fn main() -> ExitCode {
    println!("cargo::rerun-if-changed=shaders");
    println!("cargo::rerun-if-changed=src/pack/albedo/table.rs");
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<(), Box<dyn Error>> {
    let words = format!("{:?}", albedo::words());
    fs::write(Path::new(&env::var("OUT_DIR")?).join("albedo.txt"), words)?;
    let mut sources = Vec::new();
    list(Path::new("shaders"), &mut sources)?;
    sources.sort();
    #[cfg(feature = "link")]
    {
        for (name, text) in link::kernels()? {
            write(&format!("shaders/linked/{name}"), &text)?;
        }
        let lines = sources.iter().map(|(name, sum)| format!("{sum} {name}\n"));
        write(SOURCES, &lines.collect::<String>())?;
    }
    let linked = fs::read_to_string(SOURCES).map_err(|error| {
        format!("{SOURCES}: {error}. Link the kernels with `make shaders`, or build with `--features link`.")
    })?;
    let linked = linked.lines().filter_map(|line| line.rsplit_once(' '));
    let mut linked: Vec<_> = linked
        .map(|(sum, name)| (name.into(), sum.into()))
        .collect();
    linked.sort();
    let is_new = |source: &&(String, String)| !linked.contains(source);
    let is_gone = |source: &&(String, String)| !sources.contains(source);
    let changed = sources.iter().find(is_new);
    match changed.or_else(|| linked.iter().find(is_gone)) {
        Some((name, _)) => Err(format!(
            "shaders/{name} has changed since the kernels were linked. Link them with `make shaders`, or \
             `cargo check --no-default-features --features link`."
        )
        .into()),
        None => compress(),
    }
}

/// Compresses each linked kernel to a file of its name in cargo's output folder.
fn compress() -> Result<(), Box<dyn Error>> {
    let folder = env::var("OUT_DIR")?;
    for entry in fs::read_dir("shaders/linked")? {
        let path = entry?.path();
        if let (Some(name), true) = (path.file_stem(), path.extension() == Some("wgsl".as_ref())) {
            let compressed = miniz_oxide::deflate::compress_to_vec(&fs::read(&path)?, LEVEL);
            let target = Path::new(&folder).join(name).with_extension("deflate");
            fs::write(target, compressed)?;
        }
    }
    Ok(())
}

/// Names of the sources below `folder`, and their checksums.
fn list(folder: &Path, sources: &mut Vec<(String, String)>) -> Result<(), Box<dyn Error>> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            list(&path, sources)?;
        } else if path.extension().is_some_and(|ending| ending == "wesl") {
            let name = path.strip_prefix("shaders")?.to_string_lossy();
            let bytes = fs::read(&path)?;
            let sum = format!("{} {}", checksum(&bytes), bytes.len());
            sources.push((name.replace('\\', "/"), sum));
        }
    }
    Ok(())
}

/// The CRC of POSIX's `cksum`, which takes the length in after the bytes.
fn checksum(bytes: &[u8]) -> u32 {
    let length = bytes.len().to_le_bytes();
    let length_end = length.iter().rposition(|byte| *byte != 0);
    let length = &length[..length_end.map_or(0, |last| last + 1)];
    let sum = bytes.iter().chain(length).fold(0_u32, |sum, byte| {
        (0..8).fold(sum ^ (u32::from(*byte) << 24), |sum, _| match sum >> 31 {
            0 => sum << 1,
            _ => (sum << 1) ^ 0x04c1_1db7,
        })
    });
    !sum
}

/// Writes what differs, so that an unchanged file keeps its time.
#[cfg(feature = "link")]
fn write(path: &str, text: &str) -> Result<(), Box<dyn Error>> {
    if fs::read_to_string(path).is_ok_and(|old| old == text) {
        return Ok(());
    }
    fs::create_dir_all("shaders/linked")?;
    Ok(fs::write(path, text)?)
}
