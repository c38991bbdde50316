//! The flags of a plan that its parts are rendered with, as text.

use crate::args::Cli;
use clap::{ArgAction, ArgMatches, CommandFactory, parser::ValueSource};

/// Flags of `farm plan` that are not for rendering, or that the farm sets for each part.
const OWN: [&str; 16] = [
    "output",
    "dir",
    "parts",
    "minutes",
    "simulate",
    "quality",
    "frames",
    "step",
    "loop",
    "allow-dir",
    "report",
    "progress",
    "quiet",
    "verbose",
    "count-rays",
    "help",
];

/// Flags that matter when films become a picture.
const FINISHING: [&str; 11] = [
    "crop",
    "exposure",
    "tone",
    "transfer",
    "denoise",
    "no-denoise",
    "layers",
    "layers-parts",
    "adapter",
    "backend",
    "memory-limit",
];

/// The flags that were given to `farm plan`, for `render` and `animate`: `--name` or `--name=value`. `matches` are those
/// of `farm`.
pub fn given(matches: &ArgMatches) -> Vec<String> {
    let Some(matches) = matches.subcommand_matches("plan") else {
        return Vec::new();
    };
    let mut command = Cli::command();
    let plan = (command.find_subcommand_mut("farm"))
        .and_then(|farm| farm.find_subcommand_mut("plan").cloned());
    let mut flags = Vec::new();
    for argument in plan.iter().flat_map(|plan| plan.get_arguments()) {
        let id = argument.get_id().as_str();
        let Some(name) = argument.get_long().filter(|name| !OWN.contains(name)) else {
            continue;
        };
        if matches.value_source(id) != Some(ValueSource::CommandLine) {
            continue;
        }
        if matches!(argument.get_action(), ArgAction::SetTrue) {
            flags.push(format!("--{name}"));
            continue;
        }
        for values in matches.get_raw_occurrences(id).into_iter().flatten() {
            let values: Vec<_> = values.map(|value| value.to_string_lossy()).collect();
            flags.push(format!("--{name}={}", values.join(",")));
        }
    }
    flags
}

/// Flags that matter when films become a picture.
pub fn finishing(flags: &[String]) -> impl Iterator<Item = &String> {
    flags.iter().filter(|flag| FINISHING.contains(&name(flag)))
}

/// Flags of `animate`, to which the moment of a single picture means nothing.
pub fn of_animation(flags: &[String]) -> impl Iterator<Item = &String> {
    let is_moment = |flag: &str| ["frame", "time"].contains(&name(flag));
    flags.iter().filter(move |flag| !is_moment(flag))
}

/// Flags of `render` for a part with these pixels.
pub fn of_part(flags: &[String], crop: Option<[u32; 4]>) -> impl Iterator<Item = &String> {
    let is_replaced = move |flag: &str| crop.is_some() && name(flag) == "crop";
    flags.iter().filter(move |flag| !is_replaced(flag))
}

fn name(flag: &str) -> &str {
    let flag = flag.strip_prefix("--").unwrap_or(flag);
    flag.split_once('=').map_or(flag, |(name, _)| name)
}
