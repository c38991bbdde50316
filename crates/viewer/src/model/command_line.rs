//! Converts the current view to a command line that renders the same picture, and back.
//!
//! Both ways resolve overrides as `render` does. A line that is pasted is parsed by the program's own command line.

mod flags;

use flags::Flags;
use glimray_app::clock::Clock;
use glimray_app::inputs::may_be_model;
use glimray_app::overrides::RenderOverrides;
use glimray_app::window::ParsePicture;
use glimray_io::import::{EnvironmentSource, Ground, Staging};
use glimray_render::{RenderSettings, Tone};
use glimray_scene::{Background, Camera, Scene, Section, Shutter, Target};
use std::borrow::Cow;
use std::path::{Path, PathBuf};

/// The current view.
#[derive(Clone, Copy, Debug)]
pub struct Shown<'a> {
    /// The scene's file.
    pub path: &'a Path,
    /// The importer options from `--set` and `--allow-dir`.
    pub options: &'a glimray_io::import::Options,
    /// The scene as imported, without flags.
    pub scene: &'a Scene,
    /// The camera in world space at that time.
    pub camera: &'a Camera,
    /// The background.
    pub background: &'a Background,
    /// The section plane.
    pub section: Option<Section>,
    /// The render settings.
    pub settings: &'a RenderSettings,
    /// The tone mapping.
    pub tone: Tone,
    /// The time in seconds.
    pub time: f64,
    /// Frames per second.
    pub fps: f64,
    /// The shutter interval, in frames.
    pub shutter: Shutter,
    /// Whether the scene has been edited since it was read.
    pub edited: bool,
}

/// A line for a shell.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CommandLine {
    /// `glimray render …`, quoted where needed.
    pub line: String,
    /// Differences that the line cannot express, a few words each. If there are any, the line renders a
    /// different picture.
    pub left_out: Vec<String>,
}

/// The contents of a command line.
#[derive(Clone, Debug, PartialEq)]
pub struct Pasted {
    /// The scene's file; `None` if the line has none.
    pub path: Option<PathBuf>,
    /// The camera in world space at that time.
    pub camera: Camera,
    /// The background.
    pub background: Background,
    /// The section plane.
    pub section: Option<Section>,
    /// The render settings.
    pub settings: RenderSettings,
    /// The tone mapping of a PNG.
    pub tone: Tone,
    /// The time in seconds.
    pub time: f64,
    /// Frames per second.
    pub fps: f64,
    /// The shutter interval, in frames.
    pub shutter: Shutter,
}

/// The line with which `glimray render` reproduces `shown` as a PNG: the file, and flags for all differences
/// from its defaults.
pub fn copy(shown: &Shown) -> CommandLine {
    let scene = without_geometry(shown.scene);
    let mut left_out = Vec::new();
    let mut arguments = vec!["glimray".to_owned(), "render".to_owned(), file(shown.path)];
    if shown.path.to_str().is_none() {
        left_out.push("the file name, which is not Unicode".to_owned());
    }
    for set in &shown.options.overrides {
        arguments.extend(["--set".to_owned(), set.clone()]);
    }
    for (flag, value) in [
        ("--scene", &shown.options.scene),
        ("--clip", &shown.options.clip),
        ("--variant", &shown.options.variant),
    ] {
        if let Some(value) = value {
            arguments.extend([flag.to_owned(), value.clone()]);
        }
    }
    if let Some(limit) = shown.options.texture_limit {
        arguments.extend(["--texture-limit".to_owned(), limit.to_string()]);
    }
    let environment = &shown.options.environment;
    let source = environment.source.as_ref().map(|source| match source {
        EnvironmentSource::File(path) => file(path),
        EnvironmentSource::BuiltIn(environment) => environment.entry().name.to_owned(),
        EnvironmentSource::Sky {
            elevation_deg,
            azimuth_deg,
        } => format!("sky:{elevation_deg},{azimuth_deg}"),
    });
    for (flag, value) in [
        ("--environment", source),
        (
            "--environment-strength",
            environment.strength.map(|factor| factor.to_string()),
        ),
        (
            "--environment-rotation",
            environment.rotation_deg.map(|angle| angle.to_string()),
        ),
    ] {
        arguments.extend(value.map(|value| format!("{flag}={value}")));
    }
    for folder in &shown.options.allow_dirs {
        arguments.extend(["--allow-dir".to_owned(), file(folder)]);
    }
    let staging = shown.options.staging;
    let is_bare = staging == Staging::NONE;
    for (flag, is_given) in [
        ("--fit", staging.fit),
        ("--bare", is_bare),
        ("--no-lights", !is_bare && !staging.lights),
        ("--no-background", !is_bare && !staging.background),
        ("--no-ground", !is_bare && staging.ground == Ground::None),
        ("--ground=surface", staging.ground == Ground::Surface),
        ("--ground=shadow", staging.ground == Ground::Shadow),
    ] {
        arguments.extend(is_given.then(|| flag.to_owned()));
    }
    if let Some(up) = shown.options.up {
        let up = format!("{up:?}").to_lowercase();
        arguments.extend(["--up".to_owned(), up]);
    }
    let mut scene = scene;
    let usual_size = shown.options.size.unwrap_or(scene.output.size);
    if may_be_model(shown.path) && shown.settings.size != usual_size {
        // With another size the model is framed again, and the views of its own cameras widen, so the camera is written in
        // full.
        scene.cameras.fill(Camera::default());
    }
    if let Ok(flags) = Flags::new(shown, &scene) {
        arguments.extend(flags.arguments);
        left_out.extend(flags.left_out.into_iter().map(str::to_owned));
    }
    // A background leaves out the ground that a model got without asking.
    let has_background = arguments.iter().any(|argument| argument == "--background");
    let stands = staging.ground == Ground::Default && shown.scene.staged;
    if has_background && stands && may_be_model(shown.path) {
        arguments.push("--ground=surface".to_owned());
    }
    if shown.edited {
        left_out.push("unsaved changes of the scene".to_owned());
    }
    let quoted: Vec<_> = arguments.iter().map(|argument| quoted(argument)).collect();
    CommandLine {
        line: quoted.join(" "),
        left_out,
    }
}

/// Applies a line to `scene`. It may be a complete command or only flags.
///
/// # Errors
/// The line is not a command of this program, or its arguments are invalid: why, in one line.
pub fn paste(parse: ParsePicture, line: &str, scene: &Scene) -> Result<Pasted, String> {
    // Line continuations.
    let line = line.replace("\\\n", " ");
    let Some(arguments) = shlex::split(line.trim().trim_start_matches('$')) else {
        return Err("Cannot read the command line: a quotation mark is not closed".to_owned());
    };
    let is_program = |argument: &String| {
        Path::new(argument)
            .file_stem()
            .is_some_and(|s| s == "glimray")
    };
    let mut arguments = match arguments.iter().position(is_program) {
        Some(at) => arguments[at..].to_vec(),
        None if arguments
            .first()
            .is_some_and(|argument| argument.starts_with("--")) =>
        {
            let start = ["glimray", "render", NO_FILE].map(str::to_owned);
            start.into_iter().chain(arguments).collect()
        }
        None => {
            return Err(
                "Cannot paste: the clipboard does not contain a `glimray` command line".to_owned(),
            );
        }
    };
    arguments[0] = "glimray".to_owned();
    let request = parse(&arguments)?;
    let pasted = resolve(&request.overrides, &without_geometry(scene))?;
    Ok(Pasted {
        path: (request.scene != Path::new(NO_FILE)).then_some(request.scene),
        ..pasted
    })
}

/// Stands for the scene in a line without one; no file has this name.
const NO_FILE: &str = "\n";

/// The picture of `scene` with overrides, without a path.
fn resolve(overrides: &RenderOverrides, scene: &Scene) -> Result<Pasted, String> {
    let mut scene = scene.clone();
    (overrides.camera.apply(&mut scene)).map_err(|error| error.to_string())?;
    let settings = overrides.picture.settings(&scene.output);
    let clock = Clock::new(&scene.output, &overrides.timing);
    let time = clock.time(&overrides.moment);
    Ok(Pasted {
        path: None,
        camera: scene.frame(time).camera,
        background: scene.background.clone(),
        section: scene.section,
        tone: (overrides.tone).tone(&scene.output, settings.integrator, false),
        settings,
        time,
        fps: clock.fps,
        shutter: clock.shutter,
    })
}

/// Cameras and settings depend on these; lines are resolved on it repeatedly.
pub fn without_geometry(scene: &Scene) -> Scene {
    let mut tracks = scene.tracks.clone();
    for track in &mut tracks {
        (track.targets).retain(|target| matches!(target, Target::Camera(..) | Target::Node(..)));
    }
    tracks.retain(|track| !track.targets.is_empty());
    Scene {
        cameras: scene.cameras.clone(),
        camera_index: scene.camera_index,
        background: scene.background.clone(),
        section: scene.section,
        nodes: scene.nodes.clone(),
        tracks,
        output: scene.output.clone(),
        ..Scene::default()
    }
}

/// Quotes an argument for a shell. Numbers with commas stay unquoted; `shlex` would quote them.
fn quoted(argument: &str) -> Cow<'_, str> {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_./:,".contains(c);
    if !argument.is_empty() && argument.chars().all(is_plain) {
        return argument.into();
    }
    // Only NUL cannot be quoted, which neither file names nor flags contain.
    shlex::try_quote(argument).unwrap_or_default()
}

/// A file name that is not mistaken for a flag.
fn file(path: &Path) -> String {
    let text = path.to_string_lossy();
    if text.starts_with('-') {
        format!("./{text}")
    } else {
        text.into_owned()
    }
}
