//! Embeds the linked kernels in release builds, compressed. Such a build fails if a source has changed since they were
//! linked. Other builds read them at run time, where there are files; a test compares them with the sources.

mod sources;

use sources::{SOURCES, sums};
use std::{env, error::Error, fmt::Write, fs, path::Path, process::ExitCode};

/// How hard DEFLATE tries: higher levels take longer and save a few kilobytes.
const LEVEL: u8 = 6;

fn main() -> ExitCode {
    println!("cargo::rustc-check-cfg=cfg(embedded)");
    let is_release = env::var("PROFILE").is_ok_and(|profile| profile == "release");
    let is_browser = env::var("CARGO_CFG_TARGET_ARCH").is_ok_and(|arch| arch == "wasm32");
    if !is_release && !is_browser {
        println!("cargo::rerun-if-changed=build.rs");
        return ExitCode::SUCCESS;
    }
    println!("cargo::rustc-cfg=embedded");
    for path in [
        "build.rs",
        "sources.rs",
        "bindings.wesl",
        "types.wesl",
        "types",
        "lib",
        "scene",
        "kernels",
        "linked",
    ] {
        println!("cargo::rerun-if-changed={path}");
    }
    match check_sources().and_then(|()| embed()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

/// # Errors
/// A source is not the one that was linked.
fn check_sources() -> Result<(), Box<dyn Error>> {
    let sources = sums(Path::new("."))?;
    let linked = fs::read_to_string(SOURCES).map_err(|error| {
        format!("shaders/{SOURCES}: {error}. Link the kernels with `make shaders`.")
    })?;
    let linked = linked.lines().filter_map(|line| line.rsplit_once(' '));
    let linked: Vec<(String, String)> = linked
        .map(|(sum, name)| (name.into(), sum.into()))
        .collect();
    let is_new = |source: &&(String, String)| !linked.contains(source);
    let is_gone = |source: &&(String, String)| !sources.contains(source);
    let changed = sources.iter().find(is_new);
    match changed.or_else(|| linked.iter().find(is_gone)) {
        Some((name, _)) => Err(format!(
            "shaders/{name} has changed since the kernels were linked. Link them with `make shaders`."
        )
        .into()),
        None => Ok(()),
    }
}

/// Compresses each linked kernel, and the overrides, to a file in cargo's output folder, and lists them there.
fn embed() -> Result<(), Box<dyn Error>> {
    let folder = env::var("OUT_DIR")?;
    let mut paths = vec!["bindings.wesl".to_owned()];
    for entry in fs::read_dir("linked")? {
        let name = entry?.file_name().to_string_lossy().into_owned();
        if name.ends_with(".wgsl") {
            paths.push(format!("linked/{name}"));
        }
    }
    let mut table = String::from("static EMBEDDED: &[(&str, &[u8])] = &[\n");
    for path in paths {
        let compressed = miniz_oxide::deflate::compress_to_vec(&fs::read(&path)?, LEVEL);
        let target = Path::new(&folder).join(path.replace('/', "_"));
        fs::write(&target, compressed)?;
        writeln!(table, "({path:?}, include_bytes!({target:?})),")?;
    }
    fs::write(Path::new(&folder).join("embedded.rs"), table + "];\n")?;
    Ok(())
}
