//! Round trips of scenes through the native format: nothing that is rendered is lost.

mod physical;
mod random;
mod text;

use crate::support::random::Random;
use crate::support::skip::{Need, skip};
use crate::support::verdict::Verdict;
use glimray::export::{self, Export};
use glimray::import;
use glimray::pack;
use glimray::scene::{Scene, Track};
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// Writes `export` as `NAME.toml` with its files to a temporary folder.
fn write(export: &Export, name: &str) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a folder");
    for file in &export.files {
        fs::write(folder.path().join(&file.name), &file.bytes).expect("a file");
    }
    let path = folder.path().join(name).with_extension("toml");
    fs::write(&path, &export.text).expect("the scene");
    (folder, path)
}

/// Exports `scene` and reads it again.
fn round(scene: &Scene) -> Result<(Scene, Export), String> {
    let export =
        export::native(scene, "scene", &|_, _| false).map_err(|error| error.to_string())?;
    let (_folder, path) = write(&export, "scene");
    let read = import::load(&path).map_err(|error| format!("{error}\n{}", export.text))?;
    Ok((read, export))
}

/// `scene` without what the format does not store: generated names, notes, and the grouping of targets into
/// tracks.
fn essence(scene: &Scene) -> Scene {
    let mut scene = scene.clone();
    scene.skipped.clear();
    scene.remarks.clear();
    scene.pin_render_origin();
    scene
        .meshes
        .iter_mut()
        .for_each(|mesh| std::sync::Arc::make_mut(mesh).name.clear());
    scene
        .materials
        .iter_mut()
        .for_each(|material| material.name.clear());
    scene.nodes.iter_mut().for_each(|node| node.name.clear());
    scene.shapes.iter_mut().for_each(|shape| shape.name.clear());
    (scene.instances.iter_mut()).for_each(|instance| instance.name.clear());
    scene.lights.iter_mut().for_each(|light| light.name.clear());
    scene
        .cameras
        .iter_mut()
        .for_each(|camera| camera.name.clear());
    let tracks = std::mem::take(&mut scene.tracks);
    for track in tracks {
        for target in track.targets {
            scene.tracks.push(Track {
                targets: vec![target],
                curve: track.curve.clone(),
            });
        }
    }
    scene
}

/// All bytes that are uploaded for a scene and for some of its frames.
fn bytes(scene: &Scene) -> Vec<Vec<u8>> {
    let packed = pack::scene(scene).expect("packed");
    let mut parts: Vec<Vec<u8>> = packed.parts().into_iter().map(<[u8]>::to_vec).collect();
    parts.push(format!("{:?} {:?}", packed.features, packed.pictures).into_bytes());
    let duration = scene.duration();
    for fraction in [0.0, 0.3, 0.77] {
        let view = packed
            .frame(&scene.frame(fraction * duration))
            .expect("a frame");
        parts.extend(view.parts().into_iter().map(<[u8]>::to_vec));
        parts.push(view.background.to_string().into_bytes());
    }
    parts
}

/// Fails if a round trip loses any part of `scene`.
pub fn loss(scene: &Scene) -> Result<(), String> {
    let (read, export) = round(scene)?;
    let (was, is) = (essence(scene), essence(&read));
    // Text also shows the sign of a zero.
    let (was, is) = (format!("{was:#?}"), format!("{is:#?}"));
    if was != is {
        let mut differing = was.lines().zip(is.lines()).filter(|(a, b)| a != b);
        let first = differing.next();
        let text = export.text.lines().take(120).collect::<Vec<_>>().join("\n");
        return Err(format!("it was, and became, {first:?} in\n{text}"));
    }
    let (was, is) = (bytes(scene), bytes(&read));
    if let Some(part) = (0..was.len().max(is.len())).find(|&i| was.get(i) != is.get(i)) {
        let at = was[part].iter().zip(&is[part]).position(|(a, b)| a != b);
        return Err(format!(
            "part {part} of what is packed differs from byte {at:?} on"
        ));
    }
    let again = round(&read)?.1;
    match again == export {
        true => Ok(()),
        false => {
            let mut differing =
                (export.text.lines().zip(again.text.lines())).filter(|(a, b)| a != b);
            Err(format!("the second export differs: {:?}", differing.next()))
        }
    }
}

/// The scene files below a folder.
fn scenes_in(folder: &Path) -> Vec<PathBuf> {
    let mut found: Vec<PathBuf> = Vec::new();
    let mut open = vec![folder.to_owned()];
    while let Some(folder) = open.pop() {
        let Ok(entries) = fs::read_dir(&folder) else {
            continue;
        };
        for path in entries.flatten().map(|entry| entry.path()) {
            let ending = path.extension().and_then(|ending| ending.to_str());
            match ending {
                _ if path.is_dir() => open.push(path),
                Some("toml" | "scene" | "nff" | "obj") => found.push(path),
                _ => {}
            }
        }
    }
    found.sort();
    found
}

#[test]
fn every_scene_of_the_project_is_packed_to_the_same_bytes_after_a_round_trip() {
    let folder = Path::new("assets/scenes");
    let scenes = scenes_in(folder);
    assert!(scenes.len() > 15, "the scenes are in {}", folder.display());
    let mut verdict = Verdict::on("round trips");
    for path in scenes {
        let lost = loss(&import::load(&path).expect("a scene"));
        verdict.that(path.display(), lost.is_ok(), || lost.clone().unwrap_err());
    }
    verdict.close();
}

/// Third-party models beside the checkout, in all formats. They are optional.
#[test]
fn third_party_models_are_packed_to_the_same_bytes_after_a_round_trip() {
    let folder = Path::new("../shared/data");
    let mut scenes = scenes_in(folder);
    // These are broken on purpose.
    scenes.retain(|path| !path.starts_with(folder.join("faults")));
    if scenes.is_empty() {
        return skip(Need::Models, "there are no models in ../shared/data");
    }
    let mut verdict = Verdict::on("round trips");
    for path in scenes {
        let lost = loss(&import::load(&path).expect("a scene"));
        verdict.that(path.display(), lost.is_ok(), || lost.clone().unwrap_err());
    }
    verdict.close();
}

#[test]
fn random_scenes_are_packed_to_the_same_bytes_after_a_round_trip() {
    let mut verdict = Verdict::on("round trips");
    for seed in 0..60 {
        let lost = loss(&random::scene(&mut Random::new(seed)));
        verdict.that(format!("seed {seed}"), lost.is_ok(), || {
            lost.clone().unwrap_err()
        });
    }
    verdict.close();
}
