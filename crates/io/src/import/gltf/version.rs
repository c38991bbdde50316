//! The version of glTF that a file is written in (section 3.2 of the specification).

use super::blame::Blame;
use super::document::Document;
use crate::import::error::ImportError;
use crate::import::notes::Notes;
use crate::import::source::quote;

const WHAT: &str = "versions";

/// Major and minor number of a version, written like `2.0`.
fn numbers(text: &str) -> Option<(u32, u32)> {
    let (major, minor) = text.split_once('.')?;
    let is_plain = |part: &str| part.bytes().all(|byte| byte.is_ascii_digit());
    match is_plain(major) && is_plain(minor) {
        true => Some((major.parse().ok()?, minor.parse().ok()?)),
        false => None,
    }
}

/// Checks that `document` can be read. The oldest version that can show a model, `minVersion`, counts before the one it
/// was written for, of which every minor one can be read.
///
/// # Errors
/// The model needs another version than 2.0, or says nothing about it and has no meshes.
pub(super) fn check(
    document: &Document,
    notes: &mut Notes,
    blame: Blame,
) -> Result<(), ImportError> {
    let Some(asset) = &document.asset else {
        if document.meshes.is_empty() {
            return Err(blame.file("it has no `asset`", "Check that it is a glTF 2.0 file"));
        }
        notes.add(WHAT, || {
            "it has no `asset`, and is read as glTF 2.0".to_owned()
        });
        return Ok(());
    };
    let refuse = |text: &str| {
        let version = quote(text.as_bytes());
        let why = format!("it is glTF {version}, but only version 2.0 is read");
        Err(blame.file(&why, "Convert it to glTF 2.0"))
    };
    let version = numbers(&asset.version);
    let Some(text) = &asset.min_version else {
        return match version {
            Some((2, _)) => Ok(()),
            // Some programs leave out the minor number.
            None if asset.version == "2" => {
                notes.add(WHAT, || {
                    "asset.version is `2`, and was read as 2.0".to_owned()
                });
                Ok(())
            }
            _ => refuse(&asset.version),
        };
    };
    let least = match numbers(text) {
        Some(least @ (2, 0)) => least,
        _ => return refuse(text),
    };
    match version {
        Some(version) if version >= least => {}
        Some(_) => notes.add(WHAT, || {
            let version = quote(asset.version.as_bytes());
            format!("asset.version is {version}, which is below minVersion: it is read as glTF 2.0")
        }),
        None => notes.add(WHAT, || {
            let version = quote(asset.version.as_bytes());
            format!("asset.version is {version}, which is no version: it is read as glTF 2.0")
        }),
    }
    Ok(())
}
