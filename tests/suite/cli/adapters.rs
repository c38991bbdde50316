//! Choosing an adapter, and `doctor`.

use crate::support::program::{Run, Workspace};
use crate::support::skip::{Need, skip};
use serde_json::Value;
use std::path::Path;

#[cfg(target_os = "linux")]
#[test]
fn without_an_adapter_the_exit_code_is_5_and_doctor_names_packages() {
    let workspace = Workspace::new();
    let run = |line: &str| {
        // The Vulkan loader then finds no driver.
        let mut command = workspace.command(line);
        command.args(["--backend", "vulkan"]);
        for name in ["VK_DRIVER_FILES", "VK_ICD_FILENAMES"] {
            command.env(name, "/nonexistent.json");
        }
        Run::from(command.output().expect("glimray runs")).expect(5)
    };
    let render = run("render a.scene");
    assert!(
        render
            .stderr
            .starts_with("error: no usable GPU (tried Vulkan)"),
        "{}",
        render.stderr
    );
    let install = "apt-get install libvulkan1 mesa-vulkan-drivers";
    assert!(render.stderr.contains(install), "{}", render.stderr);
    let doctor = run("doctor");
    assert!(
        doctor
            .text()
            .contains("apt-get install mesa-vulkan-drivers libvulkan1")
    );
    let doctor = run("doctor --json").json();
    assert_eq!(doctor["adapters"], serde_json::json!([]));
    assert_eq!(doctor["chosen"], Value::Null);
    assert!(workspace.made().is_empty());
}

#[cfg(target_os = "linux")]
#[test]
fn opengl_on_the_cpu_comes_with_advice_unless_it_was_asked_for() {
    let workspace = Workspace::new();
    let run = |line: &str| {
        let mut command = workspace.command(line);
        for name in ["VK_DRIVER_FILES", "VK_ICD_FILENAMES"] {
            command.env(name, "/nonexistent.json");
        }
        Run::from(command.output().expect("glimray runs"))
    };
    let fallen_back = run("render a.scene --size 8x6");
    if !fallen_back.stderr.contains("[gl, CPU") {
        return skip(Need::Gl, fallen_back.stderr);
    }
    let advice = "install mesa-vulkan-drivers";
    assert!(
        fallen_back.stderr.contains(advice),
        "{}",
        fallen_back.stderr
    );
    let asked_for = run("render a.scene --size 8x6 --backend gl").expect(0);
    assert!(!asked_for.stderr.contains(advice), "{}", asked_for.stderr);
}

#[cfg(target_os = "linux")]
#[test]
fn a_backend_of_another_platform_is_refused_without_install_advice() {
    let workspace = Workspace::new();
    for (backend, why) in [
        ("metal", "only Apple's systems have Metal"),
        ("dx12", "only Windows has DirectX 12"),
    ] {
        let run = workspace
            .run(&format!("render a.scene --backend {backend}"))
            .expect(5);
        assert_eq!(
            run.stderr,
            format!(
                "error: no usable GPU (--backend {backend}): {why}. Omit --backend or choose another \
                 one.\n"
            )
        );
        let doctor = workspace
            .run(&format!("doctor --backend {backend}"))
            .expect(5);
        assert!(!doctor.text().contains("install"), "{}", doctor.text());
    }
}

/// The adapter is opened while the scene is read: a scene that is refused is the first thing to mend.
#[cfg(target_os = "linux")]
#[test]
fn a_refused_scene_is_reported_before_an_unusable_adapter() {
    let run = Workspace::new().run("render none.toml --backend metal");
    let message = "cannot read the file (none.toml)";
    assert!(run.expect(3).stderr.contains(message));
}

#[test]
fn doctor_finds_the_adapter_and_its_self_test_passes() {
    let doctor = Workspace::new().run("doctor --json").expect(0).json();
    assert!(doctor["chosen"].is_u64());
    assert_eq!(doctor["self_test"]["passed"], true, "{doctor}");
}

#[test]
fn the_adapter_is_named_unless_quiet() {
    let workspace = Workspace::new();
    let run = workspace.run("render a.scene --size 8x6").expect(0);
    assert!(
        run.stderr.starts_with("rendering 8×6 on "),
        "{}",
        run.stderr
    );
    let run = workspace.run("render a.scene --size 8x6 --quiet").expect(0);
    assert_eq!(run.stderr, "");
}

#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
#[test]
fn lavapipe_takes_the_widest_vectors_unless_told_otherwise() {
    let workspace = Workspace::new();
    let name = |width: Option<&str>| {
        let mut command = workspace.command("doctor --json");
        match width {
            Some(width) => command.env("LP_NATIVE_VECTOR_WIDTH", width),
            None => command.env_remove("LP_NATIVE_VECTOR_WIDTH"),
        };
        let doctor = Run::from(command.output().expect("glimray runs")).json();
        doctor["adapters"][0]["name"].as_str().map(str::to_owned)
    };
    let narrow = name(Some("256")).expect("an adapter");
    if !narrow.contains("256 bits") {
        return;
    }
    let widest = match std::arch::is_x86_feature_detected!("avx512vl") {
        true => "512 bits",
        false => "256 bits",
    };
    let chosen = name(None).expect("an adapter");
    assert!(chosen.contains(widest), "{chosen}");
}

/// Mesa's cache does not distinguish the widths of vectors, so kernels of each have a folder of their own, also where a
/// variable names the width or the folder.
#[cfg(target_os = "linux")]
#[test]
fn kernels_of_each_vector_width_have_a_shader_cache_of_their_own() {
    let workspace = Workspace::new();
    let caches = workspace.path("caches");
    let own = workspace.path("own");
    let run = |variables: &[(&str, &Path)]| {
        let mut command = workspace.command("render a.scene --size 8x6 --quiet");
        command
            .env_remove("LP_NATIVE_VECTOR_WIDTH")
            .env_remove("MESA_SHADER_CACHE_DIR")
            .env("XDG_CACHE_HOME", &caches)
            .envs(variables.iter().copied());
        let run = Run::from(command.output().expect("glimray runs")).expect(0);
        assert_eq!(run.stderr, "");
    };
    // The widths of the folders that have kernels.
    let widths = |parent: &Path| -> Vec<String> {
        let folders = std::fs::read_dir(parent).into_iter().flatten();
        let used = folders
            .map(|folder| folder.expect("an entry").path())
            .filter(|folder| {
                let parts = std::fs::read_dir(folder).into_iter().flatten();
                let parts = parts.map(|part| std::fs::read_dir(part.expect("an entry").path()));
                let mut files = parts.flat_map(|files| files.into_iter().flatten());
                files.any(|file| file.expect("an entry").file_name() != "index")
            });
        let name = |folder: std::path::PathBuf| folder.file_name().expect("a name").to_owned();
        let mut widths: Vec<_> = used
            .map(|folder| name(folder).into_string().expect("text"))
            .map(|name| name.split_once("-bits-").expect("a width").0.to_owned())
            .collect();
        widths.sort();
        widths
    };
    let variable = |width| ("LP_NATIVE_VECTOR_WIDTH", Path::new(width));
    let folder = ("MESA_SHADER_CACHE_DIR", own.as_path());
    run(&[variable("256")]);
    run(&[variable("512")]);
    run(&[variable("128"), folder]);
    run(&[variable("256"), folder]);
    if is_lavapipe(&workspace) {
        assert_eq!(widths(&caches.join("glimray/mesa")), ["256", "512"]);
        assert_eq!(widths(&own), ["128", "256"]);
    }

    // A folder that cannot be created is no reason for a message.
    std::fs::create_dir(workspace.path("blocked")).expect("a folder");
    workspace.write("blocked/glimray", "a file");
    run(&[("XDG_CACHE_HOME", &workspace.path("blocked"))]);
}

/// Mesa maps the index of its cache into memory. On a full disk the program ended with SIGBUS.
#[cfg(target_os = "linux")]
#[test]
fn on_a_full_disk_kernels_are_compiled_without_a_shader_cache() {
    let workspace = Workspace::new();
    std::fs::create_dir(workspace.path("home")).expect("a folder");
    let render = |script: &str| {
        let line = workspace.command("render a.scene --size 8x6 --quiet -o a.png");
        let mut command = std::process::Command::new("unshare");
        command
            .args(["--map-root-user", "--mount", "sh", "-ec", script, "sh"])
            .arg(line.get_program())
            .args(line.get_args())
            .current_dir(workspace.path("."))
            .env("HOME", workspace.path("home"))
            .envs(["XDG_CACHE_HOME", "MESA_SHADER_CACHE_DIR"].map(|name| (name, "")));
        command.output()
    };
    let mount = "mount -t tmpfs -o size=300k tmpfs \"$HOME\"";
    match render(mount) {
        Ok(probe) if probe.status.success() => {}
        other => {
            return skip(
                Need::Mounts,
                format!("there are no private mounts: {other:?}"),
            );
        }
    }
    let with = |prepare: &str| {
        let script = format!("{mount}; {prepare}; exec \"$@\"");
        let run = Run::from(render(&script).expect("unshare")).expect(0);
        std::fs::remove_file(workspace.path("a.png")).expect("a picture");
        run.stderr
    };
    // The first file has no space, the second has some, but not for all of the index.
    for prepare in [
        "head -c 400000 /dev/zero > \"$HOME/fill\" || true",
        "true",
        "mkdir -p \"$HOME/.cache/glimray/mesa\"; head -c 400000 /dev/zero > \"$HOME/fill\" || true",
    ] {
        let said = with(prepare);
        let mut warnings = said.lines().filter(|line| line.starts_with("warning: "));
        let warning = warnings.next().unwrap_or_default();
        let words = "no space left on device. Free some space: kernels are compiled anew by each run until then.";
        assert!(
            warning.starts_with("warning: no shader cache ("),
            "{prepare}: {said}"
        );
        assert!(warning.ends_with(words), "{prepare}: {said}");
        assert_eq!(warnings.next(), None, "{prepare}: {said}");
    }
}

fn is_lavapipe(workspace: &Workspace) -> bool {
    let doctor = workspace.run("doctor --json").json();
    let name = doctor["adapters"][0]["name"].as_str();
    name.is_some_and(|name| name.contains("llvmpipe"))
}
