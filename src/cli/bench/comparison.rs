//! `--compare OLD.json`: the ratios of this run's figures to those of an earlier one.

use crate::app::error::AppError;
use crate::output;
use serde::Serialize;
use serde_json::Value;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;

/// Exact counters that grow by more than this factor are marked.
const GROWTH: f64 = 1.05;

/// An earlier run.
pub struct Baseline {
    figures: BTreeMap<String, f64>,
}

/// A figure of both runs.
#[derive(Debug, Serialize)]
pub struct Ratio {
    /// The names of its scene or workload, its ray set and itself.
    figure: String,
    old: f64,
    new: f64,
    /// New over old.
    ratio: f64,
    /// Whether it is an exact counter that grew by more than 5 %.
    grew: bool,
}

impl Baseline {
    /// Reads the output of `glimray bench --json`.
    ///
    /// # Errors
    /// [`AppError::Refused`]: the file cannot be read, is not such output, or differs in `--quick`.
    pub fn read(path: &Path, is_quick: bool) -> Result<Self, AppError> {
        let refused = |why: &str| {
            AppError::Refused(format!(
                "cannot compare with an earlier run ({}): {why}. Give a file with the output of `glimray bench \
                 --json`.",
                path.display()
            ))
        };
        let foreign = "it has no figures of a benchmark";
        let text = std::fs::read(path).map_err(|error| refused(&output::reason(&error)))?;
        let run: Value = serde_json::from_slice(&text).map_err(|_| refused(foreign))?;
        if !(run["glimray"].is_string() && run["workloads"].is_array()) {
            return Err(refused(foreign));
        }
        if run["quick"].as_bool().unwrap_or(false) != is_quick {
            return Err(refused("only one of the two runs is with --quick"));
        }
        Ok(Self {
            figures: figures(&run),
        })
    }

    /// The ratios of all figures that both runs have.
    pub fn ratios(&self, run: &Value) -> Vec<Ratio> {
        let ratio = |(figure, new): (String, f64)| {
            let old = *self.figures.get(&figure)?;
            let ratio = new / old;
            Some(Ratio {
                grew: is_counter(&figure) && ratio > GROWTH,
                figure,
                old,
                new,
                ratio,
            })
        };
        figures(run).into_iter().filter_map(ratio).collect()
    }
}

/// The figures of a run that can be compared, by name. A figure with a spread is its median.
fn figures(run: &Value) -> BTreeMap<String, f64> {
    let mut found = BTreeMap::new();
    collect("", run, &mut found);
    found
}

fn collect(name: &str, value: &Value, found: &mut BTreeMap<String, f64>) {
    match value {
        Value::Object(members) => {
            for (key, member) in members {
                match member["median"].as_f64() {
                    _ if key.ends_with("_spread") => {}
                    Some(median) if is_figure(key) => _ = found.insert(joined(name, key), median),
                    _ => collect(&joined(name, key), member, found),
                }
            }
        }
        Value::Array(items) => {
            // `scenes/hall/rays/primary` is easier to read without the names of the lists.
            let list = name.rsplit_once('/').map_or("", |(before, _)| before);
            for item in items {
                if let Some(own) = item["name"].as_str().or(item["set"].as_str()) {
                    collect(&joined(list, own), item, found);
                }
            }
        }
        Value::Number(number) => {
            let key = name.rsplit('/').next().unwrap_or_default();
            if let Some(number) = number.as_f64().filter(|_| is_figure(key)) {
                found.insert(name.to_owned(), number);
            }
        }
        _ => {}
    }
}

fn joined(name: &str, key: &str) -> String {
    match name {
        "" => key.to_owned(),
        _ => format!("{name}/{key}"),
    }
}

fn is_figure(key: &str) -> bool {
    key.ends_with("_per_second") || key.ends_with("_seconds") || is_counter(key)
}

/// Whether a figure is the same in every run of one version.
fn is_counter(key: &str) -> bool {
    key.ends_with("_per_ray") || key.ends_with("_per_primitive")
}

/// A table for people.
pub fn text(path: &Path, ratios: &[Ratio]) -> String {
    let mut text = format!(
        "\nCompared with {} (`!`: a counter that grew by more than 5 %)\n{:<56} {:>10} {:>10} {:>7}\n",
        path.display(),
        "figure",
        "old",
        "new",
        "ratio"
    );
    for ratio in ratios {
        let mark = if ratio.grew { " !" } else { "" };
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "{:<56} {:>10.4} {:>10.4} {:>7.3}{mark}",
            ratio.figure, ratio.old, ratio.new, ratio.ratio
        );
    }
    text
}
