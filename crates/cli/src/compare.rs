//! `glimray compare A B`: measures the difference between two pictures, or between those of two folders.

mod comparison;
mod figures;
mod folders;
mod limits;

use crate::args::CompareArgs;
use crate::interrupt::Interrupt;
pub use figures::Figures;

use comparison::Comparison;
use folders::Folders;
use glimray_app::console;
use glimray_app::error::AppError;
use glimray_app::inputs::Inputs;
use glimray_app::picture_file::{self, Picture};
use glimray_io::output;
use glimray_scene::image::Image;
use limits::Limits;
use schemars::JsonSchema;
use serde::Serialize;
use std::path::Path;

/// The output of `--json`, for two pictures or for two folders.
#[derive(Serialize, JsonSchema)]
#[serde(untagged)]
pub enum ComparisonOutput {
    Pictures(Comparison),
    Folders(Folders),
}

impl ComparisonOutput {
    fn print(&self, as_json: bool) -> Result<(), AppError> {
        if as_json {
            let value = serde_json::to_value(self);
            let value = value.map_err(|error| AppError::Internal(format!("compare: {error}")))?;
            return console::print_json(&value);
        }
        console::print(&match self {
            Self::Pictures(comparison) => comparison.to_text(),
            Self::Folders(folders) => folders.to_text(),
        })
    }
}

pub fn run(arguments: &CompareArgs) -> Result<(), AppError> {
    Interrupt::install()?;
    let limits = Limits::new(arguments)?;
    let (a, b) = (&arguments.a, &arguments.b);
    match (a.is_dir(), b.is_dir()) {
        (true, true) => folders::run(arguments, &limits),
        (false, false) => pictures(arguments, &limits),
        _ => {
            let missing = [a, b].into_iter().find(|path| !path.exists());
            let why = missing.map_or_else(
                || "one is a folder and the other is not".to_owned(),
                |path| format!("{} is not there", path.display()),
            );
            Err(AppError::Refused(format!(
                "cannot compare ({}, {}): {why}. Give two pictures or two folders.",
                a.display(),
                b.display()
            )))
        }
    }
}

fn pictures(arguments: &CompareArgs, limits: &Limits) -> Result<(), AppError> {
    let (a, b) = (&arguments.a, &arguments.b);
    if let Some(path) = &arguments.diff {
        Inputs::new([a, b]).refuse_overwrite(path, "difference", "--diff")?;
        output::check(path, &output::SaveOptions::default(), 1, 1)?;
    }
    let names = format!("{}, {}", a.display(), b.display());
    let different =
        |why: &str| AppError::Different(format!("the pictures differ ({names}): {why}."));
    let pair = Pair::read(a, b)?;
    let figures = (pair.measure(limits)?).map_err(|why| different(&why))?;
    let exceeded = limits.exceeded(&figures);
    let comparison = Comparison::new([a, b], pair.a.size(), &figures, limits);
    ComparisonOutput::Pictures(comparison).print(arguments.json)?;
    if let Some(path) = &arguments.diff {
        pair.write_difference(path, &figures)?;
    }
    match exceeded {
        None => Ok(()),
        Some(why) => Err(different(&why)),
    }
}

/// Two pictures.
struct Pair {
    a: Picture,
    b: Picture,
}

impl Pair {
    fn read(a: &Path, b: &Path) -> Result<Self, AppError> {
        let (a, b) = (picture_file::read(a)?, picture_file::read(b)?);
        a.notes.iter().chain(&b.notes).for_each(console::warning);
        Ok(Self { a, b })
    }

    /// The figures of two pictures of equal size, or how their sizes differ.
    ///
    /// # Errors
    /// FLIP is limited, but the pictures are too large for it.
    fn measure(&self, limits: &Limits) -> Result<Result<Figures, String>, AppError> {
        let ([aw, ah], [bw, bh]) = (self.a.size(), self.b.size());
        if (aw, ah) != (bw, bh) {
            let why = format!("one is {aw}×{ah} pixels, the other {bw}×{bh}");
            return Ok(Err(why));
        }
        let figures = Figures::new(&self.a, &self.b, limits.tolerance);
        limits.check_flip(&figures, [aw, ah])?;
        Ok(Ok(figures))
    }

    /// Writes the absolute difference of every channel, scaled so that the largest is 1.
    fn write_difference(&self, path: &Path, figures: &Figures) -> Result<(), AppError> {
        let scale = match figures.max_levels {
            levels if levels > 0.0 => (255.0 / levels) as f32,
            _ => 1.0,
        };
        let pixels = self.a.image.pixels.iter().zip(&self.b.image.pixels);
        let difference = Image {
            pixels: pixels
                .map(|(a, b)| {
                    let [r, g, b] =
                        [0, 1, 2].map(|channel| (a[channel] - b[channel]).abs() * scale);
                    [r, g, b, 1.0]
                })
                .collect(),
            ..self.a.image
        };
        Ok(output::save(path, &difference)?)
    }
}

/// Rounds to four decimals.
fn rounded(value: f64) -> f64 {
    (value * 1e4).round() / 1e4
}
