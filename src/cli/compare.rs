//! `glimray compare A B`: measures the difference between two pictures.

mod figures;

use crate::app::console;
use crate::app::error::AppError;
use crate::app::inputs::Inputs;
use crate::app::picture_file::{self, Picture};
use crate::cli::args::CompareArgs;
use crate::cli::interrupt::Interrupt;
use crate::image::Image;
use crate::output;
use figures::Figures;
use serde_json::json;
use std::path::Path;

pub fn run(arguments: &CompareArgs) -> Result<(), AppError> {
    Interrupt::install()?;
    if let Some(path) = &arguments.diff {
        Inputs::new([&arguments.a, &arguments.b]).refuse_overwrite(path, "difference", "--diff")?;
        output::check(path, &output::SaveOptions::default(), 1, 1)?;
    }
    let a = picture_file::read(&arguments.a)?;
    let b = picture_file::read(&arguments.b)?;
    let names = format!("{}, {}", arguments.a.display(), arguments.b.display());
    let ([aw, ah], [bw, bh]) = (a.size(), b.size());
    if (aw, ah) != (bw, bh) {
        return Err(AppError::Different(format!(
            "the pictures differ ({names}): one is {aw}×{ah} pixels, the other {bw}×{bh}."
        )));
    }

    let figures = Figures::new(&a, &b, arguments.tolerance);
    let differ = figures.beyond_percent > arguments.max_share;
    if arguments.json {
        console::print_json(&to_json(arguments, &a, &figures, differ))?;
    } else {
        console::print(&to_text(arguments, &a, &figures))?;
    }
    if let Some(path) = &arguments.diff {
        write_difference(path, &a, &b, &figures)?;
    }
    if differ {
        return Err(AppError::Different(format!(
            "the pictures differ ({names}): {} % of pixels differ by more than {}/255; the limit is {} %.",
            rounded(figures.beyond_percent),
            arguments.tolerance,
            arguments.max_share
        )));
    }
    Ok(())
}

fn to_json(
    arguments: &CompareArgs,
    a: &Picture,
    figures: &Figures,
    differ: bool,
) -> serde_json::Value {
    let [width, height] = a.size();
    // JSON has no infinity, so the PSNR of equal pictures is null.
    json!({
        "a": arguments.a.display().to_string(),
        "b": arguments.b.display().to_string(),
        "width": width,
        "height": height,
        "rmse": figures.rmse,
        "psnr_db": figures.psnr_db(),
        "flip": figures.flip,
        "max_levels": figures.max_levels,
        "max_at": figures.max_at,
        "tolerance_levels": arguments.tolerance,
        "beyond_percent": figures.beyond_percent,
        "different": differ,
    })
}

fn to_text(arguments: &CompareArgs, a: &Picture, figures: &Figures) -> String {
    let [width, height] = a.size();
    let [x, y] = figures.max_at;
    let flip = figures.flip.map_or_else(
        || match cfg!(feature = "flip") {
            true => "not computed: too many pixels".to_owned(),
            false => "not computed: built without the feature `flip`".to_owned(),
        },
        |flip| format!("{flip:.6}"),
    );
    let (rmse, levels) = (figures.rmse, figures.rmse * 255.0);
    format!(
        "size      {width}×{height} pixels\n\
         RMSE      {rmse:.6} ({levels:.3} levels)\n\
         PSNR      {:.2} dB\n\
         FLIP      {flip}\n\
         largest   {} levels at {x},{y}\n\
         beyond    {} % of pixels differ by more than {} levels\n",
        figures.psnr_db(),
        rounded(figures.max_levels),
        rounded(figures.beyond_percent),
        arguments.tolerance,
    )
}

/// Writes the absolute difference of every channel, scaled so that the largest is 1.
fn write_difference(
    path: &Path,
    a: &Picture,
    b: &Picture,
    figures: &Figures,
) -> Result<(), AppError> {
    let scale = match figures.max_levels {
        levels if levels > 0.0 => (255.0 / levels) as f32,
        _ => 1.0,
    };
    let pixels = a.image.pixels.iter().zip(&b.image.pixels);
    let difference = Image {
        pixels: pixels
            .map(|(a, b)| {
                let [r, g, b] = [0, 1, 2].map(|channel| (a[channel] - b[channel]).abs() * scale);
                [r, g, b, 1.0]
            })
            .collect(),
        ..a.image
    };
    Ok(output::save(path, &difference)?)
}

/// Rounds to four decimals.
fn rounded(value: f64) -> f64 {
    (value * 1e4).round() / 1e4
}
