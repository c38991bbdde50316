//! What is on the screen as a command line that makes the same picture, and the way back.
//!
//! Nothing here knows by itself what flags mean: a line is read by the program's own command line and
//! applied to the scene as `render` would, and flags are added until the outcome is what was shown.

mod flags;

use crate::app::clock::Clock;
use crate::app::window::{ParsePicture, PictureRequest};
use crate::render::{RenderSettings, Tone};
use crate::scene::{Background, Camera, Scene, Shutter, Target};
use std::borrow::Cow;
use std::path::{Path, PathBuf};

/// What is on the screen.
#[derive(Clone, Copy, Debug)]
pub struct Shown<'a> {
    /// The program's command line.
    pub parse: ParsePicture,
    /// The scene's file.
    pub path: &'a Path,
    /// What `--set` and `--allow-dir` gave the importer.
    pub options: &'a crate::import::Options,
    /// As the importer made it: no flags applied.
    pub scene: &'a Scene,
    /// In world space, at that time.
    pub camera: &'a Camera,
    /// What rays see that hit nothing.
    pub background: &'a Background,
    /// How it is traced.
    pub settings: &'a RenderSettings,
    /// How it is developed.
    pub tone: Tone,
    /// In seconds.
    pub time: f64,
    /// Frames per second.
    pub fps: f64,
    /// When the shutter is open, in frames.
    pub shutter: Shutter,
    /// Whether the scene was changed since it was read.
    pub edited: bool,
}

/// A line for a shell.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CommandLine {
    /// `glimray render …`, quoted where needed.
    pub line: String,
    /// What the line cannot say, a few words each: without these it makes another picture.
    pub left_out: Vec<String>,
}

/// What a command line says.
#[derive(Clone, Debug, PartialEq)]
pub struct Pasted {
    /// The scene's file; `None` if the line names none.
    pub path: Option<PathBuf>,
    /// In world space, at that time.
    pub camera: Camera,
    /// What rays see that hit nothing.
    pub background: Background,
    /// How it is traced.
    pub settings: RenderSettings,
    /// How a PNG is developed.
    pub tone: Tone,
    /// In seconds.
    pub time: f64,
    /// Frames per second.
    pub fps: f64,
    /// When the shutter is open, in frames.
    pub shutter: Shutter,
}

/// The line that `glimray render` makes a PNG from that shows what is `shown`: the file and what
/// differs from its defaults.
pub fn copy(shown: &Shown) -> CommandLine {
    let scene = without_geometry(shown.scene);
    let mut left_out = Vec::new();
    let mut words = vec!["glimray".to_owned(), "render".to_owned(), file(shown.path)];
    if shown.path.to_str().is_none() {
        left_out.push("the file's name, which is not Unicode".to_owned());
    }
    for set in &shown.options.overrides {
        words.extend(["--set".to_owned(), set.clone()]);
    }
    for folder in &shown.options.allow_dirs {
        words.extend(["--allow-dir".to_owned(), file(folder)]);
    }
    let mut tried: Vec<&str> = Vec::new();
    // One flag may change what others are by default, so each is added to what the line says so far.
    while let Some(difference) = outcome(shown.parse, &words, &scene)
        .ok()
        .and_then(|said| flags::all(shown, &scene, &said).find(|d| !tried.contains(&d.what)))
    {
        tried.push(difference.what);
        let length = words.len();
        for (flag, value) in difference.flags {
            words.push(flag.to_owned());
            words.extend(Some(value).filter(|value| !value.is_empty()));
        }
        // Beyond what the flag takes.
        if outcome(shown.parse, &words, &scene).is_err() {
            words.truncate(length);
        }
    }
    if let Ok(said) = outcome(shown.parse, &words, &scene) {
        left_out.extend(flags::all(shown, &scene, &said).map(|d| d.what.to_owned()));
    }
    if shown.edited {
        left_out.push("what was changed in the scene and not saved".to_owned());
    }
    let quoted: Vec<_> = words.iter().map(|word| quoted(word)).collect();
    CommandLine {
        line: quoted.join(" "),
        left_out,
    }
}

/// What a line says about a picture of `scene`. It may be a whole command or only flags.
///
/// # Errors
/// It is no command of this program, or one that it would refuse: one line on why.
pub fn paste(parse: ParsePicture, line: &str, scene: &Scene) -> Result<Pasted, String> {
    // Lines that go on in the next one.
    let line = line.replace("\\\n", " ");
    let Some(words) = shlex::split(line.trim().trim_start_matches('$')) else {
        return Err("cannot read the command line: a quotation has no end".to_owned());
    };
    let is_program = |word: &String| Path::new(word).file_stem().is_some_and(|s| s == "glimray");
    let mut words = match words.iter().position(is_program) {
        Some(at) => words[at..].to_vec(),
        None if words.first().is_some_and(|word| word.starts_with("--")) => {
            let start = ["glimray", "render", NO_FILE].map(str::to_owned);
            start.into_iter().chain(words).collect()
        }
        None => {
            return Err("cannot paste: what was copied is no `glimray` command line".to_owned());
        }
    };
    words[0] = "glimray".to_owned();
    outcome(parse, &words, &without_geometry(scene))
}

/// Stands in for the scene where a line has none; no file has that name.
const NO_FILE: &str = "\n";

fn outcome(parse: ParsePicture, words: &[String], scene: &Scene) -> Result<Pasted, String> {
    let PictureRequest {
        scene: path,
        overrides,
    } = parse(words)?;
    let mut scene = scene.clone();
    (overrides.camera.apply(&mut scene)).map_err(|error| error.to_string())?;
    let settings = overrides.picture.settings(&scene.output);
    let clock = Clock::new(&scene.output, &overrides.timing);
    let time = clock.time(&overrides.moment);
    Ok(Pasted {
        path: (path != Path::new(NO_FILE)).then_some(path),
        camera: scene.frame(time).camera,
        background: scene.background.clone(),
        tone: (overrides.tone).tone(&scene.output, settings.integrator, false),
        settings,
        time,
        fps: clock.fps,
        shutter: clock.shutter,
    })
}

/// What cameras and settings depend on: flags are tried on it more than once.
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
        nodes: scene.nodes.clone(),
        tracks,
        output: scene.output.clone(),
        ..Scene::default()
    }
}

/// A word as shells take it. Numbers and their commas stay as they are, which `shlex` would quote.
fn quoted(word: &str) -> Cow<'_, str> {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_./:,".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        return word.into();
    }
    // Only what no file's name and no flag contains cannot be quoted.
    shlex::try_quote(word).unwrap_or_default()
}

/// A file's name that is no flag.
fn file(path: &Path) -> String {
    let text = path.to_string_lossy();
    if text.starts_with('-') {
        format!("./{text}")
    } else {
        text.into_owned()
    }
}
