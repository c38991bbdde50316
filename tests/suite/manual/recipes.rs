//! The recipes for continuous integration run as they stand on the page, in a folder of small scenes.

use super::pages::Page;
use crate::support::program::{Run, Workspace};
use std::fs;
use std::os::unix::fs::{PermissionsExt, symlink};
use std::path::Path;
use std::process::Command;

const PAGE: &str = "docs/src/guide/ci.md";

/// A small scene with `objects` in it.
fn scene(objects: &str) -> String {
    format!(
        "[output]\nsize = [32, 24]\n[camera]\nlook_from = [0, 0, 5]\nlook_at = [0, 0, 0]\n\
         [[lights]]\npoint = {{ position = [2, 2, 4] }}\n{objects}"
    )
}

const BALL: &str = "[[objects]]\nsphere = { center = [0, 0, 0], radius = 1 }\n";

/// A checkout as the page describes it, with `commands` on the path and the blocks of shell of the page.
struct Checkout {
    workspace: Workspace,
    blocks: Vec<String>,
}

impl Checkout {
    fn new() -> Self {
        let workspace = Workspace::new();
        for folder in ["bin", "scenes", "reference"] {
            fs::create_dir(workspace.path(folder)).expect("a folder");
        }
        let program = Path::new(env!("CARGO_BIN_EXE_glimray"));
        symlink(program, workspace.path("bin/glimray")).expect("a link");
        workspace.write("scene.toml", scene(BALL));
        for name in ["ball", "other"] {
            workspace.write(&format!("scenes/{name}.toml"), scene(BALL));
            let line = format!("render scenes/{name}.toml --quiet -o reference/{name}.png");
            workspace.run(&line).expect(0);
        }
        let page = Page::read(PAGE);
        let blocks = page.blocks().into_iter();
        let blocks = blocks.filter(|block| block.language == "sh");
        let blocks = blocks.map(|block| block.text.to_owned()).collect();
        Self { workspace, blocks }
    }

    /// The only block with `words` in it.
    fn block(&self, words: &str) -> &str {
        let mut found = self.blocks.iter().filter(|block| block.contains(words));
        let block = found.next().expect(words);
        assert!(found.next().is_none(), "{words} is in several blocks");
        block
    }

    /// Writes a program that is not part of the project, for `bin`.
    fn stub(&self, name: &str, script: &str) {
        let path = format!("bin/{name}");
        self.workspace
            .write(&path, format!("#!/bin/bash\n{script}\n"));
        let may_run = fs::Permissions::from_mode(0o755);
        fs::set_permissions(self.workspace.path(&path), may_run).expect("permissions");
    }

    /// Runs a script as CI does.
    fn bash(&self, script: &str) -> Run {
        let bin = self.workspace.path("bin");
        let path = std::env::var("PATH").expect("a path");
        let mut bash = Command::new("bash");
        bash.args(["-e", "-c", script]);
        bash.env("PATH", format!("{}:{path}", bin.display()));
        bash.env("GITHUB_PATH", self.workspace.path("github-path"));
        bash.env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY");
        bash.current_dir(self.workspace.path("."));
        Run::from(bash.output().expect("bash runs"))
    }

    /// The script that the page says to save.
    fn save_script(&self) {
        let script = self.block("for scene in");
        self.workspace.write("pictures.sh", script);
    }
}

#[test]
fn every_recipe_but_those_of_the_container_runs_as_it_stands() {
    let checkout = Checkout::new();
    // As the page says: the reference is made by the same command.
    let first = checkout.block("-o new.png");
    let render = first.lines().next().expect("a line");
    checkout
        .bash(&render.replace("new.png", "reference.png"))
        .expect(0);
    let cargo = "[ \"$*\" = \"$WANTED\" ] && mkdir -p tools/bin && ln -s \"$(command -v glimray)\" tools/bin/glimray";
    let install = checkout.block("cargo install");
    let line = install
        .lines()
        .find_map(|line| line.trim().strip_prefix("cargo "));
    checkout.stub("cargo", &cargo.replace("$WANTED", line.expect("a command")));
    let mut count = 0;
    for block in &checkout.blocks {
        if block.contains("docker ") {
            continue;
        }
        checkout.bash(block).expect(0);
        count += 1;
    }
    assert_eq!(count, checkout.blocks.len() - 1);
    for name in [
        "new.png",
        "new/ball.png",
        "night.exr",
        "picture.png",
        "tools/bin/glimray",
    ] {
        assert!(checkout.workspace.path(name).exists(), "{name}");
    }
}

#[test]
fn a_broken_and_a_changed_scene_fail_after_all_others_were_compared() {
    let checkout = Checkout::new();
    let workspace = &checkout.workspace;
    workspace.write("scenes/a-broken.toml", "no scene");
    workspace.write(
        "scenes/ball.toml",
        scene(&BALL.replace("radius = 1", "radius = 1.2")),
    );
    checkout.save_script();
    let run = checkout.bash("bash pictures.sh").expect(1);
    run.says("error: ");
    run.says("not rendered: a-broken");
    let row = |name: &str| {
        let mut rows = run.text().lines().filter(|line| line.starts_with(name));
        rows.next().expect(name).to_owned()
    };
    assert!(
        row("ball.png").contains(" % of pixels differ by more than "),
        "{}",
        run.text()
    );
    assert!(row("other.png").ends_with("  ok"), "{}", run.text());
    assert_eq!(workspace.names("difference"), ["ball.png"]);

    // A picture that is only changed is told by the exit code of `compare`.
    fs::remove_file(workspace.path("scenes/a-broken.toml")).expect("removed");
    checkout.bash("bash pictures.sh").expect(8);
    checkout
        .bash("cp new/* reference && bash pictures.sh")
        .expect(0);
}

#[test]
fn the_steps_of_the_workflow_run_one_after_the_other() {
    let checkout = Checkout::new();
    checkout.save_script();
    // They are part of the machines that the workflow runs on.
    checkout.stub("sudo", "[ \"$1\" = apt-get ]");
    checkout.stub("rustup", "[ \"$*\" = \"update stable\" ]");
    let program = env!("CARGO_BIN_EXE_glimray");
    let install = checkout.block("cargo install");
    let line = install
        .lines()
        .find_map(|line| line.trim().strip_prefix("cargo "));
    let line = line.expect("a command");
    // Both recipes build the same program.
    checkout.stub(
        "cargo",
        &format!("[ \"$*\" = \"+stable {line}\" ] && mkdir -p tools/bin && ln -s {program} tools/bin/glimray"),
    );
    fs::remove_file(checkout.workspace.path("bin/glimray")).expect("removed");
    let page = Page::read(PAGE);
    let blocks = page.blocks();
    let workflow = blocks.iter().find(|block| block.language == "yaml");
    let lines = workflow.expect("a workflow").text.lines();
    let steps = lines.filter_map(|line| line.trim().trim_start_matches("- ").strip_prefix("run: "));
    let mut count = 0;
    for step in steps {
        // Each step finds what those before have added to the path.
        let path = "[ ! -e github-path ] || PATH=\"$(cat github-path):$PATH\"";
        checkout.bash(&format!("{path}\n{step}")).expect(0);
        count += 1;
    }
    assert_eq!(count, 5);
    assert_eq!(checkout.workspace.names("new"), ["ball.png", "other.png"]);
}
