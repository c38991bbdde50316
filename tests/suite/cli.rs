//! The command line as scripts see it: exit codes, messages, files.

use glimray::image::Image;
use glimray::output;
use serde_json::Value;
use std::ffi::OsStr;
use std::fs;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Command, Output, Stdio};
use tempfile::TempDir;

/// One red sphere and one light, in the course's format.
const SCENE: &str = "2
amb: 0.1 0.1 0.1
sphere
pos: 0 0 -3
rad: 1
dif: 0.7 0.1 0.1
spe: 0.2 0.2 0.2
shi: 20
light
pos: 2 2 1
col: 1 1 1
";

/// A folder of its own for each test, with a scene in it.
struct Workplace(TempDir);

impl Workplace {
    fn new() -> Self {
        let place = Self(tempfile::tempdir().expect("a temporary folder"));
        fs::write(place.path("a.scene"), SCENE).expect("a scene");
        place
    }

    fn path(&self, name: &str) -> std::path::PathBuf {
        self.0.path().join(name)
    }

    fn command<S: AsRef<OsStr>>(&self, arguments: impl IntoIterator<Item = S>) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_glimray"));
        command.current_dir(self.0.path()).args(arguments);
        command.stdin(Stdio::null());
        // With a display the program would open its window.
        for name in ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"] {
            command.env_remove(name);
        }
        command
    }

    /// Runs `glimray` with the words of `line`.
    fn run(&self, line: &str) -> Run {
        Run::from(
            self.command(line.split_whitespace())
                .output()
                .expect("glimray runs"),
        )
    }

    /// Everything in the folder but the scene, hidden files too.
    fn made(&self) -> Vec<String> {
        let mut names: Vec<_> = fs::read_dir(self.0.path())
            .expect("a readable folder")
            .map(|entry| {
                entry
                    .expect("an entry")
                    .file_name()
                    .to_string_lossy()
                    .into_owned()
            })
            .filter(|name| name != "a.scene")
            .collect();
        names.sort();
        names
    }

    fn picture(&self, name: &str, width: u32, pixels: &[[f32; 3]]) {
        let image = Image {
            width,
            height: pixels.len() as u32 / width,
            pixels: pixels.iter().map(|&[r, g, b]| [r, g, b, 1.0]).collect(),
        };
        output::save(self.path(name), &image).expect("saved");
    }
}

/// What a run of the program left.
#[derive(Debug)]
struct Run {
    code: Option<i32>,
    stdout: Vec<u8>,
    stderr: String,
}

impl From<Output> for Run {
    fn from(output: Output) -> Self {
        Self {
            code: output.status.code(),
            stdout: output.stdout,
            stderr: String::from_utf8(output.stderr).expect("messages are text"),
        }
    }
}

impl Run {
    fn text(&self) -> &str {
        std::str::from_utf8(&self.stdout).expect("text on the standard output")
    }

    fn json(&self) -> Value {
        serde_json::from_slice(&self.stdout).expect("JSON on the standard output")
    }

    /// Fails unless the run ended with `code`.
    #[track_caller]
    fn expect(self, code: i32) -> Self {
        assert_eq!(self.code, Some(code), "{}", self.stderr);
        self
    }
}

#[test]
fn no_arguments_show_the_help_and_exit_2() {
    let run = Workplace::new().run("").expect(2);
    assert!(
        run.stderr.contains("Usage: glimray <COMMAND>"),
        "{}",
        run.stderr
    );
}

#[test]
fn help_and_version_go_to_the_standard_output() {
    let place = Workplace::new();
    let help = place.run("--help").expect(0);
    assert!(help.text().contains("Exit codes") && help.stderr.is_empty());
    let version = place.run("--version").expect(0);
    assert_eq!(
        version.text(),
        format!("glimray {}\n", env!("CARGO_PKG_VERSION"))
    );
}

#[test]
fn help_explains_every_promised_flag_with_an_example() {
    let device = "--adapter --backend --memory-limit";
    let log = "--report --count-rays --progress --quiet -q --verbose -v";
    let output = "-o --output --format --quality --no-clobber";
    let picture = "--antialias --filter --filter-radius --light-samples --integrator --triangle-test --no-bvh --exposure --tone --transfer \
        --seed --crop --camera --fov-y --orthographic --look-from --look-at --up --background";
    let reading = "--strict --set --allow-dir";
    let size = "--size --samples";
    let motion = "--fps --shutter";
    let frames = "--frames --step --loop --frames-dir --discard-frames --encode-only";
    let turn = "--seconds --axis --elevation --fov-y --margin --clockwise --background";
    let place = Workplace::new();
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
        ("compare", "--tolerance --max-share --diff --json".into()),
        ("bench", ["--json --repeats --only", device].join(" ")),
        ("completions", "bash zsh fish".into()),
        ("man", "<DIR>".into()),
        ("schema", "--help".into()),
    ] {
        let help = place.run(&format!("{command} --help")).expect(0);
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
fn bad_command_lines_exit_2_and_say_why() {
    let place = Workplace::new();
    for (flags, why) in [
        (
            "--size 0x0",
            "width and height must be a number from 1 to 1000000, not `0`",
        ),
        ("--size -1x5", "not `-1`"),
        ("--size 640", "WIDTHxHEIGHT"),
        ("--size 1e9x1", "not `1e9`"),
        ("--size 2000000x1", "not `2000000`"),
        ("--samples 0", "0 is not in 1..=65536"),
        ("--samples -3", "-3 is not in"),
        ("--samples many", "invalid digit"),
        ("--look-from nan,0,0", "not `nan`"),
        ("--look-at 1,2", "X,Y,Z, which is 3 numbers, not 2"),
        ("--look-at 1,2,3,4", "not 4"),
        ("--look-from 1e999,0,0", "not `1e999`"),
        ("--look-from 0,0,-1", "both are the same point"),
        ("--up 0,0,0", "it has no length"),
        ("--up 0,0,5", "it is the viewing direction"),
        (
            "--background -1,0,0",
            "every channel must be a number from 0",
        ),
        ("--fov-y 180", "from 0.001 to 179.9"),
        ("--fov-y NaN", "from 0.001 to 179.9"),
        ("--exposure inf", "from -64 to 64"),
        ("--seed -1", "-1"),
        ("--crop 0,0,0,5", "it is empty"),
        ("--crop 0,0,641,5", "outside of 640×480 pixels"),
        ("--camera nobody", "no such camera"),
        ("--quality 0", "0 is not in 1..=100"),
        ("--quality 101", "101 is not in 1..=100"),
        ("--memory-limit 0", "0 is not in"),
        ("--set novalue", "KEY=VALUE"),
        ("--tone acse", "a similar value exists: 'aces'"),
        (
            "--backend opengl",
            "[possible values: vulkan, metal, dx12, gl]",
        ),
        (
            "--integrator path",
            "[possible values: whitted, normals, depth, ids, uv, heat, samples]",
        ),
        (
            "--filter lanczos",
            "[possible values: box, tent, gaussian, blackman-harris, mitchell]",
        ),
        ("--filter-radius 0", "it must be a number from 0.01 to 16"),
        ("--filter-radius NaN", "it must be a number from 0.01 to 16"),
        (
            "--light-samples 0",
            "it must be a number from 0.001 to 1000",
        ),
        (
            "--light-samples -1",
            "it must be a number from 0.001 to 1000",
        ),
        (
            "--antialias some",
            "[possible values: none, stratified, adaptive]",
        ),
        ("--noise 0", "it must be a number from 0.000001 to 1"),
        ("--max-depth 1001", "1001 is not in 0..=1000"),
        ("--max-depth -1", "invalid value '-1'"),
        ("--min-throughput 2", "it must be a number from 0 to 1"),
        (
            "--format bmp",
            "[possible values: png, jpeg, jpg, exr, hdr]",
        ),
        ("--quiet --verbose", "cannot be used with"),
        ("--bogus", "unexpected argument '--bogus'"),
        (
            "-o picture.bmp",
            "cannot tell the picture format (picture.bmp)",
        ),
        ("-o picture", "cannot tell the picture format (picture)"),
        ("-o a.jpg --size 65536x1", "JPEG holds at most 65535×65535"),
        ("-o a.png --report a.png", "the picture goes there"),
    ] {
        let run = place.run(&format!("render a.scene {flags}")).expect(2);
        assert!(run.stderr.contains(why), "{flags}: {}", run.stderr);
        assert!(run.stderr.starts_with("error: "), "{flags}: {}", run.stderr);
        assert_eq!(
            run.stderr.matches("error:").count(),
            1,
            "{flags}: {}",
            run.stderr
        );
        assert!(run.stdout.is_empty(), "{flags}");
    }
    assert!(place.made().is_empty());
}

#[test]
fn refused_scenes_exit_3_with_one_line() {
    let place = Workplace::new();
    fs::write(
        place.path("skips.scene"),
        SCENE.replacen('2', "9 # skip", 1),
    )
    .expect("a scene");
    for line in [
        "render nothing.scene",
        "inspect nothing.scene",
        "render skips.scene --strict",
    ] {
        let run = place.run(line).expect(3);
        assert!(run.stderr.starts_with("error: "), "{}", run.stderr);
        assert_eq!(run.stderr.trim_end().lines().count(), 1, "{}", run.stderr);
    }
    let run = place.run("inspect skips.scene --strict").expect(3);
    let start = "error: refusing the scene (skips.scene): ";
    let end = "Repair it or leave out --strict.\n";
    assert!(
        run.stderr.starts_with(start) && run.stderr.ends_with(end),
        "{}",
        run.stderr
    );
}

#[test]
fn outputs_that_cannot_be_written_exit_4_before_any_rendering() {
    let place = Workplace::new();
    fs::write(place.path("old.png"), "old").expect("a file");
    let run = |flags: &str| {
        place
            .run(&format!("render a.scene {flags}"))
            .expect(4)
            .stderr
    };
    insta::assert_snapshot!(run("-o no/a.png"), @"error: cannot write the file (no/a.png): the folder no does not exist. Create it first.");
    insta::assert_snapshot!(run("-o ."), @"error: cannot write the file (.): it is a folder. Add a file name.");
    insta::assert_snapshot!(run("-o old.png --no-clobber"), @"error: cannot write the file (old.png): it exists and is to be kept. Choose another name.");
    insta::assert_snapshot!(run("--report no/a.json"), @"error: cannot write the file (no/a.json): the folder no does not exist. Create it first.");
    assert_eq!(fs::read(place.path("old.png")).expect("a file"), b"old");
    assert_eq!(place.made(), ["old.png"]);
}

#[cfg(target_os = "linux")]
#[test]
fn without_an_adapter_the_exit_code_is_5_and_doctor_says_what_to_install() {
    let place = Workplace::new();
    let run = |line: &str| {
        // A loader of Vulkan that finds no driver.
        let mut command = place.command(line.split_whitespace());
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
    assert!(place.made().is_empty());
}

#[cfg(target_os = "linux")]
#[test]
fn a_backend_of_another_system_is_refused_without_drivers_to_install() {
    let place = Workplace::new();
    for (backend, why) in [
        ("metal", "only Apple's systems have Metal"),
        ("dx12", "only Windows has DirectX 12"),
    ] {
        let run = place
            .run(&format!("render a.scene --backend {backend}"))
            .expect(5);
        assert_eq!(
            run.stderr,
            format!(
                "error: no usable GPU (--backend {backend}): {why}. Leave out --backend, or choose \
                 another one.\n"
            )
        );
        let doctor = place.run(&format!("doctor --backend {backend}")).expect(5);
        assert!(!doctor.text().contains("install"), "{}", doctor.text());
    }
}

#[test]
fn inspect_tells_what_is_in_a_scene() {
    let place = Workplace::new();
    let scene = place.run("inspect a.scene --json").expect(0).json();
    assert_eq!(scene["spheres"], 1);
    assert_eq!(scene["lights"], 1);
    assert_eq!(scene["triangles"], 0);
    assert_eq!(
        scene["bounds"]["min"],
        serde_json::json!([-1.0, -1.0, -4.0])
    );
    assert_eq!(
        scene["cameras"][0]["look_at"],
        serde_json::json!([0.0, 0.0, -1.0])
    );
    let text = place.run("inspect a.scene").expect(0);
    for line in [
        "spheres    1",
        "lights     1",
        "bounds     (-1, -1, -4) to (1, 1, -2)",
    ] {
        assert!(text.text().contains(line), "{}", text.text());
    }
}

#[test]
fn completions_and_schema_are_printed() {
    let place = Workplace::new();
    for (shell, mark) in [
        ("bash", "complete -F _glimray"),
        ("zsh", "#compdef glimray"),
        ("fish", "complete -c glimray"),
    ] {
        let run = place.run(&format!("completions {shell}")).expect(0);
        assert!(run.text().contains(mark), "{shell}");
        assert!(run.text().contains("triangle-test"), "{shell}");
    }
    place.run("completions tcsh").expect(2);
    let schema = place.run("schema").expect(0).json();
    assert!(schema["$schema"].is_string(), "{schema}");
}

#[test]
fn a_converted_scene_is_the_same_picture_and_nothing_in_the_way_is_replaced() {
    let place = Workplace::new();
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/scenes");
    for name in [
        "lighthouse.obj",
        "neutral.nff",
        "spheres_and_triangles.scene",
    ] {
        let from = scenes.join(name);
        let run = place
            .run(&format!("convert {} -o new.toml", from.display()))
            .expect(0);
        let files: Vec<_> = run.text().lines().map(|line| place.path(line)).collect();
        assert!(!files.is_empty(), "no files are named");
        assert!(files.iter().all(|file| file.is_file()), "{files:?}");
        let flags = "--size 40x30 --samples 1 --quiet";
        place
            .run(&format!("render {} {flags} -o a.exr", from.display()))
            .expect(0);
        place
            .run(&format!("render new.toml {flags} -o b.exr"))
            .expect(0);
        let read = |name: &str| fs::read(place.path(name)).expect("a picture");
        assert!(read("a.exr") == read("b.exr"), "{name} looks different");
    }
    // The same again leaves the same files; others of the same name stay as they are.
    let model = scenes.join("lighthouse.obj");
    let convert = format!("convert {} -o ship.toml", model.display());
    place.run(&convert).expect(0);
    let files = || fs::read_dir(place.path(".")).expect("a folder").count();
    let before = files();
    place.run(&convert).expect(0);
    assert_eq!(files(), before);
    fs::write(place.path("ship-lighthouse.ply"), "mine").expect("written");
    place.run(&convert).expect(0);
    assert_eq!(
        fs::read(place.path("ship-lighthouse.ply")).expect("there"),
        b"mine"
    );
    assert_eq!(files(), before + 1);
    place.run(&format!("{convert} --no-clobber")).expect(4);
    place.run("convert ship.toml -o ./ship.toml").expect(4);
    place.run("convert ship.toml -o ship.obj").expect(2);
    place.run("convert gone.toml").expect(3);
    fs::copy(&model, place.path("my.model.obj")).expect("a copy");
    fs::write(place.path("my.toml"), "mine").expect("written");
    let run = place.run("convert my.model.obj").expect(0);
    let last = run.text().lines().last().map(str::to_owned);
    assert_eq!(last.as_deref(), Some("my.model.toml"));
    assert_eq!(fs::read(place.path("my.toml")).expect("there"), b"mine");
}

/// 2×2 black pixels, and the same with the last 3 levels brighter in red.
fn compared(place: &Workplace) {
    let black = [[0.0; 3]; 4];
    let mut other = black;
    other[3][0] = 3.0 / 255.0;
    place.picture("a.png", 2, &black);
    place.picture("b.png", 2, &other);
}

#[test]
fn compare_finds_the_figures_worked_out_by_hand() {
    let place = Workplace::new();
    compared(&place);
    let run = place.run("compare a.png b.png --json").expect(8);
    let figures = run.json();
    let number = |name: &str| figures[name].as_f64().expect(name);
    // One of 12 channels is off by 3/255.
    let rmse = 3.0 / 255.0 / 12_f64.sqrt();
    assert!((number("rmse") - rmse).abs() < 1e-8, "{figures}");
    assert!((number("psnr_db") - 49.381).abs() < 1e-3, "{figures}");
    assert_eq!(number("max_levels"), 3.0);
    assert_eq!(figures["max_at"], serde_json::json!([1, 1]));
    assert_eq!(number("beyond_percent"), 25.0);
    assert!(number("flip") > 0.0 && number("flip") < 1.0);
    assert_eq!(figures["different"], true);
    insta::assert_snapshot!(run.stderr, @"error: the pictures differ (a.png, b.png): 25 % of the pixels by more than 0 of 255 levels, 0 % may.");
    let text = place.run("compare a.png b.png --tolerance 3").expect(0);
    let lines: Vec<_> = text
        .text()
        .lines()
        .filter(|line| !line.starts_with("FLIP"))
        .collect();
    insta::assert_snapshot!(lines.join("\n"), @r"
    size      2×2 pixels
    RMSE      0.003396 (0.866 levels)
    PSNR      49.38 dB
    largest   3 levels, at 1,1
    beyond    0 % of the pixels by more than 3 levels
    ");
}

#[test]
fn compare_lets_pass_what_tolerance_and_share_allow() {
    let place = Workplace::new();
    compared(&place);
    place.run("compare a.png a.png").expect(0);
    place.run("compare a.png b.png").expect(8);
    place.run("compare a.png b.png --tolerance 2.9").expect(8);
    place.run("compare a.png b.png --tolerance 3").expect(0);
    place.run("compare a.png b.png --max-share 25").expect(0);
    place.run("compare a.png b.png --max-share 24.9").expect(8);
    place.run("compare a.png b.png --tolerance -1").expect(2);
    place.run("compare a.png b.png --max-share 101").expect(2);
}

#[test]
fn compare_of_equal_pictures_finds_nothing() {
    let place = Workplace::new();
    compared(&place);
    let figures = place.run("compare b.png b.png --json").expect(0).json();
    assert_eq!(figures["rmse"], 0.0);
    assert_eq!(figures["flip"], 0.0);
    assert_eq!(figures["psnr_db"], Value::Null, "it is infinite");
}

#[test]
fn compare_takes_floats_as_they_are() {
    let place = Workplace::new();
    place.picture("a.exr", 1, &[[0.0, 5.0, 100.0]]);
    place.picture("b.exr", 1, &[[0.0, 5.0, 102.0]]);
    place.picture("c.exr", 1, &[[f32::NAN, 5.0, 102.0]]);
    let figures = place.run("compare a.exr b.exr --json").expect(8).json();
    assert_eq!(figures["max_levels"], 510.0);
    assert_eq!(figures["flip"], 0.0, "both are white on a screen");
    place.run("compare a.exr b.exr --tolerance 510").expect(0);
    place.run("compare b.exr c.exr --tolerance 1e9").expect(8);
    place.run("compare c.exr c.exr").expect(0);
}

#[test]
fn compare_draws_the_difference() {
    let place = Workplace::new();
    compared(&place);
    place.run("compare a.png b.png --diff d.png").expect(8);
    let drawn = image::open(place.path("d.png"))
        .expect("a picture")
        .into_rgb8();
    assert_eq!(drawn.into_raw(), [0, 0, 0, 0, 0, 0, 0, 0, 0, 255, 0, 0]);
    place.run("compare a.png b.png --diff no/d.png").expect(4);
    place.run("compare a.png b.png --diff d.bmp").expect(2);
}

#[test]
fn compare_tells_sizes_apart_and_refuses_what_is_no_picture() {
    let place = Workplace::new();
    compared(&place);
    place.picture("wide.png", 3, &[[0.0; 3]; 3]);
    fs::write(place.path("broken.png"), b"\x89PNG\r\n\x1a\nnot really").expect("a file");
    let run = place.run("compare a.png wide.png").expect(8);
    insta::assert_snapshot!(run.stderr, @"error: the pictures differ (a.png, wide.png): one is 2×2 pixels, the other 3×1.");
    let run = place.run("compare a.png nothing.png").expect(3);
    insta::assert_snapshot!(run.stderr, @"error: cannot read the picture (nothing.png): no such file or directory. Give a PNG, JPEG, OpenEXR or Radiance HDR file.");
    for name in ["broken.png", "a.scene", "."] {
        let run = place.run(&format!("compare a.png {name}")).expect(3);
        assert_eq!(run.stderr.trim_end().lines().count(), 1, "{}", run.stderr);
    }
}

#[test]
fn a_reader_that_goes_away_is_no_fault() {
    let place = Workplace::new();
    for line in ["inspect a.scene", "schema", "completions bash", "--help"] {
        let mut command = place.command(line.split_whitespace());
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().expect("glimray runs");
        drop(child.stdout.take());
        let run = Run::from(child.wait_with_output().expect("it ends")).expect(0);
        assert!(run.stderr.is_empty(), "{line}: {}", run.stderr);
    }
}

#[test]
fn a_closed_standard_error_costs_the_words_only() {
    let place = Workplace::new();
    let mut command = place.command(["render", "nothing.scene"]);
    command.stdout(Stdio::null()).stderr(Stdio::piped());
    let mut child = command.spawn().expect("glimray runs");
    drop(child.stderr.take());
    assert_eq!(child.wait().expect("it ends").code(), Some(3));
}

#[cfg(target_os = "linux")]
#[test]
fn results_that_find_no_room_exit_4() {
    let place = Workplace::new();
    for line in [
        "inspect a.scene",
        "schema",
        "completions bash",
        "--help",
        "--version",
    ] {
        let full = fs::File::options()
            .write(true)
            .open("/dev/full")
            .expect("a device");
        let mut command = place.command(line.split_whitespace());
        let run = Run::from(command.stdout(full).output().expect("glimray runs")).expect(4);
        assert_eq!(
            run.stderr,
            "error: cannot write the result (standard output): no space left on device. Send it elsewhere.\n",
            "{line}"
        );
    }
}

// From here on an adapter is needed.

/// The names of all fields, as `outer.inner`.
fn field_names(value: &Value, prefix: &str) -> Vec<String> {
    let Value::Object(fields) = value else {
        return vec![prefix.trim_end_matches('.').into()];
    };
    let mut names: Vec<_> = fields
        .iter()
        .flat_map(|(name, value)| field_names(value, &format!("{prefix}{name}.")))
        .collect();
    names.sort();
    names
}

#[test]
fn the_report_has_the_promised_fields() {
    let place = Workplace::new();
    place
        .run("render a.scene --size 32x24 --count-rays --report r.json -o a.png")
        .expect(0);
    let text = fs::read_to_string(place.path("r.json")).expect("a report");
    let report: Value = serde_json::from_str(&text).expect("JSON");
    let promised = "adapter.backend adapter.device_type adapter.driver adapter.name command \
        cut_off_trees error glimray image.height image.integrator image.max_depth image.mean_samples image.path image.samples image.seed \
        image.width memory.gpu_bytes memory.host_peak_bytes nonfinite_samples rays.primary \
        rays.primary_hits rays.reflection rays.reflection_hits rays.refraction \
        rays.refraction_hits rays.shadow rays.shadow_blocked scene.instances scene.lights \
        scene.materials scene.path scene.shapes scene.skipped scene.spheres scene.triangles \
        seconds.bvh seconds.compile seconds.develop seconds.gpu seconds.load seconds.total \
        seconds.trace seconds.upload seconds.write submissions.count submissions.longest_ms";
    assert_eq!(field_names(&report, "").join(" "), promised);
    assert_eq!(report["command"], "render");
    assert_eq!(report["scene"]["spheres"], 1);
    assert_eq!(report["image"]["width"], 32);
    assert_eq!(report["image"]["path"], "a.png");
    assert_eq!(report["image"]["integrator"], "whitted");
    assert_eq!(report["rays"]["primary"], 32 * 24);
    let seconds = |name: &str| report["seconds"][name].as_f64().expect(name);
    let parts = [
        "load", "bvh", "gpu", "compile", "upload", "trace", "develop", "write",
    ];
    let sum: f64 = parts.iter().map(|part| seconds(part)).sum();
    assert!(sum <= seconds("total"), "{report}");
}

#[test]
fn rays_are_null_unless_counted_and_the_report_may_go_to_the_standard_output() {
    let place = Workplace::new();
    let run = place
        .run("render a.scene --size 8x8 --report - -o a.png")
        .expect(0);
    assert_eq!(run.json()["rays"], Value::Null);
}

#[test]
fn a_picture_on_the_standard_output_is_nothing_but_the_picture() {
    let place = Workplace::new();
    let run = place.run("render a.scene --size 32x24 -o -").expect(0);
    let picture = image::load_from_memory(&run.stdout).expect("a picture");
    assert_eq!((picture.width(), picture.height()), (32, 24));
    assert!(run.stdout.starts_with(b"\x89PNG"));
    let run = place
        .run("render a.scene --size 32x24 -o - --format exr --quiet")
        .expect(0);
    assert!(run.stdout.starts_with(&[0x76, 0x2f, 0x31, 0x01]));
    assert!(run.stderr.is_empty(), "{}", run.stderr);
    assert!(place.made().is_empty());
}

#[test]
fn the_same_command_gives_the_same_bytes_and_the_default_name_is_the_scenes() {
    let place = Workplace::new();
    let render = || {
        place
            .run("render a.scene --size 64x48 --samples 4")
            .expect(0);
        fs::read(place.path("a.png")).expect("a picture")
    };
    assert!(render() == render());
    assert_eq!(place.made(), ["a.png"]);
}

#[test]
fn the_adapter_is_named_unless_quiet() {
    let place = Workplace::new();
    let run = place.run("render a.scene --size 8x6").expect(0);
    assert!(
        run.stderr.starts_with("rendering 8×6 on "),
        "{}",
        run.stderr
    );
    let run = place.run("render a.scene --size 8x6 --quiet").expect(0);
    assert_eq!(run.stderr, "");
}

#[test]
fn progress_comes_as_json_on_request_and_not_at_all_into_a_pipe() {
    let place = Workplace::new();
    let run = place
        .run("render a.scene --size 64x48 --quiet --progress json")
        .expect(0);
    let lines: Vec<Value> = run
        .stderr
        .lines()
        .map(|line| serde_json::from_str(line).expect("JSON"))
        .collect();
    let last = lines.last().expect("a line");
    assert_eq!(last["progress"], 1.0);
    let run = place.run("render a.scene --size 64x48 --quiet").expect(0);
    assert_eq!(run.stderr, "");
}

#[test]
fn a_crop_is_that_part_of_the_whole_picture() {
    let place = Workplace::new();
    place
        .run("render a.scene --size 64x48 -o whole.png")
        .expect(0);
    place
        .run("render a.scene --size 64x48 --crop 20,10,45,31 -o part.png")
        .expect(0);
    let whole = image::open(place.path("whole.png")).expect("a picture");
    let part = image::open(place.path("part.png")).expect("a picture");
    assert!(whole.crop_imm(20, 10, 25, 21).into_rgb8() == part.into_rgb8());
}

#[test]
fn linear_formats_get_light_without_tone_curve_or_transfer() {
    let place = Workplace::new();
    place.run("render a.scene --size 16x16 -o a.exr").expect(0);
    place
        .run("render a.scene --size 16x16 -o b.png --transfer linear --tone none")
        .expect(0);
    place.run("compare a.exr b.png --tolerance 0.51").expect(0);
    place
        .run("render a.scene --size 16x16 -o c.exr --transfer srgb")
        .expect(0);
    place.run("compare a.exr c.exr --tolerance 1").expect(8);
}

#[test]
fn a_file_stays_as_it_was_when_the_disk_takes_no_more() {
    let place = Workplace::new();
    if Path::new("/dev/full").exists() {
        let run = place
            .run("render a.scene --size 8x8 --quiet -o /dev/full")
            .expect(4);
        assert!(
            run.stderr.contains("no space left on device"),
            "{}",
            run.stderr
        );
    }
}

#[test]
fn the_demo_needs_no_file() {
    let place = Workplace::new();
    place.run("demo --size 32x18").expect(0);
    let demo = image::open(place.path("glimray.png")).expect("a picture");
    assert_eq!((demo.width(), demo.height()), (32, 18));
}

#[test]
fn doctor_finds_the_adapter_and_its_self_test_passes() {
    let doctor = Workplace::new().run("doctor --json").expect(0).json();
    assert!(doctor["chosen"].is_u64());
    assert_eq!(doctor["self_test"]["passed"], true, "{doctor}");
}

/// Starts a render that would take very long, sends `signal` when it is under way, and returns how
/// it ended.
#[cfg(unix)]
fn interrupted(place: &Workplace, signal: &str) -> Option<i32> {
    let line = "render a.scene --size 2048x2048 --samples 65536 --progress json -o a.png";
    let mut command = place.command(line.split_whitespace());
    let mut child = command
        .stderr(Stdio::piped())
        .spawn()
        .expect("glimray runs");
    let mut lines = BufReader::new(child.stderr.take().expect("a pipe")).lines();
    let under_way = lines.any(|line| line.is_ok_and(|line| line.contains("\"progress\"")));
    assert!(under_way, "the render ended early");
    let kill = Command::new("kill")
        .args([signal, &child.id().to_string()])
        .status();
    assert!(kill.expect("kill runs").success());
    let rest: Vec<_> = lines.map_while(Result::ok).collect();
    let last = rest
        .last()
        .and_then(|line| serde_json::from_str::<Value>(line).ok());
    let last = last.expect("JSON");
    assert_eq!(last["error"], "interrupted: no picture was written.");
    child.wait().expect("it ends").code()
}

#[cfg(unix)]
#[test]
fn ctrl_c_exits_130_and_leaves_nothing() {
    let place = Workplace::new();
    assert_eq!(interrupted(&place, "-INT"), Some(130));
    assert!(place.made().is_empty(), "{:?}", place.made());
}

#[cfg(unix)]
#[test]
fn sigterm_exits_143_and_leaves_the_old_picture() {
    let place = Workplace::new();
    fs::write(place.path("a.png"), "old").expect("a file");
    assert_eq!(interrupted(&place, "-TERM"), Some(143));
    assert_eq!(fs::read(place.path("a.png")).expect("a file"), b"old");
    assert_eq!(place.made(), ["a.png"]);
}

#[test]
fn a_scene_without_light_says_so_once() {
    let place = Workplace::new();
    let ball = "[[objects]]\nsphere = { center = [0, 0, 0], radius = 1 }\n";
    fs::write(place.path("dark.toml"), ball).expect("a scene");
    let lit = format!("[[lights]]\npoint = {{ position = [3, 3, 3] }}\n{ball}");
    fs::write(place.path("lit.toml"), lit).expect("a scene");
    for (name, count) in [("dark", 1), ("lit", 0)] {
        let render = place.run(&format!("render {name}.toml --size 8x8 -o {name}.png"));
        let said = render.expect(0).stderr;
        assert_eq!(said.matches("has no light").count(), count, "{said}");
        let inspect = place.run(&format!("inspect {name}.toml")).expect(0);
        let text = inspect.text();
        assert_eq!(text.matches("has no light").count(), count, "{text}");
        let json = place.run(&format!("inspect {name}.toml --json"));
        assert_eq!(json.expect(0).json()["unlit"], count == 1);
    }
}

#[test]
fn inspect_tells_of_lenses_and_area_lights() {
    let place = Workplace::new();
    let text = "[camera]\nlook_from = [0, 0, 5]\nlook_at = [0, 0, 0]\nlens = { radius = 0.5, blades = 7 }\n\
        [[lights]]\ndisc = { center = [0, 4, 0], normal = [0, -1, 0], radius = 2, samples = 9, visible = false }";
    fs::write(place.path("lens.toml"), text).expect("a scene");
    let scene = place.run("inspect lens.toml --json").expect(0).json();
    let lens = &scene["cameras"][0]["lens"];
    assert_eq!(
        (&lens["radius"], &lens["focus_distance"], &lens["blades"]),
        (&0.5.into(), &5.0.into(), &7.into())
    );
    let light = &scene["lights"][0];
    assert!(light.is_null() || light["samples"] == 9, "{scene}");
    let text = place.run("inspect lens.toml").expect(0);
    for part in [
        "lens of radius 0.5 sharp at 5",
        "radius 2, attenuation inverse-square, 9 sample(s), invisible",
    ] {
        assert!(text.text().contains(part), "{}", text.text());
    }
}

#[test]
fn a_pixel_is_explained_as_a_tree_as_json_and_as_lines() {
    let place = Workplace::new();
    let run = place
        .run("explain a.scene --size 9x9 --pixel 4,4 --obj rays.obj")
        .expect(0);
    insta::assert_snapshot!(run.text(), @r"
    pixel 4,4 of 9×9
    sample 0: 2 ray(s), weight 1
    └ primary hits shape 0 after 2, material 0
      │ at (0, 0, -2), normal (0, 0, 1), from outside
      │ throughput 1 1 1, adds 0.1 0.1 0.1 (ambient 0.1 0.1 0.1)
      └ shadow to light 0, 4.123 away: free, throughput 1 1 1, adds 0.5097 0.07311 0.07311
      sum 0.6097 0.1731 0.1731, colour 0.6097 0.1731 0.1731
    sum    0.6097 0.1731 0.1731, the weighted mean of 1 sample(s)
    pixel  0.6097 0.1731 0.1731 (linear)
    ");
    let lines = fs::read_to_string(place.path("rays.obj")).expect("lines");
    // From the eye to the sphere, and from there to the light; shadow rays start a little above the
    // surface.
    let vertices = lines.lines().filter_map(|line| line.strip_prefix("v "));
    let numbers = vertices.flat_map(|vertex| vertex.split(' ').map(|c| c.parse::<f64>()));
    let expected = [0.0, 0.0, 0.0, 0.0, 0.0, -2.0, 0.0, 0.0, -2.0, 2.0, 2.0, 1.0];
    let numbers: Vec<_> = numbers.map(|number| number.expect("a number")).collect();
    assert_eq!(numbers.len(), expected.len(), "{lines}");
    let near = |(a, b): (&f64, f64)| (a - b).abs() < 1e-4;
    assert!(numbers.iter().zip(expected).all(near), "{lines}");
    let words: Vec<_> = lines
        .lines()
        .filter(|line| !line.starts_with("v "))
        .collect();
    assert_eq!(
        words,
        [
            "# rays of pixel 4,4",
            "o sample_0",
            "g primary",
            "l 1 2",
            "g shadow",
            "l 3 4"
        ]
    );
    let json = place
        .run("explain a.scene --size 9x9 --pixel 4,4 --json")
        .expect(0)
        .json();
    assert_eq!(json["pixel"], serde_json::json!([4, 4]));
    assert_eq!(json["size"], serde_json::json!([9, 9]));
    let rays = &json["samples"][0]["rays"];
    assert_eq!(rays[0]["kind"], "primary");
    assert_eq!(
        rays[0]["hit"]["object"],
        serde_json::json!({ "kind": "shape", "index": 0 })
    );
    assert_eq!(rays[1]["kind"], "shadow");
    assert_eq!(rays[1]["parent"], 0);
    assert_eq!(rays[0]["children"], serde_json::json!([1]));
    for channel in 0..3 {
        let of = |value: &Value| value[channel].as_f64().expect("a number");
        let sum = of(&rays[0]["contribution"]) + of(&rays[1]["contribution"]);
        assert!((sum - of(&json["value"])).abs() < 1e-6, "{json:#}");
        assert!((sum - of(&json["sum"])).abs() < 1e-6, "{json:#}");
    }
}

#[test]
fn explaining_what_is_not_there_exits_2_with_one_line() {
    let place = Workplace::new();
    let run = |flags: &str| {
        let run = place
            .run(&format!("explain a.scene --size 9x9 {flags}"))
            .expect(2);
        assert_eq!(run.stderr.lines().count(), 1, "{}", run.stderr);
        run.stderr
    };
    insta::assert_snapshot!(run("--pixel 9,0"), @"error: no such pixel (--pixel 9,0): the picture has columns 0 to 8 and rows 0 to 8. Choose one of them.");
    insta::assert_snapshot!(run("--pixel 0,0 --crop 2,3,5,6"), @"error: no such pixel (--pixel 0,0): what --crop leaves of it has columns 2 to 4 and rows 3 to 5. Choose one of them.");
    insta::assert_snapshot!(run("--pixel 0,0 --integrator depth"), @"error: cannot explain (--integrator depth): only whitted sends rays on. Leave it out.");
    insta::assert_snapshot!(run("--pixel 0,0 --sample 4 --samples 4"), @"error: no such sample (--sample 4): the pixel has 4, from 0 to 3. Choose one of them, or set --samples.");
    place.run("explain a.scene").expect(2);
    place.run("explain a.scene --pixel 1").expect(2);
    place.run("explain a.scene --pixel 1,-1").expect(2);
    place
        .run("explain a.scene --pixel 1,1 --obj no/rays.obj")
        .expect(4);
    place.run("explain nothing.scene --pixel 1,1").expect(3);
}

#[test]
fn a_lost_device_does_not_change_what_is_explained() {
    let place = Workplace::new();
    let line = "explain a.scene --size 9x9 --samples 4 --pixel 4,4 --json";
    let expected = place.run(line).expect(0);
    // The first submission is the idle one of a new pipeline; two more count and record the rays.
    for fault in ["device@2", "device@3", "device@2,4", "device@1,3,5"] {
        let mut command = place.command(line.split_whitespace());
        let run = Run::from(
            command
                .env("GLIMRAY_FAULT", fault)
                .output()
                .expect("glimray runs"),
        );
        assert_eq!(run.expect(0).text(), expected.text(), "{fault}");
    }
    let mut command = place.command(line.split_whitespace());
    let run = Run::from(
        command
            .env("GLIMRAY_FAULT", "device@*")
            .output()
            .expect("it runs"),
    );
    run.expect(6);
}

#[test]
fn films_of_parts_merge_to_the_picture_of_one_run() {
    let place = Workplace::new();
    let render = "render a.scene --size 40x30 --samples 150 --quiet";
    let read = |name: &str| fs::read(place.path(name)).expect("a file");
    place.run(&format!("{render} -o one.png")).expect(0);
    place.run(&format!("{render} -o one.film")).expect(0);
    for part in [
        "--sample-count 64 -o a.film",
        "--sample-offset 64 --crop 0,0,40,11 -o b.film",
        "--sample-offset 64 --crop 0,11,40,30 -o c.film",
    ] {
        place.run(&format!("{render} {part}")).expect(0);
    }
    place
        .run("merge c.film a.film b.film -o all.film")
        .expect(0);
    place.run("merge all.film -o all.png").expect(0);
    assert!(read("all.film") == read("one.film"));
    assert!(read("all.png") == read("one.png"));

    let run = place.run("merge a.film c.film -o less.png").expect(8);
    let lacking = "missing are samples 64 to 149 of 40×11 pixels at 0,0";
    assert!(run.stderr.contains(lacking), "{}", run.stderr);
    assert!(!place.path("less.png").exists());
    let run = place.run("merge a.film all.film -o more.film").expect(3);
    assert!(run.stderr.contains("overlap"), "{}", run.stderr);
    place
        .run(&format!("{render} --seed 1 --crop 0,0,40,11 -o d.film"))
        .expect(0);
    let run = place.run("merge a.film d.film -o other.film").expect(3);
    assert!(
        run.stderr.contains("differ in the settings"),
        "{}",
        run.stderr
    );
    place.run("merge a.film -o ./a.film").expect(4);
}

#[test]
fn files_that_are_no_films_and_parts_that_cannot_be_are_refused() {
    let place = Workplace::new();
    let render = "render a.scene --size 16x12 --samples 150 --quiet";
    place.run(&format!("{render} -o a.film")).expect(0);
    let bytes = fs::read(place.path("a.film")).expect("a film");
    fs::write(place.path("short.film"), &bytes[..bytes.len() / 2]).expect("written");
    let mut damaged = bytes.clone();
    damaged[bytes.len() / 2] ^= 1;
    fs::write(place.path("damaged.film"), damaged).expect("written");
    for (name, why) in [
        ("short.film", "cut short"),
        ("damaged.film", "damaged"),
        ("a.scene", "not a film"),
        ("gone.film", "gone.film"),
    ] {
        let run = place.run(&format!("merge {name} -o out.png")).expect(3);
        assert!(run.stderr.contains(why), "{}", run.stderr);
    }
    for (flags, why) in [
        ("--sample-offset 64 -o part.png", "only a film"),
        ("--sample-offset 10 -o part.film", "multiples of 64"),
        ("--sample-count 10 -o part.film", "multiples of 64"),
        ("--sample-offset 192 -o part.film", "0 to 149"),
        (
            "--antialias adaptive --sample-count 64 -o part.film",
            "adaptive",
        ),
    ] {
        let run = place.run(&format!("{render} {flags}")).expect(2);
        assert!(run.stderr.contains(why), "{}", run.stderr);
    }
    assert_eq!(place.made(), ["a.film", "damaged.film", "short.film"]);
}
