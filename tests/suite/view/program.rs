//! The window and the program agree: pictures, files, rays and copied commands have the same bytes.

use super::harness::Window;
use super::pixels::{self, Bytes};
use crate::support::PATIENCE;
use eframe::egui::Key;
use egui_kittest::kittest::Queryable;
use glam::{Vec3, dvec3};
use glimray::output;
use glimray::render::Tone;
use glimray::scene::{Background, Shutter};
use glimray_viewer::actions::files::pictures;
use glimray_viewer::actions::inspector;
use glimray_viewer::actions::inspector::export::{self, Format};
use glimray_viewer::model::file_dialog::{FileDialogs, Reply};
use glimray_viewer::state::files::SaveSize;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::time::{Duration, Instant};
use tempfile::TempDir;

const SMALL: [&str; 4] = ["--size", "48x32", "--samples", "2"];

/// A sphere under a lamp, in a file of a folder of its own.
fn sphere(output: &str) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder
        .path()
        .canonicalize()
        .expect("a folder")
        .join("one.toml");
    let text = "ambient = [0.2, 0.2, 0.2]\n\n[camera]\nlook_from = [0, 0, 5]\nlook_at = [0, 0, 0]\n\n\
         [[lights]]\npoint = { position = [2, 3, 4], color = [1, 1, 1], intensity = 30 }\n\n\
         [materials.red]\nphong = { diffuse = [0.8, 0.1, 0.1] }\n\n\
         [[objects]]\nsphere = { center = [0, 0, 0], radius = 1 }\nmaterial = \"red\"\n";
    fs::write(&path, format!("{text}\n[output]\n{output}")).expect("a file");
    (folder, path)
}

fn text(path: &Path) -> &str {
    path.to_str().expect("a name in UTF-8")
}

fn open(arguments: &[&str]) -> Window {
    let mut window = Window::open(arguments);
    window.settle();
    window
}

fn glimray(arguments: &[&str]) -> Output {
    let program = env!("CARGO_BIN_EXE_glimray");
    let output = Command::new(program).args(arguments).output();
    output.expect("glimray runs")
}

/// The PNG that `glimray ARGUMENTS… -o FILE` writes.
fn of_command_line(arguments: &[&str]) -> Bytes {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("picture.png");
    let output = glimray(&[arguments, &["-o", text(&path)]].concat());
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{arguments:?}: {errors}");
    file_bytes(&path)
}

/// The contents of a PNG file.
fn file_bytes(path: &Path) -> Bytes {
    let picture = ::image::open(path).expect("a PNG").to_rgb8();
    Bytes {
        size: picture.dimensions(),
        rgb: picture.pixels().map(|pixel| pixel.0).collect(),
    }
}

/// Steps until the file is written.
fn wait(window: &mut Window, path: &Path) {
    let start = Instant::now();
    while !path.exists() {
        assert!(
            start.elapsed() < PATIENCE,
            "{} is not written",
            path.display()
        );
        window.harness.step();
        std::thread::sleep(Duration::from_millis(5));
    }
    window.settle();
}

/// The scene of the demo, from the folder of the others.
const SHOWCASE: &str = "../../crates/app/src/showcase.toml";

/// Opens a scene, lets `change` happen, and holds the screen against the picture of a command line that says the same.
#[track_caller]
fn check(scene: &str, flags: &[&str], change: impl FnOnce(&mut Window) -> Vec<String>) {
    let path = format!("assets/scenes/{scene}");
    let mut arguments = vec![path.as_str()];
    arguments.extend(flags);
    let mut window = open(&arguments);
    let more = change(&mut window);
    window.settle();
    let shown = window.shown();
    assert!(shown.progress.is_done, "{scene}: {:?}", shown.progress);
    let screen = pixels::on(&shown.screen.expect("a screen"), &window.gpu);
    let mut line = vec!["render", "--quiet"];
    line.extend(&arguments);
    line.extend(more.iter().map(String::as_str));
    screen.assert_same(&of_command_line(&line), &line.join(" "));
}

/// The flags of a model whose picture is not denoised: the screen denoises to within a level of files.
fn raw<'a>(flags: &[&'a str]) -> Vec<&'a str> {
    [flags, &["--no-denoise"]].concat()
}

#[test]
fn what_is_on_the_screen_is_the_png_of_the_command_line() {
    let flags = ["--size", "72x48", "--samples", "4"];
    for scene in [
        SHOWCASE,
        "glass_and_mirrors.toml",
        "lights.toml",
        "depth_of_field.toml",
        "far_away.toml",
        "tones.toml",
        "neutral.nff",
    ] {
        check(scene, &flags, |_| Vec::new());
    }
    check("lighthouse.obj", &raw(&flags), |_| Vec::new());
    let adaptive = [
        "--size",
        "72x48",
        "--samples",
        "32",
        "--antialias",
        "adaptive",
    ];
    check("soft_shadows.toml", &adaptive, |_| Vec::new());
    let crop = ["--size", "72x48", "--samples", "2", "--crop", "10,5,50,41"];
    check("patterns.toml", &crop, |_| Vec::new());
    let normals = ["--size", "72x48", "--integrator", "normals"];
    check("shapes.toml", &normals, |_| Vec::new());
}

#[test]
fn a_background_that_was_changed_gives_the_png_of_the_command_line() {
    let green = Vec3::new(0.1, 0.5, 0.2);
    let flags = ["--size", "72x48", "--samples", "4"];
    let change = |window: &mut Window| {
        window.session().view.background = Some(Background::Color(green));
        window.settle();
        vec!["--background".into(), "0.1,0.5,0.2".into()]
    };
    check("glass_and_mirrors.toml", &flags, change);
    // The window keeps the ground below the model, which the flag leaves out unless it is asked for.
    check("lighthouse.obj", &raw(&flags), |window| {
        [change(window), vec!["--ground=surface".into()]].concat()
    });
    // A background of the command line, and back to it.
    let flags = [&flags[..], &["--background", "0.1,0.5,0.2"]].concat();
    check("lighthouse.obj", &raw(&flags), |_| Vec::new());
    check("media.toml", &flags, |window| {
        window.session().view.background = Some(Background::Color(Vec3::ONE));
        window.settle();
        window.session().view.background = None;
        Vec::new()
    });
    let adaptive = [&flags[..], &["--antialias", "adaptive"]].concat();
    check("glass_and_mirrors.toml", &adaptive, |_| Vec::new());
}

#[test]
fn a_camera_that_was_moved_gives_the_png_of_the_command_line() {
    let flags = ["--size", "72x48", "--samples", "4"];
    for scene in [SHOWCASE, "far_away.toml", "mesh.toml"] {
        check(scene, &flags, |window| {
            let mut session = window.session();
            let rig = session.controller.as_mut().expect("a rig");
            rig.orbit_by(0.4, -0.1);
            rig.zoom(1.5, None);
            session.moved();
            drop(session);
            window.settle();
            let camera = window.camera();
            let place = |v: glam::DVec3| format!("{},{},{}", v.x, v.y, v.z);
            vec![
                "--look-from".into(),
                place(camera.look_from),
                "--look-at".into(),
                place(camera.look_at),
                "--up".into(),
                place(camera.up),
            ]
        });
    }
}

/// Holds what is on the screen against `glimray render SCENE --frame N FLAGS…`.
#[track_caller]
fn check_frame(window: &Window, scene: &str, flags: &str) {
    let frame = window.session().playback.frame().to_string();
    let mut line = vec!["render", "--quiet", scene, "--frame", &frame];
    line.extend(SMALL);
    line.extend(flags.split_whitespace());
    let screen = window.shown().screen.expect("a screen");
    let shown = pixels::on(&screen, &window.gpu);
    shown.assert_same(&of_command_line(&line), &line.join(" "));
}

#[test]
fn a_frame_on_the_screen_is_that_of_the_command_line() {
    for scene in ["assets/scenes/orbits.toml", "assets/scenes/carousel.toml"] {
        let mut window = open(&[&[scene], SMALL.as_slice()].concat());
        for frame in [31, 5] {
            window.session().playback.go_to(frame);
            window.settle();
            check_frame(&window, scene, "");
        }
    }
}

#[test]
fn motion_blur_shutter_and_frame_rate_are_those_of_the_command_line() {
    let scene = "assets/scenes/orbits.toml";
    let mut window = open(&[&[scene], SMALL.as_slice()].concat());
    window.session().playback.go_to(10);
    window.session().playback.blurs = false;
    window.settle();
    check_frame(&window, scene, "--shutter 0");
    window.session().playback.blurs = true;
    window.session().playback.clock.shutter = Shutter {
        open: -0.5,
        close: 1.25,
    };
    window.settle();
    check_frame(&window, scene, "--shutter=-0.5..1.25");
    window.session().playback.set_fps(10.0);
    window.settle();
    // Frame 10 of 24 a second is nearest to frame 4 of 10.
    assert_eq!(window.session().playback.frame(), 4);
    check_frame(&window, scene, "--shutter=-0.5..1.25 --fps 10");
}

/// Saves through the sheet, with `name` chosen in the dialog.
fn save(window: &mut Window, path: &Path) {
    let chosen = path.to_owned();
    window.session().files.dialogs = FileDialogs::answering(move |request| {
        assert!(request.saves);
        Reply::Chosen(chosen.clone())
    });
    window.harness.key_press(Key::F12);
    window.harness.step();
    window.harness.step();
    window.harness.get_by_label("Browse…").click();
    window.harness.run_steps(3);
    window.harness.get_by_label("Save").click();
    window.harness.step();
    wait(window, path);
}

#[test]
fn a_saved_picture_has_the_bytes_of_the_command_lines() {
    let (folder, scene) = sphere("exposure_ev = 0.5\ntone = \"aces\"\n");
    let mut window = open(&[&[text(&scene)], SMALL.as_slice()].concat());
    for ending in ["png", "jpg", "exr", "hdr"] {
        let [ours, theirs] =
            ["ours", "theirs"].map(|name| folder.path().join(format!("{name}.{ending}")));
        save(&mut window, &ours);
        let line = ["render", text(&scene), "-o", text(&theirs)];
        let output = glimray(&[&line, SMALL.as_slice()].concat());
        assert!(output.status.success(), "{output:?}");
        let [ours, theirs] = [ours, theirs].map(|path| fs::read(path).expect("a picture"));
        assert!(ours == theirs, "the {ending} files differ");
    }
}

/// An OpenEXR file has the raw picture as a layer, whether the window's picture is saved or one is rendered for it.
#[test]
fn a_denoised_picture_has_the_bytes_of_the_command_lines() {
    let (folder, scene) = sphere("");
    let path = text(&scene);
    let plain = ["--samples", "2", "--integrator", "path"];
    let flags = [&plain[..], &["--denoise"]].concat();
    let mut window = open(&[&[path, "--size", "48x32"], flags.as_slice()].concat());
    // The switch in the panel counts, not how the window was started.
    for (ending, larger, denoises) in [
        ("png", false, true),
        ("exr", false, true),
        ("exr", true, true),
        ("hdr", false, true),
        ("exr", false, false),
        ("exr", true, false),
    ] {
        window.session().view.tone.denoise = denoises;
        window.harness.run_steps(2);
        window.settle();
        let name = |side: &str| {
            folder
                .path()
                .join(format!("{side}_{larger}_{denoises}.{ending}"))
        };
        let (ours, theirs) = (name("ours"), name("theirs"));
        let size = match larger {
            true => "96x64",
            false => "48x32",
        };
        {
            let mut session = window.session();
            pictures::open(&mut session, false);
            let dialog = session.files.saving.as_mut().expect("a sheet");
            dialog.path = ours.display().to_string();
            if larger {
                dialog.size = SaveSize::Twice;
            }
            pictures::save(&mut session, false);
        }
        wait(&mut window, &ours);
        let line = ["render", path, "-o", text(&theirs), "--size", size];
        let flags = if denoises { &flags[..] } else { &plain };
        let output = glimray(&[line.as_slice(), flags].concat());
        assert!(output.status.success(), "{output:?}");
        let [ours, theirs] = [ours, theirs].map(|path| fs::read(path).expect("a picture"));
        assert!(
            ours == theirs,
            "the {ending} files of {size} differ, {denoises}"
        );
    }
}

#[test]
fn a_picture_is_saved_at_the_scenes_size_and_at_twice_that() {
    let (folder, scene) = sphere("size = [40, 30]\nsamples = 2\n");
    let scene = text(&scene);
    let mut window = open(&[scene]);
    let shown = window.shown().size;
    assert!(shown.0 > 80, "the picture does not fit the window");
    for (label, size) in [("Scene size", "40x30"), ("Scene size ×2", "80x60")] {
        let path = folder.path().join(format!("{size}.png"));
        window.harness.key_press(Key::F12);
        window.harness.run_steps(3);
        window.harness.get_by_label(label).click();
        window.harness.run_steps(2);
        let dialog = path.display().to_string();
        (window.session().files.saving.as_mut().expect("a sheet")).path = dialog;
        window.harness.run_steps(2);
        window.harness.get_by_label("Save").click();
        window.harness.run_steps(2);
        window.settle();
        let line = ["render", "--quiet", scene, "--size", size];
        file_bytes(&path).assert_same(&of_command_line(&line), size);
    }
    assert_eq!(window.shown().size, shown, "the window's picture changed");
}

#[test]
fn what_is_saved_is_what_the_command_prints() {
    let mut window = open(&[
        "assets/scenes/glass_and_mirrors.toml",
        "--size",
        "64x36",
        "--samples",
        "4",
    ]);
    inspector::inspect(&mut window.session(), [31, 18]);
    window.settle();
    for turn in [0.0, 0.7] {
        if turn > 0.0 {
            let mut session = window.session();
            session
                .controller
                .as_mut()
                .expect("a rig")
                .orbit_by(turn, 0.2);
            drop(session);
            window.settle();
            inspector::inspect(&mut window.session(), [28, 21]);
            window.settle();
        }
        let session = window.session();
        let command = export::command(&session, None).expect("a command");
        assert_eq!(command.left_out, [""; 0], "{}", command.line);
        let inspected = session.inspector.inspected.as_ref().expect("a tree");
        let words = shlex::split(&command.line).expect("a command line");
        assert_eq!(words[..2], ["glimray", "explain"]);
        let folder = tempfile::tempdir().expect("a folder");
        let lines = folder.path().join("rays.obj");
        let words: Vec<_> = words[1..].iter().map(String::as_str).collect();
        let printed = glimray(&[words.as_slice(), &["--json", "--obj", text(&lines)]].concat());
        let error = String::from_utf8_lossy(&printed.stderr);
        assert!(printed.status.success(), "{}: {error}", command.line);
        let json = export::text(inspected, Format::Json).expect("JSON");
        assert!(json.as_bytes() == printed.stdout, "{}", command.line);
        let obj = export::text(inspected, Format::Obj).expect("lines");
        assert!(obj.as_bytes() == fs::read(&lines).expect("lines"));
        let copy = folder.path().join("copy.json");
        let details = export::write(&copy, &json).expect("a file");
        assert!(details.starts_with("Saved "), "{details}");
        assert!(fs::read(&copy).expect("a file") == printed.stdout);
    }
}

#[test]
fn the_copied_command_prints_the_paths() {
    let scene = "assets/scenes/glass_and_mirrors.toml";
    let flags = ["--size", "64x36", "--samples", "4", "--integrator", "path"];
    let mut window = open(&[&[scene], flags.as_slice()].concat());
    inspector::inspect(&mut window.session(), [33, 20]);
    window.settle();
    let session = window.session();
    let command = export::command(&session, None).expect("a command");
    assert_eq!(command.left_out, [""; 0], "{}", command.line);
    assert!(
        command.line.contains("--integrator path"),
        "{}",
        command.line
    );
    let words = shlex::split(&command.line).expect("a command line");
    let words: Vec<_> = words[1..].iter().map(String::as_str).collect();
    let printed = glimray(&[words.as_slice(), &["--json"]].concat());
    let inspected = session.inspector.inspected.as_ref().expect("paths");
    let json = export::text(inspected, Format::Json).expect("JSON");
    assert!(json.as_bytes() == printed.stdout, "{}", command.line);
}

#[test]
fn what_is_no_recording_is_refused_with_its_line() {
    let folder = tempfile::tempdir().expect("a folder");
    let good = r#"{"time":1.0,"event":"PointerGone"}"#;
    for (events, why) in [
        ("", "contains no events"),
        ("\n\n", "contains no events"),
        ("{}", ":1): missing field `time`"),
        (
            &format!("{good}\n{good}\nrubbish"),
            ":3): expected value in column 1",
        ),
        (
            &format!("{good}\n{}", good.replace("1.0", "0.5")),
            ":2): its time, 0.5 s, is before",
        ),
        (
            &good.replace("PointerGone", "Nonsense"),
            ":1): unknown variant `Nonsense`",
        ),
    ] {
        let file = folder.path().join("bad.jsonl");
        fs::write(&file, events).expect("a file");
        let output = glimray(&["view", "--replay", text(&file)]);
        let errors = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(3), "{errors}");
        assert!(errors.contains(why), "{errors} does not say {why}");
    }
    let nowhere = folder.path().join("none").join("session.jsonl");
    let output = glimray(&["view", "--record", text(&nowhere)]);
    assert_eq!(output.status.code(), Some(4));
}

#[test]
fn the_command_line_makes_the_pixels_that_were_copied() {
    let (folder, scene) = sphere("");
    // A name that a shell would split.
    let named = folder.path().join("a scene.toml");
    fs::rename(&scene, &named).expect("a file");
    let flags = [
        "--size",
        "48x36",
        "--samples",
        "4",
        "--antialias",
        "stratified",
    ];
    let mut window = open(&[&[text(&named)], flags.as_slice()].concat());
    for is_orthographic in [false, true] {
        let mut session = window.session();
        let controller = session.controller.as_mut().expect("a camera");
        controller.orbit_by(0.3, 0.2);
        controller.zoom(2.0, Some(dvec3(0.5, 0.5, 0.0)));
        if is_orthographic {
            controller.toggle_orthographic();
        }
        session.moved();
        drop(session);
        window.settle();
        let line = window.copied();
        let made = folder.path().join("made.png");
        let words = shell_words(&line);
        let words: Vec<_> = words[1..].iter().map(String::as_str).collect();
        let more = ["--transfer", "linear", "--quiet", "-o", text(&made)];
        let output = glimray(&[words.as_slice(), &more].concat());
        assert!(output.status.success(), "{line}: {output:?}");
        let shown = folder.path().join("shown.png");
        output::save(&shown, &window.image(Tone::LINEAR)).expect("a picture");
        let [made, shown] = [made, shown].map(|path| fs::read(path).expect("a file"));
        assert!(made == shown, "{line}");
    }
}

/// By a real shell, or where there is none by spaces.
fn shell_words(line: &str) -> Vec<String> {
    let script = format!("printf '%s\\n' {line}");
    let output = Command::new("sh").args(["-c", &script]).output();
    let text = output.map_or_else(
        |_| line.replace(' ', "\n"),
        |output| String::from_utf8_lossy(&output.stdout).into_owned(),
    );
    text.lines().map(str::to_owned).collect()
}
