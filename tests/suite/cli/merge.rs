//! `merge`: parts of a picture.

use crate::support::program::Workspace;
use crate::support::verdict::Verdict;
use glimray::render::Film;
use std::fs;

#[test]
fn films_of_parts_merge_to_the_picture_of_one_run() {
    let workspace = Workspace::new();
    let render = "render a.scene --size 40x30 --samples 150 --quiet";
    let read = |name: &str| fs::read(workspace.path(name)).expect("a file");
    workspace.run(&format!("{render} -o one.png")).expect(0);
    workspace.run(&format!("{render} -o one.film")).expect(0);
    for part in [
        "--sample-count 64 -o a.film",
        "--sample-offset 64 --crop 0,0,40,11 -o b.film",
        "--sample-offset 64 --crop 0,11,40,30 -o c.film",
    ] {
        workspace.run(&format!("{render} {part}")).expect(0);
    }
    workspace
        .run("merge c.film a.film b.film -o all.film")
        .expect(0);
    workspace.run("merge all.film -o all.png").expect(0);
    assert!(read("all.film") == read("one.film"));
    assert!(read("all.png") == read("one.png"));

    let run = workspace.run("merge a.film c.film -o less.png").expect(8);
    let missing = "missing samples 64 to 149 of 40×11 pixels at 0,0";
    assert!(run.stderr.contains(missing), "{}", run.stderr);
    assert!(!workspace.path("less.png").exists());
    // The missing parts are printed as commands that render them.
    let command = "glimray render SCENE --integrator whitted --size 40x30 --samples 150 --sample-offset 64 --sample-count 86 \
                   --crop 0,0,40,11 -o missing-1.film\n";
    assert_eq!(run.text(), command);
    let flags = command
        .trim()
        .replace("glimray render SCENE", "render a.scene --quiet");
    workspace.run(&flags).expect(0);
    workspace
        .run("merge a.film c.film missing-1.film -o again.film")
        .expect(0);
    assert!(read("again.film") == read("one.film"));
    let run = workspace
        .run("merge a.film c.film --partial -o less.png")
        .expect(0);
    assert!(run.stderr.contains(missing), "{}", run.stderr);
    assert!(workspace.path("less.png").exists());
    let run = workspace
        .run("merge b.film a.film all.film -o more.film")
        .expect(3);
    assert!(run.stderr.contains("b.film and all.film"), "{}", run.stderr);
    let run = workspace
        .run("merge a.film all.film -o more.film")
        .expect(3);
    assert!(run.stderr.contains("overlap"), "{}", run.stderr);
    workspace
        .run(&format!("{render} --seed 1 --crop 0,0,40,11 -o d.film"))
        .expect(0);
    let run = workspace.run("merge a.film d.film -o other.film").expect(3);
    assert!(
        run.stderr.contains("differ in the settings"),
        "{}",
        run.stderr
    );
    workspace.run("merge a.film -o ./a.film").expect(4);
}

#[test]
fn damaged_films_and_invalid_parts_are_refused() {
    let workspace = Workspace::new();
    let render = "render a.scene --size 16x12 --samples 150 --quiet";
    workspace.run(&format!("{render} -o a.film")).expect(0);
    let bytes = fs::read(workspace.path("a.film")).expect("a film");
    fs::write(workspace.path("short.film"), &bytes[..bytes.len() / 2]).expect("written");
    let mut damaged = bytes.clone();
    damaged[bytes.len() / 2] ^= 1;
    fs::write(workspace.path("damaged.film"), damaged).expect("written");
    for (name, why) in [
        ("short.film", "cut short"),
        ("damaged.film", "damaged"),
        ("a.scene", "not a film"),
        ("gone.film", "gone.film"),
    ] {
        let run = workspace.run(&format!("merge {name} -o out.png")).expect(3);
        assert!(run.stderr.contains(why), "{}", run.stderr);
    }
    for (flags, why) in [
        ("--sample-offset 64 -o part.png", "only a film"),
        ("--sample-offset 10 -o part.film", "multiple of 64"),
        ("--sample-count 10 -o part.film", "multiple of 64"),
        ("--sample-offset 192 -o part.film", "0 to 149"),
        (
            "--antialias adaptive --sample-count 64 -o part.film",
            "adaptive",
        ),
    ] {
        let run = workspace.run(&format!("{render} {flags}")).expect(2);
        assert!(run.stderr.contains(why), "{}", run.stderr);
    }
    assert_eq!(workspace.made(), ["a.film", "damaged.film", "short.film"]);
}

#[test]
fn damage_to_the_head_of_a_film_is_not_taken_for_missing_samples() {
    let workspace = Workspace::new();
    workspace
        .run("render a.scene --size 40x30 --samples 128 --sample-count 64 --quiet -o a.film")
        .expect(0);
    workspace.run("merge a.film -o a.png").expect(8);
    let film = workspace.read("a.film");
    let sums = 40 * 30 * 4 * size_of::<f32>();
    let head = film.len() - size_of::<u128>() - sums;
    let coverage_bytes = 32;
    let mut verdict = Verdict::on("damaged films");
    // The coverage is at its end: rows, columns and samples, each from and to, with two counts between.
    for at in head - coverage_bytes..head {
        for bit in [0, 3] {
            let mut damaged = film.clone();
            damaged[at] ^= 1 << bit;
            workspace.write("b.film", damaged);
            let run = workspace.run("merge b.film -o b.png");
            verdict.that(format!("bit {bit} of {at}"), run.code == Some(3), || {
                format!("{:?}: {}", run.code, run.stderr)
            });
        }
    }
    verdict.close();
}

/// The checksum of the forged films is right.
#[test]
fn sizes_that_no_picture_has_are_the_films_fault() {
    let workspace = Workspace::new();
    workspace
        .run("render a.scene --size 3x2 --samples 1 -o a.film")
        .expect(0);
    let film = workspace.read("a.film");
    // Signature, version, name of the program, and three fingerprints.
    let name = u32::from_le_bytes(film[12..16].try_into().expect("four bytes"));
    let at = 16 + name as usize + 48;
    assert_eq!(film[at..at + 8], [3, 0, 0, 0, 2, 0, 0, 0]);
    let mut verdict = Verdict::on("forged sizes");
    for (side, width) in [(0, 0), (0, 1_000_001), (1, 0), (1, u32::MAX)] {
        let mut forged = film.clone();
        forged[at + 4 * side..][..4].copy_from_slice(&width.to_le_bytes());
        let end = forged.len() - 16;
        let sum = xxhash_rust::xxh3::xxh3_128(&forged[..end]);
        forged[end..].copy_from_slice(&sum.to_le_bytes());
        workspace.write("forged.film", forged);
        for line in [
            "merge forged.film -o b.png",
            "merge forged.film --partial -o b.jpg",
        ] {
            let run = workspace.run(line);
            let is_said = run.stderr.contains("its size is invalid");
            verdict.that(
                format!("{line}, {width}"),
                run.code == Some(3) && is_said,
                || format!("{run:?}"),
            );
        }
    }
    verdict.close();
}

#[test]
fn a_film_names_its_adapter_with_backend_and_driver() {
    let workspace = Workspace::new();
    let run = workspace
        .run("render a.scene --size 8x6 --samples 1 --quiet --report - -o a.film")
        .expect(0);
    let report = run.json();
    let film = Film::read(&workspace.read("a.film")[..]).expect("a film");
    let adapters: Vec<_> = film.header().adapters.iter().collect();
    let [adapter] = adapters[..] else {
        panic!("{adapters:?}");
    };
    for key in ["name", "backend", "driver"] {
        let part = report["adapter"][key].as_str().expect(key);
        assert!(adapter.contains(part), "{adapter} lacks {part}");
    }
}
