//! The viewer's picture as a command line, and the way back.

use crate::support::random::Random;
use crate::support::settings::texts;
use glam::{DAffine3, dvec2, dvec3, vec3};
use glimray::import;
use glimray::pack;
use glimray::render::{
    Antialias, Integrator, Levels, RayOffset, RenderSettings, Tone, TriangleTest,
};
use glimray::scene::{
    Background, Beyond, Camera, CameraProperty, Curve, Easing, Filter, Interpolation, Lens, Node,
    OutputDefaults, Scene, Section, Shutter, Target, ToneCurve, Track, Transfer, Values,
};
use glimray_app::overrides::ToneOverrides;
use glimray_app::settings::SETTINGS;
use glimray_cli::view::picture;
use glimray_viewer::model::camera::CameraController;
use glimray_viewer::model::command_line::{CommandLine, Pasted, Shown, copy, paste};
use std::path::{Path, PathBuf};
use std::process::Command;

/// A scene as the importer made it, and what is shown of it.
struct Screen {
    path: PathBuf,
    options: import::Options,
    scene: Scene,
    camera: Camera,
    background: Background,
    section: Option<Section>,
    settings: RenderSettings,
    tone: Tone,
    time: f64,
    fps: f64,
    shutter: Shutter,
    edited: bool,
}

impl Screen {
    /// As the scene says.
    fn of(scene: Scene) -> Self {
        let output = &scene.output;
        Self {
            path: "scene.toml".into(),
            options: import::Options::default(),
            camera: scene.frame(0.0).camera,
            background: scene.background.clone(),
            section: scene.section,
            settings: RenderSettings::from(output),
            tone: Tone::from(output),
            time: 0.0,
            fps: output.fps,
            shutter: output.shutter,
            edited: false,
            scene,
        }
    }

    fn copy(&self) -> CommandLine {
        copy(&Shown {
            path: &self.path,
            options: &self.options,
            scene: &self.scene,
            camera: &self.camera,
            background: &self.background,
            section: self.section,
            settings: &self.settings,
            tone: self.tone,
            time: self.time,
            fps: self.fps,
            shutter: self.shutter,
            edited: self.edited,
        })
    }

    /// Copies, pastes, and holds what comes of it against what is shown.
    #[track_caller]
    fn check(&self) -> String {
        let CommandLine { line, left_out } = self.copy();
        assert_eq!(left_out, Vec::<String>::new(), "{line}");
        let pasted =
            paste(picture, &line, &self.scene).unwrap_or_else(|why| panic!("{line}: {why}"));
        let expected = Pasted {
            path: Some(self.path.clone()),
            camera: Camera {
                name: pasted.camera.name.clone(),
                // Nobody sees the angle of a picture without perspective.
                fov_y: match self.camera.orthographic_height {
                    Some(_) => pasted.camera.fov_y,
                    None => self.camera.fov_y,
                },
                ..self.camera.clone()
            },
            background: self.background.clone(),
            section: self.section,
            settings: self.settings.clone(),
            tone: self.tone,
            time: self.time,
            fps: self.fps,
            shutter: self.shutter,
        };
        assert_eq!(pasted, expected, "{line}");
        line
    }
}

fn scene() -> Scene {
    Scene {
        cameras: vec![Camera {
            look_from: dvec3(1.0, 2.0, 9.0),
            look_at: dvec3(0.5, 0.25, 0.0),
            fov_y: 40_f64.to_radians(),
            ..Camera::default()
        }],
        materials: vec![glimray::scene::Material::default()],
        output: OutputDefaults {
            samples: 4,
            exposure_ev: 0.5,
            tone: Some(ToneCurve::Aces),
            ..OutputDefaults::default()
        },
        ..Scene::default()
    }
}

#[test]
fn a_scene_as_it_is_takes_no_flags() {
    assert_eq!(Screen::of(scene()).check(), "glimray render scene.toml");
}

#[test]
fn the_camera_of_a_line_packs_to_the_same_bits() {
    let mut random = Random::new(21);
    for i in 0..60 {
        let mut screen = Screen::of(scene());
        let mut rig = CameraController::new(&screen.camera, None);
        for _ in 0..3 {
            rig.orbit(300.0 * random.in_cube().truncate(), dvec2(640.0, 480.0));
            rig.zoom(random.between(-9.0, 9.0), Some(3.0 * random.in_cube()));
            rig.advance(random.between(0.0, 0.2));
        }
        match i % 4 {
            1 => rig.set_fov_y(random.between(0.01, 2.9)),
            2 => rig.toggle_orthographic(),
            3 => rig.roll(random.between(-3.0, 3.0)),
            _ => {}
        }
        screen.camera = rig.camera();
        let line = screen.check();
        let shown = paste(picture, &line, &screen.scene)
            .expect("a camera")
            .camera;
        let packed = |camera: &Camera| {
            let mut scene = scene();
            scene.cameras = vec![camera.clone()];
            let packed = pack::scene(&scene).expect("a scene");
            let view = packed.frame(&scene.frame(0.0)).expect("a frame");
            view.with_aspect(640, 480).frame.camera
        };
        assert_eq!(packed(&shown), packed(&screen.camera), "{line}");
    }
}

#[test]
fn every_setting_that_a_pixel_depends_on_is_in_the_line() {
    type Change = fn(&mut Screen);
    let rows: [(&str, Change); 27] = [
        ("--size 33x44", |s| s.settings.size = (33, 44)),
        ("--crop 1,2,30,40", |s| {
            s.settings.crop = Some([1, 2, 30, 40])
        }),
        ("--samples 7", |s| s.settings.samples = 7),
        ("--samples 1 --antialias stratified", |s| {
            s.settings.samples = 1
        }),
        ("--antialias adaptive", |s| {
            s.settings.antialias = Antialias::Adaptive
        }),
        ("--noise 0.003", |s| s.settings.noise = 0.003),
        ("--filter mitchell", |s| {
            s.settings.filter = Filter::Mitchell;
            s.settings.filter_radius = 2.0;
        }),
        ("--filter-radius 1.7", |s| s.settings.filter_radius = 1.7),
        ("--light-samples 0.3", |s| s.settings.light_samples = 0.3),
        (
            "--integrator uv --exposure 0.5 --tone aces --transfer srgb",
            |s| {
                s.settings.integrator = Integrator::Uv;
            },
        ),
        ("--integrator depth", |s| {
            s.settings.integrator = Integrator::Depth;
            s.tone = Tone {
                levels: Levels::Found,
                ..Tone::LINEAR
            };
        }),
        ("--triangle-test plane", |s| {
            s.settings.triangle_test = TriangleTest::Plane
        }),
        ("--offset fixed:0.0003", |s| {
            s.settings.offset = RayOffset::Fixed(3e-4)
        }),
        ("--no-bvh", |s| s.settings.brute_force = true),
        ("--no-bvh --seed 9", |s| {
            s.settings.brute_force = true;
            s.settings.seed = 9;
        }),
        ("--max-depth 17", |s| s.settings.max_depth = 17),
        ("--min-throughput 0.1", |s| s.settings.min_throughput = 0.1),
        ("--exposure -1.25", |s| s.tone.exposure_ev = -1.25),
        ("--tone none", |s| s.tone.curve = ToneCurve::None),
        ("--transfer linear", |s| s.tone.transfer = Transfer::Linear),
        ("--background 0.1,0.2,0.3", |s| {
            s.background = Background::Color(vec3(0.1, 0.2, 0.3));
        }),
        ("--time 1.5", |s| s.time = 1.5),
        ("--time -0.1", |s| s.time = -0.1),
        ("--fps 12.5", |s| s.fps = 12.5),
        ("--shutter 0.5", |s| {
            s.shutter = Shutter {
                open: 0.0,
                close: 0.5,
            };
        }),
        ("--shutter=-0.25..0.25", |s| {
            s.shutter = Shutter {
                open: -0.25,
                close: 0.25,
            };
        }),
        ("--fov-y 33.5", |s| s.camera.fov_y = 33.5_f64.to_radians()),
    ];
    for (flags, change) in rows {
        let mut screen = Screen::of(scene());
        change(&mut screen);
        let line = screen.check();
        let flags = flags.replace('=', " ");
        assert_eq!(line, format!("glimray render scene.toml {flags}"));
    }
}

#[test]
fn any_settings_come_back() {
    let mut random = Random::new(7);
    for _ in 0..200 {
        let mut screen = Screen::of(scene());
        for setting in SETTINGS.iter() {
            let texts = texts(setting);
            if random.below(3) == 0 {
                let text = &texts[random.below(texts.len())];
                (setting.set(&mut screen.settings, text)).expect("a value");
            }
        }
        let integrator = screen.settings.integrator;
        screen.tone = ToneOverrides::default().tone(&screen.scene.output, integrator, false);
        screen.check();
    }
}

/// `--background` leaves out the ground of a model that did not ask for it, but the window keeps it.
#[test]
fn a_background_in_the_line_does_not_take_the_ground_away() {
    for (path, staged, ground) in [
        ("m.obj", true, true),
        ("m.obj", false, false),
        ("a.toml", true, false),
    ] {
        let mut screen = Screen::of(scene());
        screen.path = path.into();
        screen.scene.staged = staged;
        assert!(!screen.check().contains("ground="));
        screen.background = Background::Color(vec3(0.1, 0.2, 0.3));
        let line = screen.check();
        assert_eq!(line.contains("--ground=surface"), ground, "{line}");
    }
}

#[test]
fn a_section_plane_is_in_the_line_and_so_is_none() {
    let section = Section {
        normal: dvec3(0.6, 0.0, -0.8),
        offset: 1.0 / 3.0,
    };
    let mut screen = Screen::of(scene());
    screen.section = Some(section);
    assert!(screen.check().contains("--section"));
    screen.scene.section = Some(section);
    assert!(!screen.check().contains("--section"));
    screen.section = None;
    assert!(screen.check().contains("--section=none") || screen.check().contains("--section none"));
}

#[test]
fn several_differences_at_once_come_back_too() {
    let mut screen = Screen::of(scene());
    screen.settings.samples = 9;
    screen.settings.antialias = Antialias::None;
    screen.settings.filter = Filter::Tent;
    screen.settings.filter_radius = 0.7;
    screen.settings.integrator = Integrator::Normals;
    screen.tone.curve = ToneCurve::None;
    screen.camera.look_from.x = -1.0 / 3.0;
    screen.camera.orthographic_height = Some(2.0 / 3.0);
    screen.time = 0.1;
    let line = screen.check();
    assert!(
        line.contains("--look-from -0.3333333333333333,2,9"),
        "{line}"
    );
    assert!(line.contains("--orthographic 0.6666666666666666"), "{line}");
}

#[test]
fn an_orthographic_scene_can_be_seen_with_perspective() {
    let mut scene = scene();
    scene.cameras[0].orthographic_height = Some(3.0);
    let mut screen = Screen::of(scene);
    assert_eq!(screen.check(), "glimray render scene.toml");
    screen.camera.orthographic_height = None;
    assert_eq!(screen.check(), "glimray render scene.toml --fov-y 40");
}

/// A camera that moves, that a node carries, and a second one with a lens.
fn moving() -> Scene {
    let mut scene = scene();
    scene.nodes.push(Node {
        placement: DAffine3::from_translation(dvec3(0.1, 0.2, 0.3)),
        ..Node::default()
    });
    scene.cameras[0].node = Some(0);
    let track = |property, values| Track {
        targets: vec![Target::Camera(0, property)],
        curve: Curve {
            times: vec![0.0, 2.0],
            values,
            interpolation: Interpolation::Linear,
            easing: Easing::None,
            beyond: Beyond::Hold,
        },
    };
    let way = vec![dvec3(0.0, 0.0, 9.0), dvec3(1.0, 2.0, 7.0)];
    scene.tracks = vec![
        track(CameraProperty::LookFrom, Values::Vector(way)),
        track(CameraProperty::FovY, Values::Scalar(vec![0.5, 0.8])),
    ];
    let mut second = scene.cameras[0].clone();
    second.name = "with a lens".to_owned();
    second.lens = Some(Lens {
        radius: 0.2,
        focus_distance: 4.0,
        blade_count: 6,
        blade_rotation: 0.5,
    });
    second.node = None;
    scene.cameras.push(second);
    scene
}

#[test]
fn moving_cameras_are_caught_at_their_moment() {
    let mut screen = Screen::of(moving());
    screen.time = 0.7;
    screen.camera = screen.scene.frame(0.7).camera;
    assert_eq!(screen.check(), "glimray render scene.toml --time 0.7");
    let mut rig = CameraController::new(&screen.camera, None);
    rig.orbit(dvec2(100.0, 30.0), dvec2(640.0, 480.0));
    screen.camera = rig.camera();
    let line = screen.check();
    assert!(
        line.contains("--look-from") && !line.contains("--fov-y"),
        "{line}"
    );
}

#[test]
fn a_lens_comes_with_the_camera_that_has_it() {
    let mut screen = Screen::of(moving());
    screen.scene.camera_index = 1;
    screen.camera = screen.scene.frame(0.0).camera;
    screen.scene.camera_index = 0;
    assert_eq!(screen.check(), "glimray render scene.toml --camera 1");
    screen.camera.lens.as_mut().expect("a lens").focus_distance = 5.0;
    let CommandLine { line, left_out } = screen.copy();
    assert_eq!(left_out, ["the camera's lens"], "{line}");
}

#[test]
fn what_a_line_cannot_say_is_named() {
    let mut screen = Screen::of(scene());
    screen.edited = true;
    screen.background = Background::Gradient {
        bottom: vec3(0.0, 0.0, 0.0),
        top: vec3(1.0, 1.0, 1.0),
    };
    screen.camera.look_from.x = 1e12;
    screen.settings.samples = 8;
    let CommandLine { line, left_out } = screen.copy();
    assert_eq!(
        left_out,
        [
            "the camera position",
            "the background",
            "unsaved changes of the scene"
        ]
    );
    assert_eq!(line, "glimray render scene.toml --samples 8");
}

#[cfg(unix)]
#[test]
fn a_shell_takes_the_line_apart_as_it_was_put_together() {
    for name in [
        "a b.toml",
        "it's.toml",
        "$HOME/`x`/\"y\".toml",
        "-o.toml",
        "a;rm -rf b&c|d>e.toml",
        "tab\there*.toml",
        "ünï.toml",
        "back\\slash.toml",
        "!bang #hash.toml",
    ] {
        let mut screen = Screen::of(scene());
        screen.path = name.into();
        screen.options.allow_dirs = vec!["other folder".into()];
        screen.options.overrides = vec!["camera.look_at=[0, 1, 2]".to_owned()];
        let CommandLine { line, left_out } = screen.copy();
        assert_eq!(left_out, Vec::<String>::new());
        let script = format!("printf '%s\\n' {line}");
        let output = Command::new("sh")
            .args(["-c", &script])
            .output()
            .expect("a shell");
        let words = String::from_utf8(output.stdout).expect("text");
        let file = match name.strip_prefix('-') {
            Some(_) => format!("./{name}"),
            None => name.to_owned(),
        };
        let expected = [
            "glimray",
            "render",
            &file,
            "--set",
            "camera.look_at=[0, 1, 2]",
            "--allow-dir",
            "other folder",
        ];
        assert_eq!(words.lines().collect::<Vec<_>>(), expected);
        let pasted = paste(picture, &line, &screen.scene).expect("a line");
        assert_eq!(pasted.path.as_deref(), Some(Path::new(&file)));
    }
}

#[test]
fn lines_are_read_as_people_have_them() {
    let scene = scene();
    let at =
        |line: &str| paste(picture, line, &scene).unwrap_or_else(|why| panic!("{line}: {why}"));
    let plain = at("glimray render a.toml --look-from 1,2,3 --fov-y 20");
    assert_eq!(plain.camera.look_from, dvec3(1.0, 2.0, 3.0));
    assert_eq!(plain.camera.fov_y, 20_f64.to_radians());
    assert_eq!(plain.camera.look_at, scene.cameras[0].look_at);
    for line in [
        "$ glimray render a.toml --look-from 1,2,3 --fov-y 20",
        "  ./target/release/glimray render 'a.toml' --fov-y=20 --look-from=1,2,3\n",
        "NODEVICE_SELECT=1 glimray render a.toml --fov-y 20 --look-from 1,2,3 -o b.png -q",
        "glimray render \\\n  a.toml \\\n --fov-y 20 --look-from 1,2,3",
    ] {
        assert_eq!(at(line), plain, "{line}");
    }
    assert_eq!(
        at("glimray animate a.toml --look-from 1,2,3 --fov-y 20 -o a.mp4"),
        plain
    );
    let bare = at("--look-from 1,2,3 --fov-y 20");
    assert_eq!((bare.path, &bare.camera), (None, &plain.camera));
    let frame = at("glimray render a.toml --frame 12 --fps 24");
    assert_eq!(frame.time, 0.5);
}

#[test]
fn what_is_no_line_of_ours_is_refused_in_one_line() {
    for (line, needle) in [
        ("", "not contain a `glimray` command line"),
        ("hello world", "not contain a `glimray` command line"),
        ("rm -rf /", "not contain a `glimray` command line"),
        ("glimray render 'a.toml", "quotation"),
        ("glimray render", "required"),
        ("glimray fly a.toml", "fly"),
        ("glimray render a.toml --fov-y 200", "--fov-y"),
        ("glimray render a.toml --look-from 1,2", "--look-from"),
        ("glimray render a.toml --camera nobody", "no such camera"),
        ("glimray render a.toml --look-at 1,2,9", "same point"),
        ("glimray doctor", "render"),
        ("glimray --help", "cannot"),
    ] {
        let mut scene = scene();
        scene.cameras[0].look_from = dvec3(1.0, 2.0, 9.0);
        let why = paste(picture, line, &scene).expect_err(line);
        assert!(why.contains(needle) && !why.contains('\n'), "{line}: {why}");
    }
}
