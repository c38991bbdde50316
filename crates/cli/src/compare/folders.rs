//! Compares the pictures of two folders that have the same names.

use super::comparison::Comparison;
use super::limits::Limits;
use super::{ComparisonOutput, Pair};
use crate::args::CompareArgs;
use glimray_app::error::AppError;
use glimray_app::inputs::Inputs;
use glimray_io::import::PICTURE_ENDINGS;
use glimray_io::output::{self, OutputError};
use schemars::JsonSchema;
use serde::Serialize;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Most names in the message of the end.
const MOST_NAMED: usize = 8;

/// The heads of the table.
const HEADS: [&str; 6] = ["picture", "RMSE", "PSNR", "FLIP", "largest", "beyond"];

/// The differences between the pictures of two folders.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Folders {
    /// Path of the first folder.
    pub a: String,
    /// Path of the second folder.
    pub b: String,
    /// Every picture of either folder, by name.
    pub pictures: Vec<Row>,
    /// Whether any of them differs, is missing or cannot be read.
    pub different: bool,
}

/// A picture of two folders.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Row {
    /// Path in the folders, with `/` between its parts.
    pub name: String,
    /// The figures; null if the pictures were not compared.
    pub comparison: Option<Comparison>,
    /// Which limit is exceeded, or why there are no figures; null if the pictures are alike.
    pub problem: Option<String>,
}

/// Compares them, and prints one table.
///
/// # Errors
/// A picture is missing in one of them, cannot be read, or differs beyond the limits.
pub fn run(arguments: &CompareArgs, limits: &Limits) -> Result<(), AppError> {
    let folders = [&arguments.a, &arguments.b];
    let [in_a, in_b] = [pictures(folders[0])?, pictures(folders[1])?];
    let shown = folders.map(|folder| folder.display().to_string());
    let [a, b] = shown.clone();
    if in_a.is_empty() && in_b.is_empty() {
        return Err(AppError::Refused(format!(
            "cannot compare the folders ({a}, {b}): neither has a picture. Give folders with files that end in {}.",
            PICTURE_ENDINGS.join(", ")
        )));
    }
    let names: BTreeSet<_> = in_a.union(&in_b).cloned().collect();
    if let Some(folder) = &arguments.diff {
        check_diff(folder, folders, &names)?;
    }
    let mut failure = None;
    let mut rows = Vec::with_capacity(names.len());
    for name in &names {
        let absent = [&in_a, &in_b].map(|names| !names.contains(name));
        let (comparison, problem) = match absent {
            [true, _] => (None, Some(format!("missing in {a}"))),
            [_, true] => (None, Some(format!("missing in {b}"))),
            _ => {
                let found = compare(arguments, limits, name);
                found.unwrap_or_else(|error| {
                    let problem = error.to_string();
                    failure.get_or_insert(error);
                    (None, Some(problem))
                })
            }
        };
        rows.push(Row {
            name: shown_name(name),
            comparison,
            problem,
        });
    }
    let different: Vec<_> = (rows.iter())
        .filter(|row| row.problem.is_some())
        .map(|row| row.name.clone())
        .collect();
    let result = Folders {
        a,
        b,
        pictures: rows,
        different: !different.is_empty(),
    };
    ComparisonOutput::Folders(result).print(arguments.json)?;
    match failure {
        Some(failure) => Err(failure),
        None if different.is_empty() => Ok(()),
        None => Err(AppError::Different(format!(
            "the folders differ ({}): {} of {} pictures differ or are missing: {}.",
            shown.join(", "),
            different.len(),
            names.len(),
            list(&different)
        ))),
    }
}

/// The figures of the pictures of this name, and what is beyond the limits. Writes their difference if it is.
fn compare(
    arguments: &CompareArgs,
    limits: &Limits,
    name: &Path,
) -> Result<(Option<Comparison>, Option<String>), AppError> {
    let paths = [arguments.a.join(name), arguments.b.join(name)];
    let pair = Pair::read(&paths[0], &paths[1])?;
    let figures = match pair.measure(limits)? {
        Ok(figures) => figures,
        Err(why) => return Ok((None, Some(why))),
    };
    let exceeded = limits.exceeded(&figures);
    if let (Some(folder), Some(_)) = (&arguments.diff, &exceeded) {
        let path = difference(folder, name);
        create_folder(path.parent().unwrap_or(folder))?;
        pair.write_difference(&path, &figures)?;
    }
    let comparison = Comparison::new(paths.each_ref(), pair.a.size(), &figures, limits);
    Ok((Some(comparison), exceeded))
}

/// Where the difference of two pictures is written: a PNG of their name.
fn difference(folder: &Path, name: &Path) -> PathBuf {
    let is_png = (name.extension()).is_some_and(|ending| ending.eq_ignore_ascii_case("png"));
    let mut path = folder.join(name).into_os_string();
    if !is_png {
        path.push(".png");
    }
    path.into()
}

/// Creates the folder of the differences if there is none, and refuses one in which they would replace an input.
fn check_diff(
    folder: &Path,
    inputs: [&PathBuf; 2],
    names: &BTreeSet<PathBuf>,
) -> Result<(), AppError> {
    let files = inputs.map(|input| names.iter().map(|name| input.join(name)));
    let inputs = Inputs::new(files.into_iter().flatten());
    for name in names {
        inputs.refuse_overwrite(&difference(folder, name), "difference", "--diff")?;
    }
    create_folder(folder)
}

fn create_folder(folder: &Path) -> Result<(), AppError> {
    fs::create_dir_all(folder).map_err(|source| {
        let path = folder.into();
        OutputError::Io { path, source }.into()
    })
}

/// The pictures in a folder and those below it, as paths in it: files with an ending of a picture, hidden ones left out.
fn pictures(folder: &Path) -> Result<BTreeSet<PathBuf>, AppError> {
    let mut found = BTreeSet::new();
    let mut open = vec![PathBuf::new()];
    while let Some(below) = open.pop() {
        let here = folder.join(&below);
        let failed = |error| {
            let why = output::reason(&error);
            AppError::Refused(format!(
                "cannot read the folder ({}): {why}.",
                here.display()
            ))
        };
        for entry in fs::read_dir(&here).map_err(failed)? {
            let entry = entry.map_err(failed)?;
            let name = below.join(entry.file_name());
            // Links to folders are not followed: they may lead in a circle.
            let is_folder = entry.file_type().map_err(failed)?.is_dir();
            if entry.file_name().to_string_lossy().starts_with('.') {
                continue;
            }
            if is_folder {
                open.push(name);
            } else if is_picture(&name) {
                found.insert(name);
            }
        }
    }
    Ok(found)
}

fn is_picture(name: &Path) -> bool {
    let ending = name.extension().unwrap_or_default();
    PICTURE_ENDINGS
        .iter()
        .any(|known| ending.eq_ignore_ascii_case(known))
}

fn shown_name(name: &Path) -> String {
    let parts: Vec<_> = name.iter().map(|part| part.to_string_lossy()).collect();
    // A name cannot imitate lines of the table.
    parts.join("/").replace(char::is_control, " ")
}

/// The first few, separated by commas.
fn list(names: &[String]) -> String {
    let shown = names.iter().take(MOST_NAMED).map(String::as_str);
    let text = shown.collect::<Vec<_>>().join(", ");
    match names.len().saturating_sub(MOST_NAMED) {
        0 => text,
        more => format!("{text} and {more} more"),
    }
}

impl Folders {
    /// A line for each picture.
    pub fn to_text(&self) -> String {
        let cells = self.pictures.iter().map(|row| {
            let figures = row.comparison.as_ref().map(Comparison::to_cells);
            let mut cells = vec![row.name.clone()];
            cells.extend(figures.unwrap_or_else(|| ["-"; 5].map(str::to_owned)));
            cells
        });
        let heads = HEADS.map(str::to_owned).to_vec();
        let table: Vec<Vec<String>> = std::iter::once(heads).chain(cells).collect();
        let width = |column: usize| {
            let cells = table.iter().map(|cells| cells[column].chars().count());
            cells.max().unwrap_or_default()
        };
        let results = self.pictures.iter();
        let results = results.map(|row| row.problem.as_deref().unwrap_or("ok"));
        let mut text = String::new();
        for (cells, result) in table.iter().zip(std::iter::once("result").chain(results)) {
            text += &format!("{:<1$}", cells[0], width(0));
            for (column, cell) in cells.iter().enumerate().skip(1) {
                text += &format!("  {cell:>0$}", width(column));
            }
            text += &format!("  {result}\n");
        }
        text
    }
}
