//! The program itself in a real window, on an X server without a screen (Xvfb), under a real mouse and
//! keyboard (xdotool). Where these are missing there is nothing to test with, and the tests say so.

mod drag_source;

use crate::support::PATIENCE;
use crate::support::skip::{Need, skip};
use std::cell::Cell;
use std::ffi::OsStr;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;
use x11rb::connection::Connection;
use x11rb::protocol::xproto::{
    AutoRepeatMode, ChangeKeyboardControlAux, ConnectionExt as _, ImageFormat,
};
use x11rb::rust_connection::RustConnection;

const SCREEN: (u16, u16) = (1300, 820);

/// A connection to an X server, and the number of its screen.
fn connect(display: &str) -> (RustConnection, usize) {
    RustConnection::connect(Some(display)).expect("the X server")
}

/// An X server of our own.
struct Desktop {
    server: Child,
    display: String,
    /// The number of the program that was started last.
    program: Cell<u32>,
}

impl Desktop {
    /// `None` where there is no Xvfb or no xdotool.
    fn start() -> Option<Self> {
        let is_there = |tool: &str| {
            let help = Command::new(tool).arg("-help").output();
            help.is_ok()
        };
        for (tool, package) in [("Xvfb", "xvfb"), ("xdotool", "xdotool")] {
            if !is_there(tool) {
                let why = format!("there is no {tool}. Install the package {package}.");
                skip(Need::Xvfb, why);
                return None;
            }
        }
        let folder = tempfile::tempdir().expect("a folder");
        let number = folder.path().join("display");
        // With `-noreset`: else it refuses connections for a moment whenever the last one is closed.
        let screen = format!("{}x{}x24", SCREEN.0, SCREEN.1);
        let server = Command::new("sh")
            .arg("-c")
            .arg(format!(
                "exec Xvfb -displayfd 3 -screen 0 {screen} -nolisten tcp -noreset 3>{}",
                number.display()
            ))
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("an X server");
        let display = wait_for("the X server", || {
            let number = std::fs::read_to_string(&number).ok()?;
            number
                .ends_with('\n')
                .then(|| format!(":{}", number.trim()))
        });
        // A key that a busy machine releases late must not be typed twice.
        let (connection, _) = connect(&display);
        let once = ChangeKeyboardControlAux::new().auto_repeat_mode(AutoRepeatMode::OFF);
        (connection
            .change_keyboard_control(&once)
            .expect("a request"))
        .check()
        .expect("keys that do not repeat");
        let program = Cell::new(server.id());
        Some(Self {
            server,
            display,
            program,
        })
    }

    /// The output of xdotool.
    fn xdotool(&self, words: &[&str]) -> String {
        let output = Command::new("xdotool")
            .args(words)
            .env("DISPLAY", &self.display)
            .output()
            .expect("xdotool");
        String::from_utf8_lossy(&output.stdout).trim().to_owned()
    }

    /// With the left button and a stop on the way, from where on the picture follows: it is another
    /// one at each stop before the mouse goes on.
    fn drag(&self, from: [i32; 2], to: [i32; 2]) {
        let go = |[x, y]: [i32; 2], then: &[&str]| {
            let (x, y) = (x.to_string(), y.to_string());
            self.xdotool(&[&["mousemove", &x, &y], then].concat());
        };
        go(from, &["mousedown", "1"]);
        for stop in [[(from[0] + to[0]) / 2, (from[1] + to[1]) / 2], to] {
            let before = self.screenshot(SPOT);
            let mut aside = 0;
            // A movement that comes in one frame with the press is no drag yet; a hand keeps moving.
            wait_for("a picture that follows the mouse", || {
                aside = 1 - aside;
                go([stop[0] + aside, stop[1]], &[]);
                differ(&before, &self.screenshot(SPOT)).then_some(())
            });
            go(stop, &[]);
        }
        self.xdotool(&["mouseup", "1"]);
    }

    /// The pixels of a rectangle of the screen: x, y, width, height.
    fn screenshot(&self, [x, y, width, height]: [u16; 4]) -> Vec<u8> {
        let (connection, screen) = connect(&self.display);
        let root = connection.setup().roots[screen].root;
        let (x, y) = (x as i16, y as i16);
        (connection.get_image(ImageFormat::Z_PIXMAP, root, x, y, width, height, !0))
            .expect("a request")
            .reply()
            .expect("a screenshot")
            .data
    }

    /// A screenshot once there is a picture, and nothing has moved or been at work in twenty looks.
    fn calm(&self, place: [u16; 4]) -> Vec<u8> {
        let is_calm = |now: &[u8]| colors(now) > 64 && !self.is_at_work();
        self.unchanged("a calm screen", place, 20, is_calm)
    }

    /// A screenshot once the Render panel says that the picture is done, and nothing has moved or been at work in
    /// twenty looks. On a busy machine this is surer than [`Self::calm`]: a program that waits for the X server
    /// looks idle.
    fn finished(&self, place: [u16; 4]) -> Vec<u8> {
        let is_finished = |_: &[u8]| {
            let bar = self.screenshot(BAR_END);
            colors(&bar) == 1 && bar[0] > 80 && !self.is_at_work()
        };
        self.unchanged("a finished picture", place, 20, is_finished)
    }

    /// A screenshot that stayed the same for ten looks. Unlike [`Self::calm`] it may be taken while a text
    /// cursor blinks elsewhere: each blink is work for the program.
    fn still(&self, place: [u16; 4]) -> Vec<u8> {
        self.unchanged("a still screen", place, 10, |_| true)
    }

    /// A screenshot that stayed the same, and was good, for so many looks in a row.
    fn unchanged(
        &self,
        what: &str,
        place: [u16; 4],
        enough: u32,
        is_good: impl Fn(&[u8]) -> bool,
    ) -> Vec<u8> {
        let mut last = self.screenshot(place);
        let mut looks = 0;
        wait_for(what, || {
            std::thread::sleep(Duration::from_millis(80));
            let now = self.screenshot(place);
            let is_unchanged = now == last && is_good(&now);
            looks = if is_unchanged { looks + 1 } else { 0 };
            last = now;
            (looks >= enough).then(|| last.clone())
        })
    }

    /// Whether a thread of the program runs, or would if there were a core for it. The X server does not count:
    /// on a busy machine it is often still on its way to sleep after the last screenshot.
    fn is_at_work(&self) -> bool {
        let tasks = std::fs::read_dir(format!("/proc/{}/task", self.program.get()));
        tasks.into_iter().flatten().flatten().any(|task| {
            let stat = std::fs::read_to_string(task.path().join("stat")).unwrap_or_default();
            // The state comes after the name, which is in brackets.
            let state = stat.rsplit_once(") ").map_or("", |(_, rest)| rest);
            state.starts_with(['R', 'D'])
        })
    }

    /// The state of each thread of the program, for messages.
    fn threads(&self) -> String {
        let tasks = std::fs::read_dir(format!("/proc/{}/task", self.program.get()));
        let said = tasks.into_iter().flatten().flatten().map(|task| {
            let read = |name: &str| std::fs::read_to_string(task.path().join(name));
            [read("comm"), read("wchan"), read("syscall")]
                .map(|it| it.unwrap_or_default().trim().to_owned())
                .join(" ")
        });
        format!("threads: {}", said.collect::<Vec<_>>().join(", "))
    }

    fn open(&self, arguments: &[&str], settings: &Path, variables: &[(&str, &str)]) -> Opened<'_> {
        let mut opened = Opened {
            desktop: self,
            program: self.program(arguments, settings, variables),
            id: String::new(),
        };
        opened.find();
        opened
    }

    /// A program with its windows here.
    fn command(&self, program: impl AsRef<OsStr>) -> Command {
        let mut command = Command::new(program);
        command
            .env("DISPLAY", &self.display)
            .env_remove("WAYLAND_DISPLAY");
        command
    }

    fn program(&self, arguments: &[&str], settings: &Path, variables: &[(&str, &str)]) -> Child {
        let program = self
            .command(env!("CARGO_BIN_EXE_glimray"))
            .arg("view")
            .args(arguments)
            .env("GLIMRAY_SETTINGS", settings)
            .current_dir(settings)
            .envs(variables.iter().copied())
            .stderr(Stdio::piped())
            .spawn()
            .expect("glimray");
        self.program.set(program.id());
        program
    }
}

impl Drop for Desktop {
    fn drop(&mut self) {
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}

/// The program with its window open.
struct Opened<'a> {
    desktop: &'a Desktop,
    program: Child,
    id: String,
}

impl Opened<'_> {
    fn find(&mut self) {
        let before = self.id.clone();
        self.id = wait_for("the window", || {
            if let Ok(Some(status)) = self.program.try_wait() {
                let mut said = String::new();
                let stderr = self.program.stderr.take();
                let _ = stderr.map(|mut stderr| stderr.read_to_string(&mut said));
                panic!("the program ended: {status}, {said}");
            }
            let found = self
                .desktop
                .xdotool(&["search", "--onlyvisible", "--name", "glimray"]);
            let id = found.lines().last().unwrap_or_default().to_owned();
            (!id.is_empty() && id != before).then_some(id)
        });
        self.desktop.xdotool(&["windowfocus", "--sync", &self.id]);
    }

    fn key(&self, key: &str) {
        self.desktop.xdotool(&["key", key]);
    }

    fn title(&self) -> String {
        self.desktop.xdotool(&["getwindowname", &self.id])
    }

    /// The exit code.
    fn wait(mut self) -> Option<i32> {
        wait_for("the end", || self.program.try_wait().expect("its state")).code()
    }
}

impl Drop for Opened<'_> {
    fn drop(&mut self) {
        let _ = self.program.kill();
        let _ = self.program.wait();
    }
}

/// How many colours there are: panels have few.
fn colors(pixels: &[u8]) -> usize {
    let colors: std::collections::HashSet<_> = pixels.chunks_exact(4).collect();
    colors.len()
}

/// Whether a screenshot is another; without a word on all its pixels.
fn differ(a: &[u8], b: &[u8]) -> bool {
    a != b
}

fn wait_for<T>(what: &str, mut look: impl FnMut() -> Option<T>) -> T {
    let start = Instant::now();
    loop {
        if let Some(found) = look() {
            return found;
        }
        assert!(start.elapsed() < PATIENCE, "{what} did not come");
        std::thread::sleep(Duration::from_millis(20));
    }
}

fn scene(name: &str) -> PathBuf {
    let path = (Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/scenes")).join(name);
    path.canonicalize().expect("a scene")
}

/// A folder of settings with what lies over the picture at the first time put away; pictures are saved
/// there too.
fn settings() -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("viewer.toml"), "hint_seen = true\n").expect("settings");
    folder
}

/// The window as it opens.
const WINDOW: [u16; 4] = [0, 0, 1280, 800];

/// A part of the picture that looks otherwise whenever the camera moves.
const SPOT: [u16; 4] = [600, 300, 64, 64];

/// The right end of the progress bar: blue once the picture is done.
const BAR_END: [u16; 4] = [1260, 65, 4, 1];

/// Within the picture of a window of the usual size, where notices appear.
const WITH_NOTICES: [u16; 4] = [420, 400, 550, 350];

/// Within the picture, wherever panels are.
const INSIDE: [u16; 4] = [420, 200, 300, 200];

#[test]
fn a_real_window_opens_turns_takes_a_drop_saves_a_picture_and_remembers() {
    let Some(desktop) = Desktop::start() else {
        return;
    };
    let settings = settings();
    let opened = desktop.open(&["--samples", "2"], settings.path(), &[]);
    let first = desktop.finished(INSIDE);

    desktop.drag([500, 300], [560, 310]);
    let turned = desktop.finished(INSIDE);
    assert!(
        differ(&first, &turned),
        "a drag leaves the picture as it is"
    );
    opened.key("Home");
    wait_for("the picture that Home leads back to", || {
        (!differ(&first, &desktop.screenshot(INSIDE))).then_some(())
    });

    let dropped = scene("sphere.scene");
    let target = opened.id.parse().expect("the window's number");
    drag_source::drop_file(&desktop.display, target, (560, 300), &dropped)
        .unwrap_or_else(|error| panic!("{error}; {}", desktop.threads()));
    wait_for("the dropped scene", || {
        opened.title().contains("sphere.scene").then_some(())
    });
    assert!(
        differ(&first, &desktop.finished(INSIDE)),
        "the dropped scene is not on screen"
    );

    let saved = settings.path().join("picture.png");
    let without = desktop.screenshot(INSIDE);
    opened.key("F12");
    // Text typed before the dialog is drawn would be shortcuts.
    wait_for("the dialog", || {
        differ(&without, &desktop.screenshot(INSIDE)).then_some(())
    });
    desktop.xdotool(&["key", "--delay", "50", "ctrl+a"]);
    desktop.xdotool(&["type", "--delay", "50", saved.to_str().expect("a name")]);
    opened.key("Return");
    let picture = wait_for("the saved picture", || image::open(&saved).ok());
    assert!(
        picture.width() > 300 && picture.height() > 200,
        "{}×{}",
        picture.width(),
        picture.height()
    );

    desktop.xdotool(&["windowsize", &opened.id, "900", "600"]);
    desktop.xdotool(&["windowmove", &opened.id, "40", "30"]);
    desktop.still([400, 200, 200, 100]);
    opened.key("ctrl+q");
    assert_eq!(opened.wait(), Some(0));
    let kept = std::fs::read_to_string(settings.path().join("viewer.toml")).expect("settings");
    assert!(
        kept.contains("sphere.scene"),
        "not among recent files: {kept}"
    );
    let again = desktop.open(&[], settings.path(), &[]);
    wait_for("the window where it was", || {
        let place = desktop.xdotool(&["getwindowgeometry", "--shell", &again.id]);
        let wanted = ["X=40", "Y=30", "WIDTH=900", "HEIGHT=600"];
        let is_there = |line: &&str| place.lines().any(|other| other == *line);
        wanted.iter().all(is_there).then_some(())
    });
    again.key("ctrl+q");
    assert_eq!(again.wait(), Some(0));
}

/// The search field and lines of the outline, settings on the right, and a part of the picture that lies beside the panels
/// on the left.
const SEARCH: [u16; 4] = [6, 52, 240, 26];
const LINES: [u16; 4] = [6, 104, 240, 280];
const SETTINGS: [u16; 4] = [1000, 110, 270, 450];
const BESIDE: [u16; 4] = [292, 602, 40, 10];

#[test]
fn after_a_click_on_a_line_letters_are_text_and_a_quick_drag_takes_a_border() {
    let Some(desktop) = Desktop::start() else {
        return;
    };
    let settings = settings();
    let opened = desktop.open(&["--samples", "1"], settings.path(), &[]);
    desktop.finished(WINDOW);
    let before = desktop.screenshot(SETTINGS);
    let click = |x: &str, y: &str| desktop.xdotool(&["mousemove", x, y, "click", "1"]);
    click("80", "160");
    desktop.still(WINDOW);
    let changed = |what: &str, part: [u16; 4], before: &[u8]| {
        wait_for(what, || {
            differ(before, &desktop.screenshot(part)).then_some(())
        });
    };
    let (unfocused, listed) = (desktop.screenshot(SEARCH), desktop.screenshot(LINES));
    click("100", "64");
    changed("the focus of the search", SEARCH, &unfocused);
    // As a shortcut it would hide all panels; as a word it leaves fewer lines.
    desktop.xdotool(&["type", "n"]);
    changed("what was typed", LINES, &listed);
    assert!(
        !differ(&before, &desktop.still(SETTINGS)),
        "a letter was a shortcut"
    );

    assert!(
        colors(&desktop.screenshot(BESIDE)) > 2,
        "there is no picture"
    );
    let quick = "mousemove 280 500 mousedown 1 mousemove 360 500 mouseup 1";
    desktop.xdotool(&quick.split(' ').collect::<Vec<_>>());
    wait_for("the panel over what was the picture", || {
        (colors(&desktop.screenshot(BESIDE)) <= 2).then_some(())
    });
    opened.key("ctrl+q");
    assert_eq!(opened.wait(), Some(0));
}

#[test]
fn a_lost_device_is_replaced_while_the_window_is_open() {
    let Some(desktop) = Desktop::start() else {
        return;
    };
    let settings = settings();
    let undisturbed = desktop.open(&["--samples", "2"], settings.path(), &[]);
    let expected = desktop.finished(INSIDE);
    undisturbed.key("ctrl+q");
    assert_eq!(undisturbed.wait(), Some(0));

    let disturbed = desktop.open(
        &["--samples", "2"],
        settings.path(),
        &[("GLIMRAY_FAULT", "device@12")],
    );
    let shown = desktop.finished(INSIDE);
    assert!(shown == expected, "the picture is not back");
    desktop.xdotool(&[
        "windowfocus",
        "--sync",
        &desktop.xdotool(&["search", "--onlyvisible", "--name", "glimray"]),
    ]);
    disturbed.key("ctrl+q");
    assert_eq!(disturbed.wait(), Some(0));
}

/// A surface that is configured while work is submitted, or a picture that is drawn for another size, would be reported over the
/// picture.
#[test]
fn a_window_that_is_resized_under_load_reports_no_fault() {
    let Some(desktop) = Desktop::start() else {
        return;
    };
    let settings = settings();
    let scene = scene("cornell_box.toml");
    let path = scene.to_str().expect("a name");
    let arguments = [path, "--integrator", "path", "--samples", "1"];
    let opened = desktop.open(&arguments, settings.path(), &[]);
    let first = desktop.finished(WITH_NOTICES);
    let sizes = [
        [900, 700],
        [1200, 640],
        [760, 780],
        [1280, 500],
        [1000, 800],
    ];
    for [width, height] in sizes.into_iter().chain([[1280, 800]]) {
        let (width, height) = (width.to_string(), height.to_string());
        desktop.xdotool(&["windowsize", &opened.id, &width, &height]);
        // Long enough for the first submissions at this size, and too short for the picture.
        std::thread::sleep(Duration::from_millis(400));
    }
    let after = desktop.finished(WITH_NOTICES);
    assert!(
        !differ(&first, &after),
        "something lies over the picture, or it is another one"
    );
    opened.key("ctrl+q");
    assert_eq!(opened.wait(), Some(0));
}

/// lavapipe crashes when it draws with 512 bits. The shaders are compiled anew, for its cache does not distinguish
/// widths.
#[test]
fn a_window_opens_where_the_vectors_of_kernels_have_512_bits() {
    let Some(desktop) = Desktop::start() else {
        return;
    };
    let settings = settings();
    let cache = tempfile::tempdir().expect("a folder");
    let variables = [
        ("LP_NATIVE_VECTOR_WIDTH", "512"),
        (
            "MESA_SHADER_CACHE_DIR",
            cache.path().to_str().expect("text"),
        ),
    ];
    let opened = desktop.open(&["--samples", "2"], settings.path(), &variables);
    desktop.finished(INSIDE);
    opened.key("ctrl+q");
    assert_eq!(opened.wait(), Some(0));
}

/// Seconds from the start of the program to its first picture, and from a movement of the mouse to a
/// changed one. See benches/log/2026-11.md.
#[test]
#[ignore = "measures"]
fn how_soon_pictures_come() {
    let Some(desktop) = Desktop::start() else {
        return;
    };
    let settings = settings();
    let mut starts = Vec::new();
    for _ in 0..5 {
        let start = Instant::now();
        let mut program = desktop.program(&[], settings.path(), &[]);
        wait_for("a picture", || {
            (colors(&desktop.screenshot(INSIDE)) > 64).then_some(())
        });
        starts.push(start.elapsed().as_secs_f64());
        program.kill().expect("its end");
        program.wait().expect("its end");
        wait_for("an empty screen", || {
            (colors(&desktop.screenshot(INSIDE)) == 1).then_some(())
        });
    }
    let _opened = desktop.open(&["--samples", "1"], settings.path(), &[]);
    desktop.calm(INSIDE);
    desktop.xdotool(&["mousemove", "500", "400", "mousedown", "1", "sleep", "0.5"]);
    let mut movements: Vec<f64> = (0..30)
        .map(|number| {
            let x = if number % 2 == 0 { "560" } else { "530" };
            std::thread::sleep(Duration::from_millis(500));
            let before = desktop.screenshot(SPOT);
            let start = Instant::now();
            desktop.xdotool(&["mousemove", x, "400"]);
            while desktop.screenshot(SPOT) == before {
                assert!(start.elapsed() < PATIENCE, "another picture did not come");
                std::thread::sleep(Duration::from_millis(2));
            }
            start.elapsed().as_secs_f64()
        })
        .collect();
    movements.sort_by(f64::total_cmp);
    println!("start to first picture: {starts:.2?} s");
    println!(
        "movement to changed picture: median {:.3}, longest {:.3} s of {}",
        movements[movements.len() / 2],
        movements[movements.len() - 1],
        movements.len()
    );
}

/// `make gallery` runs this.
#[test]
#[ignore = "writes the window's pictures of README.md"]
fn pictures_of_the_window_for_the_readme() {
    let Some(desktop) = Desktop::start() else {
        return;
    };
    let settings = settings();
    let mirrors = scene("glass_and_mirrors.toml");
    let arguments = [mirrors.to_str().expect("a name"), "--samples", "9"];
    let opened = desktop.open(&arguments, settings.path(), &[]);
    let save = |name: &str| {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/gallery");
        let (width, height) = (u32::from(WINDOW[2]), u32::from(WINDOW[3]));
        let pixels = desktop.calm(WINDOW);
        let rgb = pixels
            .chunks_exact(4)
            .flat_map(|bgrx| [bgrx[2], bgrx[1], bgrx[0]]);
        let picture = image::RgbImage::from_raw(width, height, rgb.collect()).expect("the window");
        picture.save(folder.join(name)).expect("a picture");
    };
    let click = |x: &str, y: &str| desktop.xdotool(&["mousemove", x, y, "click", "1"]);
    desktop.calm(INSIDE);
    desktop.drag([600, 330], [630, 335]);
    save("window.jpg");

    opened.key("Home");
    opened.key("i");
    desktop.calm(INSIDE);
    click("560", "400");
    save("window_rays.jpg");

    // The Select tool, the golden ball, the Move tool and the tab of the Render panel. Buttons, because a key that
    // is pressed before the ball is selected does something else.
    for [x, y] in [
        ["302", "110"],
        ["740", "330"],
        ["302", "171"],
        ["889", "37"],
    ] {
        click(x, y);
        desktop.calm(WINDOW);
    }
    save("window_editing.jpg");
    opened.key("ctrl+q");
    assert_eq!(opened.wait(), Some(0));
}

#[test]
fn without_a_display_one_line_points_to_render() {
    let output = Command::new(env!("CARGO_BIN_EXE_glimray"))
        .arg("view")
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY")
        .env_remove("WAYLAND_SOCKET")
        .output()
        .expect("glimray");
    assert_eq!(output.status.code(), Some(5));
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(said.lines().count(), 1, "{said}");
    assert!(
        said.contains("no display") && said.contains("glimray render"),
        "{said}"
    );

    let elsewhere = Command::new(env!("CARGO_BIN_EXE_glimray"))
        .arg("view")
        .env("DISPLAY", ":4711")
        .env_remove("WAYLAND_DISPLAY")
        .env_remove("WAYLAND_SOCKET")
        .output()
        .expect("glimray");
    let said = String::from_utf8_lossy(&elsewhere.stderr);
    assert_eq!(elsewhere.status.code(), Some(5), "{said}");
    assert_eq!(said.lines().count(), 1, "{said}");
}

#[test]
fn without_a_vulkan_driver_one_line_names_the_package_to_install() {
    let Some(desktop) = Desktop::start() else {
        return;
    };
    let settings = settings();
    let output = desktop
        .command(env!("CARGO_BIN_EXE_glimray"))
        .arg("view")
        .arg(scene("sphere.scene"))
        .env("GLIMRAY_SETTINGS", settings.path())
        .env("VK_DRIVER_FILES", "/nonexistent")
        .output()
        .expect("glimray");
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(5), "{said}");
    assert_eq!(said.lines().count(), 1, "{said}");
    assert!(
        said.contains("no Vulkan driver") && said.contains("mesa-vulkan-drivers"),
        "{said}"
    );
}

#[test]
fn another_programs_window_shows_the_picture_of_the_command_line() {
    let Some(desktop) = Desktop::start() else {
        return;
    };
    let Some(example) = crate::examples::built("embed") else {
        return;
    };
    let folder = settings();
    let picture = folder.path().join("picture.png");
    let scene = scene("shapes.toml");
    let rendered = Command::new(env!("CARGO_BIN_EXE_glimray"))
        .arg("render")
        .args([&scene, Path::new("-o"), &picture])
        .output()
        .expect("glimray");
    assert!(rendered.status.success(), "{rendered:?}");
    let picture = ::image::open(&picture).expect("a picture").into_rgb8();
    let (width, height) = picture.dimensions();
    // The server puts windows in its upper left corner, with the bytes of a pixel as blue, green and red.
    let expected: Vec<_> = picture.pixels().map(|p| [p[2], p[1], p[0]]).collect();

    let mut program = (desktop.command(example).arg(&scene).spawn()).expect("the example");
    let shown = || {
        let pixels = desktop.screenshot([0, 0, width as u16, height as u16]);
        let pixels: Vec<_> = pixels.chunks_exact(4).map(|p| [p[0], p[1], p[2]]).collect();
        (pixels == expected).then_some(())
    };
    wait_for("the picture in the window", shown);
    program.kill().expect("ended");
    program.wait().expect("ended");
}
