//! The fuzz targets on what they start from, on what they found (seeds, corpora and regressions), and on files that are
//! changed at random: `GLIMRAY_FUZZ_FILES=10000 cargo test --profile ci --test suite fuzz::changed`.

mod kept;
mod mutate;
#[path = "../fuzz/harness.rs"]
mod targets;

use crate::support::random::Random;
use glimray::import::{Archive, Resolver};
use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::time::{Duration, Instant};

/// Time for one file, which is small. The fuzzer has the same limit.
const MOST_TIME: Duration = Duration::from_secs(10);

/// Memory for one file in bytes, as the fuzzer's.
const MOST_MEMORY: u64 = 2 << 30;

/// Files that are changed if `GLIMRAY_FUZZ_FILES` does not say how many.
const CHANGED_FILES: usize = 320;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Names and contents of the files that the target starts from, or that once failed.
fn inputs(target: &str) -> Vec<(String, Vec<u8>)> {
    let mut inputs = good_inputs(target);
    inputs.extend(in_folder(&format!("tests/fuzz/regressions/{target}")));
    let corpus = root().join("tests/fuzz/corpus").join(target);
    let corpus = corpus.with_extension("zip");
    if let Ok(bytes) = fs::read(&corpus) {
        let corpus = Archive::new(bytes).expect("an archive");
        for name in corpus.names() {
            let bytes = corpus.read(name, u64::MAX).expect("a file");
            inputs.push((format!("{target}.zip, {}", name.display()), bytes));
        }
    }
    inputs
}

/// Names and contents of all files in a folder, in order; none if it does not exist.
fn in_folder(folder: &str) -> Vec<(String, Vec<u8>)> {
    let entries = fs::read_dir(root().join(folder)).into_iter().flatten();
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let mut files: Vec<_> = (paths.filter(|path| path.is_file()))
        .map(|path| (path.display().to_string(), fs::read(&path).expect("a file")))
        .collect();
    files.sort();
    files
}

/// Names and contents of the files that the target starts from, without those that it has found since.
fn good_inputs(target: &str) -> Vec<(String, Vec<u8>)> {
    let mut inputs = in_folder(&format!("tests/fuzz/seeds/{target}"));
    let (folder, endings): (&str, &[&str]) = match target {
        "native" => ("assets/scenes", &["toml"]),
        "course" => ("assets/scenes", &["scene"]),
        "nff" => ("assets/scenes", &["nff"]),
        "glb" => ("tests/encoded", &["glb"]),
        "picture" => ("tests/encoded", &["ktx2", "webp"]),
        _ => ("tests/encoded", &[]),
    };
    let has_ending = |name: &str| {
        let ending = name.rsplit_once('.').map_or("", |(_, ending)| ending);
        endings.contains(&ending)
    };
    inputs.extend(
        in_folder(folder)
            .into_iter()
            .filter(|(name, _)| has_ending(name)),
    );
    inputs
}

/// A seed that is refused at once would test nothing.
#[test]
fn every_seed_is_accepted() {
    for (target, run) in targets::TARGETS {
        let mut accepted = 0;
        for (name, bytes) in good_inputs(target) {
            let is_accepted = run(&bytes);
            accepted += usize::from(is_accepted);
            // Scenes among the assets may need files that are not there.
            let is_seed = name.contains("fuzz/seeds");
            assert!(
                is_accepted || !is_seed,
                "{target} refuses {name}. {}",
                kept::UPDATE
            );
        }
        assert!(accepted > 0, "{target} accepts nothing that it starts from");
    }
}

/// Files of every format with random changes are read or refused in one line, in bounded time and memory.
#[test]
fn changed_files_of_every_format_are_read_or_refused() {
    let asked = std::env::var("GLIMRAY_FUZZ_FILES").ok();
    let count = asked
        .as_ref()
        .map_or(CHANGED_FILES, |count| count.parse().expect("a number"));
    let finds = Path::new(env!("CARGO_TARGET_TMPDIR")).join("fuzz");
    fs::create_dir_all(&finds).expect("a folder");
    let mut kinds: Vec<Kind> = (targets::TARGETS.iter())
        .map(|&(name, run)| Kind {
            name,
            good: good_inputs(name),
            all: inputs(name),
            run: Box::new(run),
            accepted: 0,
        })
        .collect();
    let manifests = kept::Manifests::new();
    let mut checkpoints = kept::Checkpoints::new();
    let of_render: Vec<_> = (checkpoints.good.iter())
        .map(|it| ("a checkpoint".into(), it.clone()))
        .collect();
    kinds.push(Kind {
        name: "manifest",
        good: vec![("a manifest".into(), manifests.good.clone())],
        all: vec![("a manifest".into(), manifests.good.clone())],
        run: Box::new(move |bytes| manifests.read(bytes)),
        accepted: 0,
    });
    kinds.push(Kind {
        name: "checkpoint",
        good: of_render.clone(),
        all: of_render,
        run: Box::new(move |bytes| checkpoints.read(bytes)),
        accepted: 0,
    });
    let mut failures = Vec::new();
    for number in 0..count {
        let of_kinds = kinds.len();
        let kind = &mut kinds[number % of_kinds];
        let mut random = Random::new(number as u64);
        // Most of what the fuzzer has found is refused early.
        let [(_, bytes), (_, other)] = [(); 2].map(|()| {
            let files = [&kind.good, &kind.all][random.below(2)];
            &files[random.below(files.len())]
        });
        let changed = mutate::mutated(kind.name, bytes, other, &mut random);
        let find = finds.join(format!("{}-{number}", kind.name));
        if asked.is_some() {
            // A file that ends the process is found here.
            fs::write(&find, &changed).expect("a file");
        }
        let before = memory_before();
        let started = Instant::now();
        let outcome = catch_unwind(AssertUnwindSafe(|| (kind.run)(&changed)));
        let took = started.elapsed();
        // Other tests run beside this one unless it is asked for.
        let memory = before
            .filter(|_| asked.is_some())
            .map(|before| peak_memory().saturating_sub(before));
        kind.accepted += usize::from(matches!(outcome, Ok(true)));
        if outcome.is_ok() && took < MOST_TIME && memory.is_none_or(|memory| memory < MOST_MEMORY) {
            let _ = fs::remove_file(&find);
            continue;
        }
        fs::write(&find, &changed).expect("a file");
        failures.push(format!(
            "{}: {took:?}, {memory:?} bytes, {}",
            find.display(),
            outcome.is_ok()
        ));
    }
    assert_eq!(failures, [""; 0], "of {count} files");
    // If most were refused at once, nothing behind that would be tested.
    let accepted = kinds.iter().map(|kind| kind.accepted).sum::<usize>();
    assert!(
        accepted * 6 > count,
        "{accepted} of {count} files are accepted"
    );
    for kind in kinds.iter().filter(|_| count >= 5000) {
        let name = kind.name;
        assert!(kind.accepted > 0, "{name}: no changed file is accepted");
    }
}

/// Reads a file and returns whether it was accepted.
type Reader = Box<dyn FnMut(&[u8]) -> bool>;

/// Files of a kind, and the function that reads one.
struct Kind {
    name: &'static str,
    good: Vec<(String, Vec<u8>)>,
    /// With those that the fuzzer has found.
    all: Vec<(String, Vec<u8>)>,
    run: Reader,
    accepted: usize,
}

/// Memory of this process in bytes, from which [`peak_memory`] is counted anew; `None` where the system does not count.
fn memory_before() -> Option<u64> {
    fs::write("/proc/self/clear_refs", "5").ok()?;
    Some(peak_memory())
}

fn peak_memory() -> u64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kibibytes = line.and_then(|line| line.trim().strip_suffix(" kB")?.parse::<u64>().ok());
    kibibytes.unwrap_or_default() << 10
}

#[test]
fn what_the_fuzzer_found_is_read_or_refused_in_one_line() {
    for (target, run) in targets::TARGETS {
        let inputs = inputs(target);
        assert!(!inputs.is_empty(), "{target} has nothing to start from");
        for (name, bytes) in inputs {
            let started = Instant::now();
            let outcome = catch_unwind(|| run(&bytes));
            assert!(outcome.is_ok(), "{target} fails with {name}");
            let took = started.elapsed();
            assert!(took < MOST_TIME, "{target} takes {took:?} with {name}");
        }
    }
}

/// Seeds that are refused at once would tell nothing of poses.
#[test]
fn the_poses_that_the_fuzzer_starts_from_are_of_deforming_meshes() {
    let seeds = fs::read_dir(root().join("tests/fuzz/seeds/poses")).expect("a folder");
    for seed in seeds {
        let path = seed.expect("an entry").path();
        let bytes = fs::read(&path).expect("a file");
        let scene = targets::poses::model(&bytes[16..]).expect("a model");
        // One of them is far larger than f32 can light.
        let mut notes = scene.skipped.iter();
        let is_sized = notes.all(|note| note.starts_with("the scene measures"));
        assert!(is_sized, "{}: {:?}", path.display(), scene.skipped);
        assert_eq!(scene.deformations.len(), 1, "{}", path.display());
        assert_eq!(scene.tracks.len(), 9, "{}", path.display());
        assert!(scene.frame(0.7) != scene.frame(0.0), "{}", path.display());
    }
}

#[test]
fn every_target_is_built() {
    let folder = root().join("fuzz");
    if !folder.is_dir() {
        // A package holds no other packages.
        return;
    }
    let manifest = fs::read_to_string(folder.join("Cargo.toml")).expect("the manifest");
    for (target, _) in targets::TARGETS {
        let program = format!("name = \"{target}\"\npath = \"targets/{target}.rs\"\n");
        assert!(manifest.contains(&program), "{target} is not in Cargo.toml");
        let path = folder.join("targets").join(target).with_extension("rs");
        let text = fs::read_to_string(&path).expect("a target");
        let call = format!("glimray_fuzz::{target}(bytes)");
        assert!(text.contains(&call), "{} calls another", path.display());
    }
    let count = manifest.matches("[[bin]]").count();
    assert_eq!(count, targets::TARGETS.len(), "programs without a target");
}
