//! The job scripts for Slurm: an array of which each task renders parts, and a job that merges them after it.

use super::Folder;
use super::manifest::Manifest;
use crate::args::FarmSubmitArgs;
use glimray_app::error::AppError;
use std::path::Path;

/// Seconds before the time limit at which Slurm sends SIGTERM: enough to write a checkpoint.
const WARNING_SECONDS: u32 = 60;

/// The scripts.
pub struct Scripts {
    pub parts: String,
    pub merge: String,
}

/// Writes the scripts for the farm in `folder`, an absolute path.
///
/// # Errors
/// An option is malformed, or the path of this program is unknown.
pub fn scripts(
    arguments: &FarmSubmitArgs,
    manifest: &Manifest,
    folder: &Folder,
) -> Result<Scripts, AppError> {
    let program = std::env::current_exe()
        .map_err(|error| AppError::Internal(format!("path of the program: {error}")))?;
    let (program, dir) = (quoted(&program)?, quoted(folder.path())?);
    let tasks = arguments.tasks.min(manifest.parts.len() as u32);
    let mut common = Vec::new();
    let named = [
        ("partition", &arguments.partition),
        ("time", &arguments.time),
        ("gres", &arguments.gres),
    ];
    let is_plain = |text: &str| !text.is_empty() && !text.contains(['\n', '\r']);
    for (name, value) in named {
        match value.as_ref() {
            Some(value) if is_plain(value) => common.push(format!("{name}={value}")),
            None => {}
            Some(value) => {
                return Err(AppError::Usage(format!(
                    "cannot pass on the option (--{name} {value:?}): it is empty or has several lines. Write it in one line."
                )));
            }
        }
    }
    for option in &arguments.options {
        match option.trim_start_matches('-').split_once('=') {
            Some((key, value)) if is_plain(key) && is_plain(value) => {
                common.push(format!("{key}={value}"));
            }
            _ => {
                return Err(AppError::Usage(format!(
                    "cannot pass on the option (--option {option}): it is not KEY=VALUE. Write it as account=film."
                )));
            }
        }
    }
    let header = |own: &[String]| {
        let lines = own.iter().chain(&common);
        lines
            .map(|line| format!("#SBATCH --{line}\n"))
            .collect::<String>()
    };
    let logs = folder.path().join("logs");
    let log = |name: &str| format!("output={}", in_directive(&logs, name));
    let parts = format!(
        "#!/bin/sh\n{}\n\
         # A task that is killed leaves its checkpoint, and the next attempt goes on from it. `srun` passes on the \
         signals.\n\
         attempt=0\n\
         until srun --ntasks=1 {program} farm run {dir} --attempts=1 --slice=\"$SLURM_ARRAY_TASK_ID/{tasks}\"; do\n\
         \x20   attempt=$((attempt + 1))\n\
         \x20   [ \"$attempt\" -lt {} ] || exit 1\n\
         done\n",
        header(&[
            "job-name=glimray-parts".into(),
            format!("array=0-{}", tasks - 1),
            "ntasks=1".into(),
            "requeue".into(),
            "open-mode=append".into(),
            format!("signal=TERM@{WARNING_SECONDS}"),
            log("part-%a.log"),
        ]),
        arguments.attempts,
    );
    let merge = format!(
        "#!/bin/sh\n{}\nset -e\n# What killed tasks left is rendered here.\nsrun --ntasks=1 {program} farm run {dir} --all\nexec {program} farm merge {dir}\n",
        header(&[
            "job-name=glimray-merge".into(),
            "ntasks=1".into(),
            "requeue".into(),
            "open-mode=append".into(),
            format!("signal=TERM@{WARNING_SECONDS}"),
            log("merge.log"),
        ]),
    );
    Ok(Scripts { parts, merge })
}

/// A pattern of files in a folder as `#SBATCH` lines take it: in quotes, with two signs for each percent sign of the folder,
/// which would begin a pattern. Its path is text without line breaks.
fn in_directive(folder: &Path, pattern: &str) -> String {
    let mut text = String::from("\"");
    for letter in folder.to_string_lossy().chars() {
        match letter {
            '%' => text.push('%'),
            '\\' | '"' => text.push('\\'),
            _ => {}
        }
        text.push(letter);
    }
    format!("{text}/{pattern}\"")
}

fn quoted(path: &Path) -> Result<String, AppError> {
    let text = path.to_str().filter(|text| !text.contains(['\n', '\r']));
    match text.map(shlex::try_quote) {
        Some(Ok(text)) => Ok(text.into()),
        _ => Err(AppError::Usage(format!(
            "cannot write a script ({}): the path is not plain text. Move the folder.",
            path.display()
        ))),
    }
}
