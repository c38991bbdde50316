//! Parts of pictures at scale: random cuts whose processes are killed at random, and a thousand films at once.

use crate::support::program::{Run, Workspace};
use crate::support::random::Random;
use crate::support::verdict::Verdict;
use glimray::render::Film;
use std::collections::VecDeque;
use std::fs::File;
use std::io::BufWriter;
use std::process::Command;
use std::thread::sleep;
use std::time::Duration;

/// A part of a picture: x0, y0, x1, y1, and the first block of samples and the one after the last.
type Piece = ([u32; 4], [u32; 2]);

const SIZE: [u32; 2] = [72, 54];
const BLOCKS: u32 = 5;

/// Cuts the picture at random, again and again, between columns, rows or blocks of samples.
fn cut(random: &mut Random, count: usize) -> Vec<Piece> {
    let mut pieces = vec![([0, 0, SIZE[0], SIZE[1]], [0, BLOCKS])];
    while pieces.len() < count {
        let index = random.below(pieces.len());
        let (crop, samples) = pieces[index];
        let [x0, y0, x1, y1] = crop;
        let mut between = |low: u32, high: u32| match high - low {
            0 | 1 => None,
            length => Some(low + 1 + random.below(length as usize - 1) as u32),
        };
        let halves = match pieces.len() % 3 {
            0 => between(x0, x1).map(|x| [([x0, y0, x, y1], samples), ([x, y0, x1, y1], samples)]),
            1 => between(y0, y1).map(|y| [([x0, y0, x1, y], samples), ([x0, y, x1, y1], samples)]),
            _ => between(samples[0], samples[1])
                .map(|block| [(crop, [samples[0], block]), (crop, [block, samples[1]])]),
        };
        // The smallest pieces cannot be cut; another one then is.
        if let Some(halves) = halves {
            pieces.swap_remove(index);
            pieces.extend(halves);
        } else if random.below(8) == 0 {
            break;
        }
    }
    for last in (1..pieces.len()).rev() {
        pieces.swap(last, random.below(last + 1));
    }
    pieces
}

#[test]
fn random_cuts_killed_at_random_merge_to_the_bytes_of_one_run() {
    let workspace = Workspace::new();
    let flags = format!(
        "render a.scene --size {}x{} --samples {} --integrator path --quiet",
        SIZE[0],
        SIZE[1],
        64 * BLOCKS
    );
    workspace.run(&format!("{flags} -o one.film")).expect(0);
    let one = workspace.read("one.film");
    let mut random = Random::new(2026);
    let mut verdict = Verdict::on("random cuts");
    let mut killed = 0;
    for round in 0..8 {
        let pieces = cut(&mut random, 3 + round % 5);
        let mut waiting: VecDeque<usize> = (0..pieces.len()).collect();
        while let Some(number) = waiting.pop_front() {
            let ([x0, y0, x1, y1], [start, end]) = pieces[number];
            let child = workspace.start(&format!(
                "{flags} --crop {x0},{y0},{x1},{y1} --sample-offset {} --sample-count {} --checkpoint {number}.ckpt \
                 --every 0.05 -o {number}.film",
                64 * start,
                64 * (end - start)
            ));
            let id = child.id().to_string();
            if random.below(2) == 0 {
                // A process takes some 0.2 s.
                sleep(Duration::from_secs_f64(random.between(0.0, 0.3)));
                let _ = Command::new("kill").args(["-KILL", &id]).status();
            }
            let run = Run::from(child.wait_with_output().expect("it ends"));
            match run.code {
                // Killed: it is tried again after the others.
                None => {
                    killed += 1;
                    waiting.push_back(number);
                }
                code => assert_eq!(code, Some(0), "{}", run.stderr),
            }
        }
        let films: String = (0..pieces.len())
            .map(|number| format!("{number}.film "))
            .collect();
        workspace
            .run(&format!("merge {films} -o all.film"))
            .expect(0);
        let is_same = workspace.read("all.film") == one;
        verdict.that(format!("round {round}"), is_same, || format!("{pieces:?}"));
        for number in 0..pieces.len() {
            std::fs::remove_file(workspace.path(&format!("{number}.film"))).expect("a film");
        }
    }
    verdict.close();
    assert!(killed >= 4, "only {killed} processes were killed");
    assert_eq!(workspace.made(), ["all.film", "one.film"]);
}

/// The command, with this many kilobytes of address space for what it allocates.
fn within(workspace: &Workspace, kilobytes: u64, line: &str) -> Run {
    let program = workspace.command("").get_program().to_owned();
    let mut shell = Command::new("sh");
    shell
        .args(["-c", &format!("ulimit -d {kilobytes}; exec \"$G\" {line}")])
        .env("G", program)
        .current_dir(workspace.path("."));
    Run::from(shell.output().expect("a shell"))
}

#[cfg(target_os = "linux")]
#[test]
fn a_thousand_parts_merge_in_the_memory_of_one() {
    let workspace = Workspace::new();
    let (side, parts) = (128, 1000);
    workspace
        .run(&format!(
            "render a.scene --size {side}x{side} --samples {} --sample-count 64 --quiet -o a.film",
            64 * parts
        ))
        .expect(0);
    let first = Film::read(&*workspace.read("a.film")).expect("a film");
    let region = [0, 0, side, side];
    let mut films = Vec::new();
    for number in 1..parts {
        let samples = 64 * number..64 * (number + 1);
        // Black, but each of other samples.
        let part = first.outline().part(region, samples).expect("whole blocks");
        let name = format!("{number}.film");
        let file = File::create(workspace.path(&name)).expect("a file");
        part.blank().write(BufWriter::new(file)).expect("written");
        films.push(name);
    }
    let all: u64 = (films.iter())
        .map(|name| workspace.path(name).metadata().expect("a file").len())
        .sum();
    assert!(all > 250_000_000, "{all}");
    // The sums of the picture take 1 MB. All films would take 262 MB.
    let line = format!("merge a.film {} -o all.film", films.join(" "));
    within(&workspace, 64 << 10, &line).expect(0);
    let merged = Film::read(&*workspace.read("all.film")).expect("a film");
    let missing = merged.missing();
    assert!(missing.is_empty(), "{missing:?}");
    let whole = first.outline().part(region, 0..64 * parts);
    let mut expected = whole.expect("whole blocks").blank();
    expected.add(&first);
    assert!(merged == expected);

    // A gap and an overlap among so many are found before any sums are read.
    let without: Vec<_> = films.iter().filter(|name| *name != "500.film").collect();
    let without: Vec<_> = without.iter().map(|name| name.as_str()).collect();
    let run = within(
        &workspace,
        64 << 10,
        &format!("merge a.film {} -o less.film", without.join(" ")),
    );
    let run = run.expect(8);
    let wanted = "--sample-offset 32000 --sample-count 64 -o missing-1.film";
    assert!(run.text().contains(wanted), "{}", run.text());
    std::fs::copy(workspace.path("7.film"), workspace.path("again.film")).expect("copied");
    let run = within(
        &workspace,
        64 << 10,
        &format!("merge {} again.film -o more.film", films.join(" ")),
    );
    run.expect(3).says("7.film and again.film");
}
