//! Commands in the process of another program: a [`Host`] takes what they say, and pictures stay in memory. Arguments are
//! those of the command line, so that a keyword of a binding has the name, the default and the checks of its flag.

use crate::args::{Cli, Command, OutputFlags, RenderArgs};
use crate::destination::Destination;
use crate::device::Opening;
use crate::interrupt::Interrupt;
use crate::job::Job;
use crate::layers::Finished;
use crate::report::Draft;
use crate::{device, dispatch, exit, idle_flags, mesa, picture, render};
use clap::{ArgAction, ArgMatches, CommandFactory, FromArgMatches};
use glimray_app::error::AppError;
use glimray_app::host::{self, Host};
use glimray_app::layers::{LAYERS, PictureLayer};
use glimray_app::overrides::picture_size;
use glimray_app::picture_file;
use glimray_io::output::{ImageLayer, SaveOptions};
use glimray_render::gpu::{AdapterChoice, Gpu};
use glimray_render::{Film, RenderSettings, Tone};
use glimray_scene::image::Image;
use glimray_scene::{OutputDefaults, Scene};
use serde::Serialize;
use std::ffi::OsString;
use std::path::Path;
use std::rc::Rc;
use std::time::Instant;

pub use crate::compare::Figures;

/// A flag of a command, as a keyword of a function in another language.
#[derive(Clone, Debug, Serialize)]
pub struct Keyword {
    /// The name, with underscores.
    pub name: String,
    /// The flag, with its dashes.
    pub flag: String,
    /// The form of its value, such as `WxH`; empty for a switch.
    pub value: String,
    /// The values that it takes, if it takes no others.
    pub choices: Vec<String>,
    /// Whether it takes no value.
    pub is_switch: bool,
    /// Whether it may be given several times.
    pub is_repeatable: bool,
    /// The help.
    pub help: String,
}

/// Flags that only have a meaning on a command line: files that are written, and what is printed.
const COMMAND_LINE_ONLY: &[&str] = &[
    "output",
    "format",
    "no_clobber",
    "report",
    "progress",
    "quiet",
    "verbose",
    "json",
    "obj",
    "layers_parts",
    "sample_offset",
    "sample_count",
    "checkpoint",
    "every",
    "encode_only",
    "help",
    "version",
];

/// The keywords of a command, in the order of its help; none if there is no such command.
pub fn keywords(command: &str) -> Vec<Keyword> {
    let mut cli = Cli::command();
    cli.build();
    let found = cli.find_subcommand(command);
    let arguments = found.into_iter().flat_map(clap::Command::get_arguments);
    let keyword = |argument: &clap::Arg| {
        let flag = argument.get_long()?;
        let values = argument.get_value_names().unwrap_or_default();
        let choices = argument.get_possible_values();
        let is_switch = !argument.get_action().takes_values();
        Some(Keyword {
            name: flag.replace('-', "_"),
            flag: format!("--{flag}"),
            value: match is_switch {
                true => String::new(),
                false => values.join(" "),
            },
            choices: (choices.iter())
                .filter(|_| !is_switch)
                .map(|choice| choice.get_name().to_owned())
                .collect(),
            is_switch,
            is_repeatable: matches!(argument.get_action(), ArgAction::Append)
                && argument.get_value_delimiter().is_none(),
            help: argument
                .get_help()
                .map(ToString::to_string)
                .unwrap_or_default(),
        })
    };
    let is_known = |keyword: &Keyword| {
        // A picture that is rendered is saved later.
        let is_late = command == "render" && keyword.name == "quality";
        !is_late && !COMMAND_LINE_ONLY.contains(&keyword.name.as_str())
    };
    arguments.filter_map(keyword).filter(is_known).collect()
}

/// Environment variables for Mesa's drivers that are missing: see `mesa.rs`. They must be set before the first device is
/// opened. None are missing if this process has lavapipe already, which then has read them.
pub fn driver_environment(host: Rc<dyn Host>) -> Vec<(&'static str, OsString)> {
    let maps = std::fs::read_to_string("/proc/self/maps").unwrap_or_default();
    match maps.contains("libvulkan_lvp") {
        true => Vec::new(),
        false => host::with(host, || mesa::missing(false)),
    }
}

/// The command line of `arguments`, which begin with the command.
fn parsed(arguments: &[OsString]) -> Result<(Command, ArgMatches), AppError> {
    let program = [OsString::from("glimray")];
    let matches = Cli::command().try_get_matches_from(program.iter().chain(arguments));
    let parsed =
        matches.and_then(|matches| Ok((Cli::from_arg_matches(&matches)?.command, matches)));
    parsed.map_err(|error| AppError::Usage(exit::one_line(&error.to_string())))
}

/// Runs a command, which prints to the host.
///
/// # Errors
/// The errors of the command.
pub fn run(host: Rc<dyn Host>, arguments: &[OsString]) -> Result<(), AppError> {
    let (command, matches) = parsed(arguments)?;
    host::with(host, || dispatch(command, &matches, Instant::now(), None))
}

/// A scene as `convert` would write it, in the native format with companion files.
///
/// # Errors
/// The arguments are not those of `convert`, or the scene is refused or too large.
pub fn native(
    host: Rc<dyn Host>,
    arguments: &[OsString],
) -> Result<glimray_io::export::Export, AppError> {
    let (Command::Convert(arguments), _) = parsed(arguments)? else {
        return Err(AppError::Internal("not a conversion".into()));
    };
    host::with(host, || {
        let (scene, _) = crate::convert::scene(&arguments)?;
        let stem = arguments.scene.file_stem().unwrap_or("scene".as_ref());
        let export = glimray_io::export::native(&scene, &stem.to_string_lossy(), &|_, _| false);
        export.map_err(|error| AppError::Refused(error.to_string()))
    })
}

/// The scene that `inspect` with these arguments looks at.
///
/// # Errors
/// The arguments are not those of `inspect`, or the scene is refused.
pub fn scene(host: Rc<dyn Host>, arguments: &[OsString]) -> Result<Scene, AppError> {
    let (Command::Inspect(arguments), _) = parsed(arguments)? else {
        return Err(AppError::Internal("not an inspection".into()));
    };
    host::with(host, || crate::inspect::scene(&arguments))
}

/// The difference between two pictures of equal size. `tolerance` is the difference of a channel, in levels of 1/255, that
/// still counts as equal.
pub fn compare(a: &picture_file::Picture, b: &picture_file::Picture, tolerance: f64) -> Figures {
    Figures::new(a, b, tolerance)
}

/// A rendered picture with the film that it was developed from.
pub struct Picture {
    arguments: Box<RenderArgs>,
    output: OutputDefaults,
    settings: RenderSettings,
    film: Film,
    display: Finished,
}

/// Renders a picture, and returns it with the device that rendered it; the host gets its report.
///
/// # Errors
/// The arguments are not those of `render`, the scene is refused, or rendering fails.
pub fn render(host: Rc<dyn Host>, arguments: &[OsString]) -> Result<(Picture, Gpu), AppError> {
    let started = Instant::now();
    let (Command::Render(arguments), _) = parsed(arguments)? else {
        return Err(AppError::Internal("not a picture".into()));
    };
    host::with(host, || Picture::render(arguments, started))
}

impl Picture {
    fn render(arguments: Box<RenderArgs>, started: Instant) -> Result<(Self, Gpu), AppError> {
        let interrupt = Interrupt::install()?;
        idle_flags::check(&arguments.reading, &arguments.scene)?;
        let name = arguments.scene.display().to_string();
        let nowhere = Path::new("");
        let mut draft = Draft::new("render", &arguments.log, name, nowhere, started);
        let (job, shutter) = render::job(&arguments, &mut draft)?;
        job.warn_of_skipped()?;
        let settings = job.settings();
        job.check_format(&settings, nowhere, true, true)?;
        let size = picture_size(&settings)?;
        draft.set_image(job.image(nowhere, &settings, size));
        let tone = job.tone(&settings, false);
        let opening = Opening::start(&arguments.device);
        let mut renderer =
            picture::prepared(&job, opening, shutter, &settings, Some(tone), &mut draft)?;
        picture::trace(&job, &mut renderer, &interrupt, None)?;
        draft.catcher_light = renderer.catcher_light()?;
        let display = picture::develop(&job, &mut renderer, &settings, &tone, false)?;
        interrupt.check()?;
        draft.seconds.denoise = display.denoise_seconds();
        let mut film = renderer.film()?;
        film.set_tone(tone);
        let pixels = u64::from(size.0) * u64::from(size.1);
        job.conclude(
            &settings,
            (nowhere, size, pixels),
            &renderer,
            None,
            &mut draft,
        )?;
        let gpu = renderer.gpu().clone();
        let output = job.scene.output;
        let picture = Self {
            arguments,
            output,
            settings,
            film,
            display,
        };
        Ok((picture, gpu))
    }

    /// The adapter that was asked for.
    pub fn adapter(&self) -> AdapterChoice {
        self.arguments.device.choice()
    }

    /// Whether pixels have opacity.
    pub fn has_opacity(&self) -> bool {
        self.settings.has_opacity()
    }

    /// The pixels that a PNG file shows: after exposure, tone curve and transfer function, 0 to 1.
    pub fn display(&self) -> &Image {
        &self.display.image
    }

    /// The pixels that an OpenEXR file has: linear radiance, opacity not multiplied in.
    ///
    /// # Errors
    /// The device fails.
    pub fn linear(&self, host: Rc<dyn Host>) -> Result<Image, AppError> {
        let tone = self.tone(true);
        host::with(host, || Ok(self.finish(&tone, false)?.image))
    }

    /// The bytes of a PNG file.
    ///
    /// # Errors
    /// The picture is too large for a PNG file.
    pub fn png(&self) -> Result<Vec<u8>, AppError> {
        Ok(self.display.encoded(&SaveOptions::default())?)
    }

    /// Writes the picture to a file, with the bytes that `glimray render -o PATH --quality QUALITY` writes. A name that ends in
    /// `.film` keeps all samples.
    ///
    /// # Errors
    /// The name has no ending of a format, the format does not keep opacity or layers that were asked for, or the file cannot
    /// be written.
    pub fn save(
        &self,
        host: Rc<dyn Host>,
        path: &Path,
        quality: u8,
        clobber: bool,
    ) -> Result<(), AppError> {
        let flags = OutputFlags {
            path: Some(path.to_owned()),
            format: None,
            quality,
            no_clobber: !clobber,
        };
        let destination = Destination::new(&flags, path);
        let takes_layers = destination.takes_layers();
        let settings = &self.settings;
        let backdrop = Job::check_backdrop(settings, path, destination.takes_opacity());
        let size = picture_size(settings)?;
        backdrop.and_then(|()| destination.check(size.0, size.1))?;
        if destination.is_film() {
            return destination.save_film(&self.film);
        }
        match destination.is_linear() || takes_layers {
            true => {
                let tone = self.tone(destination.is_linear());
                destination.save(&host::with(host, || self.finish(&tone, takes_layers))?)
            }
            false => destination.save(&self.display),
        }
    }

    /// A layer, which must be among those that were rendered.
    ///
    /// # Errors
    /// There is no such layer, or it was not asked for.
    pub fn layer(&self, host: Rc<dyn Host>, name: &str) -> Result<ImageLayer, AppError> {
        let known = LAYERS.0.iter().find(|(known, ..)| *known == name);
        let Some((.., layer)) = known else {
            let names: Vec<_> = LAYERS.0.iter().map(|(name, ..)| *name).collect();
            return Err(AppError::Usage(format!(
                "no such layer ({name}): there are {}. Choose one of them.",
                names.join(", ")
            )));
        };
        let features = match *layer {
            PictureLayer::Beauty => None,
            _ => self.film.features(),
        };
        match (layer, features) {
            (PictureLayer::Beauty, _) => {
                let opacity = self.settings.has_opacity();
                let image = self.linear(host)?;
                Ok(ImageLayer::color("", &image, opacity, false))
            }
            (layer, Some(features)) => {
                let opacity = self.settings.has_opacity();
                Ok(layer.of(&self.display.image, opacity, &features))
            }
            (_, None) => Err(AppError::Usage(format!(
                "no such layer ({name}): the picture was rendered without it. Render it with --layers {name}."
            ))),
        }
    }

    fn tone(&self, is_linear: bool) -> Tone {
        let tone = self.arguments.picture.develop.overrides();
        tone.tone(&self.output, self.settings.integrator, is_linear)
    }

    fn finish(&self, tone: &Tone, takes_layers: bool) -> Result<Finished, AppError> {
        let gpu = device::open(&self.arguments.device)?;
        let layers = &self.arguments.layers;
        let finished = layers.finish(&self.film, &gpu, tone, takes_layers)?;
        Ok(finished.placed(self.settings.region(), self.settings.size))
    }
}
