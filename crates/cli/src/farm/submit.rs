//! `glimray farm submit DIR`: writes the scripts of a batch engine and submits them. The merge runs after the parts, however
//! they ended, and first renders what killed tasks left.

use super::manifest::Manifest;
use super::slurm::{self, Scripts};
use super::{Folder, failed_io};
use crate::args::{Engine, FarmSubmitArgs};
use glimray_app::console;
use glimray_app::error::AppError;
use glimray_io::output;
use std::fs;
use std::path::Path;
use std::process::Command;

pub fn run(arguments: &FarmSubmitArgs) -> Result<(), AppError> {
    let Engine::Slurm = arguments.engine;
    let absolute = std::path::absolute(&arguments.dir);
    let folder = Folder(absolute.map_err(|error| failed_io(&arguments.dir, error))?);
    let manifest = Manifest::read(folder.path())?;
    let Scripts { parts, merge } = slurm::scripts(arguments, &manifest, &folder)?;
    if arguments.dry_run {
        return console::print(&format!("{parts}\n{merge}"));
    }
    for name in ["logs", "slurm"] {
        let path = folder.path().join(name);
        fs::create_dir_all(&path).map_err(|error| failed_io(&path, error))?;
    }
    let write = |name: &str, text: &str| {
        let path = folder.path().join("slurm").join(name);
        output::write(&path, text.as_bytes(), true)?;
        Ok::<_, AppError>(path)
    };
    let (parts, merge) = (write("parts.sh", &parts)?, write("merge.sh", &merge)?);
    let array = sbatch(&[], &parts)?;
    let after = format!("--dependency=afterany:{array}");
    let merging = sbatch(&[&after], &merge)?;
    console::print(&format!(
        "submitted job {array} for the parts and job {merging} for the merge after them\n\
         next: {} --follow\n",
        super::command("status", &folder)
    ))
}

/// Submits a script and returns the number of its job.
fn sbatch(flags: &[&str], script: &Path) -> Result<String, AppError> {
    let refused = |why: String| {
        AppError::Refused(format!(
            "cannot submit the job ({}): {why}. Submit the script by hand, or use `glimray farm run`.",
            script.display()
        ))
    };
    let output = Command::new("sbatch")
        .arg("--parsable")
        .args(flags)
        .arg(script)
        .output()
        .map_err(|error| refused(format!("sbatch cannot be started, {error}")))?;
    let said = String::from_utf8_lossy(&output.stdout);
    match (output.status.success(), said.trim().split(';').next()) {
        (true, Some(job)) if !job.is_empty() => Ok(job.into()),
        _ => {
            let why = String::from_utf8_lossy(&output.stderr);
            let why = why.split_whitespace().collect::<Vec<_>>().join(" ");
            Err(refused(format!("sbatch refused it, {why}")))
        }
    }
}
