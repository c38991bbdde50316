//! `--compare OLD.json`: the ratios of this run's figures to those of an earlier one.

use glimray_app::error::AppError;
use glimray_io::output;
use serde::Serialize;
use serde_json::Value;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;

/// Exact counters that grow by more than this factor are marked.
const GROWTH: f64 = 1.05;

/// An earlier run.
pub struct Baseline {
    conditions: Vec<Condition>,
    figures: BTreeMap<String, f64>,
}

/// A named condition of a run.
struct Condition {
    what: &'static str,
    value: Value,
}

/// Two runs side by side.
pub struct Comparison {
    pub ratios: Vec<Ratio>,
    pub sides: Sides,
}

/// A figure of both runs.
#[derive(Debug, Serialize)]
pub struct Ratio {
    /// The names of its scene or workload, its ray set and itself.
    figure: String,
    old: f64,
    new: f64,
    /// New over old; null if the old one is 0.
    ratio: Option<f64>,
    /// Whether it is an exact counter that grew by more than 5 %.
    grew: bool,
}

/// Entries that only one of two runs has.
#[derive(Debug, Serialize)]
pub struct Sides {
    /// Conditions that are not the same, so that the figures may differ for that reason.
    differences: Vec<Difference>,
    /// Figures that this run should have too, as it was to measure their scene or workload.
    only_old: Vec<String>,
    only_new: Vec<String>,
}

#[derive(Debug, Serialize)]
struct Difference {
    what: &'static str,
    old: Value,
    new: Value,
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
            conditions: conditions(&run),
            figures: figures(&run),
        })
    }

    /// Compares a run that measures what `is_selected` by its name. A figure that is 0 in both runs has no ratio.
    pub fn compare(&self, run: &Value, is_selected: impl Fn(&str) -> bool) -> Comparison {
        let new = figures(run);
        let is_selected = |figure: &str| is_selected(figure.split('/').next().unwrap_or_default());
        let missing = |from: &BTreeMap<String, f64>, others: &BTreeMap<String, f64>| {
            let missing = from.keys().filter(|figure| !others.contains_key(*figure));
            missing.cloned().collect::<Vec<_>>()
        };
        let mut only_old = missing(&self.figures, &new);
        only_old.retain(|figure| is_selected(figure));
        let differences = self.conditions.iter().zip(conditions(run));
        let differences = differences.filter(|(old, new)| old.value != new.value);
        let sides = Sides {
            differences: differences
                .map(|(old, new)| Difference {
                    what: old.what,
                    old: old.value.clone(),
                    new: new.value,
                })
                .collect(),
            only_old,
            only_new: missing(&new, &self.figures),
        };
        let ratio = |(figure, new): (String, f64)| {
            let old = *self.figures.get(&figure)?;
            let is_growth = is_counter(&figure) && new > GROWTH * old;
            (old != 0.0 || new != 0.0).then(|| Ratio {
                grew: is_growth,
                figure,
                old,
                new,
                ratio: (old != 0.0).then(|| new / old),
            })
        };
        Comparison {
            ratios: new.into_iter().filter_map(ratio).collect(),
            sides,
        }
    }
}

/// The conditions of a run; null where they are missing.
fn conditions(run: &Value) -> Vec<Condition> {
    let adapter = &run["adapter"];
    let all = [
        ("version", &run["glimray"]),
        ("adapter", &adapter["name"]),
        ("backend", &adapter["backend"]),
        ("driver", &adapter["driver"]),
        ("repeats", &run["repeats"]),
    ];
    let condition = |(what, value): (_, &Value)| Condition {
        what,
        value: value.clone(),
    };
    all.map(condition).into()
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
    let kinds = ["_per_ray", "_per_packet", "_per_primitive"];
    kinds.iter().any(|kind| key.ends_with(kind))
}

impl Comparison {
    /// A table for people.
    pub fn text(&self, path: &Path) -> String {
        let mut text = format!(
            "\nCompared with {} (`!`: a counter that grew by more than 5 %)\n{}{:<56} {:>10} {:>10} {:>7}\n",
            path.display(),
            self.sides.text(),
            "figure",
            "old",
            "new",
            "ratio"
        );
        for ratio in &self.ratios {
            let mark = if ratio.grew { " !" } else { "" };
            let quotient = match ratio.ratio {
                Some(quotient) => format!("{quotient:.3}"),
                None => "-".into(),
            };
            // Writing to a string cannot fail.
            let _ = writeln!(
                text,
                "{:<56} {:>10.4} {:>10.4} {quotient:>7}{mark}",
                ratio.figure, ratio.old, ratio.new
            );
        }
        text
    }
}

impl Sides {
    /// A line for each kind of difference that there is.
    fn text(&self) -> String {
        let plain = |value: &Value| match value {
            Value::String(text) => text.clone(),
            Value::Null => "unknown".into(),
            other => other.to_string(),
        };
        let difference = |Difference { what, old, new }: &Difference| {
            format!("{what} {}, now {}", plain(old), plain(new))
        };
        let differences: Vec<_> = self.differences.iter().map(difference).collect();
        let mut text = String::new();
        if !differences.is_empty() {
            text += &format!("The runs differ: {}.\n", differences.join("; "));
        }
        for (side, figures) in [("old", &self.only_old), ("new", &self.only_new)] {
            if !figures.is_empty() {
                text += &format!("Only in the {side} run: {}\n", figures.join(", "));
            }
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::{Baseline, conditions, figures};
    use serde_json::json;
    use std::path::Path;

    /// The demo has no triangles, whose rate is 0 in every run.
    #[test]
    fn figures_without_a_ratio_are_no_numbers() {
        let run = |hairs: f64, nodes: f64| {
            json!({"workloads": [{"name": "demo", "bvh_mtriangles_per_second": 0.0}], "scenes": [{"name": "hair", "rays": [
                {"set": "random", "primitives_per_ray": hairs, "nodes_per_packet": nodes}
            ]}]})
        };
        let old = run(0.0, 2.0);
        let baseline = Baseline {
            conditions: conditions(&old),
            figures: figures(&old),
        };
        let comparison = baseline.compare(&run(0.5, 3.0), |_| true);
        let ratios = comparison.ratios.iter();
        let ratios: Vec<_> = ratios
            .map(|ratio| (ratio.figure.as_str(), ratio.ratio, ratio.grew))
            .collect();
        let expected = [
            ("hair/random/nodes_per_packet", Some(1.5), true),
            ("hair/random/primitives_per_ray", None, true),
        ];
        assert_eq!(ratios, expected);
        let text = comparison.text(Path::new("old.json"));
        assert!(!text.contains("NaN") && !text.contains("inf"), "{text}");
        assert!(
            !text.contains("Only in") && !text.contains("differ"),
            "{text}"
        );
    }
}
