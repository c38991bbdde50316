//! Help texts, shell completions and the schema.

use crate::support::program::{Run, Workspace};
use crate::support::verdict::Verdict;

#[test]
fn no_arguments_show_the_help_and_exit_2() {
    let run = Workspace::new().run("").expect(2);
    assert!(
        run.stderr.contains("Usage: glimray <COMMAND>"),
        "{}",
        run.stderr
    );
}

#[test]
fn help_and_version_go_to_standard_output() {
    let workspace = Workspace::new();
    let help = workspace.run("--help").expect(0);
    assert!(help.text().contains("Exit codes") && help.stderr.is_empty());
    let version = workspace.run("--version").expect(0);
    assert_eq!(
        version.text(),
        format!("glimray {}\n", env!("CARGO_PKG_VERSION"))
    );
}

#[test]
fn help_documents_every_promised_flag_and_has_an_example() {
    let device = "--adapter --backend --memory-limit";
    let log = "--report --count-rays --progress --quiet -q --verbose -v";
    let output = "-o --output --format --quality --no-clobber";
    let picture = "--antialias --filter --filter-radius --light-samples --integrator --triangle-test --offset --no-bvh --exposure --tone --transfer \
        --seed --crop --camera --fov-y --orthographic --look-from --look-at --up --background --environment noon sunset overcast studio ring furnace";
    let reading = "--strict --set --allow-dir";
    let size = "--size --samples";
    let motion = "--fps --shutter";
    let frames = "--frames --step --loop --frames-dir --keep-frames --discard-frames --encode-only";
    let turn = "--seconds --axis --elevation --fov-y --margin --clockwise --background";
    let workspace = Workspace::new();
    for (command, flags) in [
        ("demo", [output, size, device, log].join(" ")),
        (
            "render",
            [
                output,
                "--sample-offset --sample-count",
                size,
                picture,
                "--frame --time",
                motion,
                reading,
                device,
                log,
            ]
            .join(" "),
        ),
        (
            "animate",
            [output, frames, size, picture, motion, reading, device, log].join(" "),
        ),
        (
            "turntable",
            [output, turn, size, motion, reading, device, log].join(" "),
        ),
        (
            "sheet",
            [
                output,
                "--size --views front back left right top bottom front-right back-left",
                "--samples --integrator --tone --environment --background --section --up",
                reading,
                device,
                log,
            ]
            .join(" "),
        ),
        ("thumbnail", ["-o --output --size --up", device].join(" ")),
        ("convert", ["--output --no-clobber", reading].join(" ")),
        (
            "merge",
            [output, "--exposure --tone --transfer", device].join(" "),
        ),
        ("inspect", ["--json", reading].join(" ")),
        (
            "explain",
            [
                "--pixel --sample --json --obj",
                size,
                picture,
                "--frame --time",
                motion,
                reading,
                device,
            ]
            .join(" "),
        ),
        ("doctor", ["--json", device].join(" ")),
        (
            "compare",
            "--tolerance --max-share --flip --diff --json".into(),
        ),
        (
            "bench",
            ["--json --repeats --only --quick --compare", device].join(" "),
        ),
        ("completions", "bash zsh fish".into()),
        ("man", "<DIR>".into()),
        (
            "schema",
            "scene report compare inspect explain --help".into(),
        ),
    ] {
        let help = workspace.run(&format!("{command} --help")).expect(0);
        let words: Vec<_> = help
            .text()
            .split(|c: char| c.is_whitespace() || ",[]".contains(c))
            .map(|word| word.trim_end_matches(':'))
            .collect();
        for flag in flags.split_whitespace() {
            assert!(
                words.contains(&flag),
                "{command} --help does not mention {flag}"
            );
        }
        assert!(
            help.text().contains("Example"),
            "{command} --help has no example"
        );
    }
}

#[test]
fn completions_and_schema_are_printed() {
    let workspace = Workspace::new();
    for (shell, mark) in [
        ("bash", "complete -F _glimray"),
        ("zsh", "#compdef glimray"),
        ("fish", "complete -c glimray"),
    ] {
        let run = workspace.run(&format!("completions {shell}")).expect(0);
        assert!(run.text().contains(mark), "{shell}");
        assert!(run.text().contains("triangle-test"), "{shell}");
    }
    workspace.run("completions tcsh").expect(2);
    let schema = workspace.run("schema").expect(0).json();
    assert!(schema["$schema"].is_string(), "{schema}");
}

/// All commands that `glimray --help` lists, with their summaries, each as one line of the list.
fn commands(workspace: &Workspace) -> Vec<(String, String)> {
    let help = workspace.run("--help").expect(0);
    let (_, list) = help.text().split_once("Commands:\n").expect("a list");
    let lines = list.lines().take_while(|line| !line.is_empty());
    let entries = lines.map(|line| line.trim().split_once("  ").unwrap_or(("", line)));
    entries
        .map(|(name, summary)| (name.to_owned(), summary.trim().to_owned()))
        .collect()
}

#[test]
fn every_command_has_a_summary_of_one_line() {
    let workspace = Workspace::new();
    let commands = commands(&workspace);
    assert!(commands.len() >= 12, "{commands:?}");
    let mut verdict = Verdict::on("summaries");
    for (name, summary) in &commands {
        // A continued line has no name, and a summary of several sentences has a full stop.
        let is_line = !name.is_empty() && !summary.is_empty() && !summary.contains(". ");
        verdict.that(name, is_line, || summary.clone());
    }
    verdict.close();
}

#[test]
fn help_is_wrapped_between_words() {
    const NARROW: usize = 60;
    let workspace = Workspace::new();
    let mut verdict = Verdict::on("help");
    let commands = commands(&workspace).into_iter().map(|(name, _)| name);
    for name in commands.filter(|name| name != "help") {
        let help = |columns: usize| {
            let mut command = workspace.command(&format!("{name} --help"));
            let output = command.env("COLUMNS", columns.to_string()).output();
            Run::from(output.expect("glimray runs")).expect(0)
        };
        let (narrow, wide) = (help(NARROW), help(100));
        let words = |run: &Run| {
            let words = run.text().split_whitespace().map(str::to_owned);
            words.collect::<Vec<_>>()
        };
        verdict.that(&name, words(&narrow) == words(&wide), || "a word is broken");
        for line in narrow.text().lines() {
            let is_short = line.chars().count() <= NARROW || !line.trim().contains(' ');
            verdict.that(&name, is_short, || line.to_owned());
        }
    }
    verdict.close();
}
