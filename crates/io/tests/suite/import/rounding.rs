//! Scenes whose light f32 would change are warned of, and others are not.

use super::gltf::model::Model;
use super::{folder, scene};
use crate::support::verdict::Verdict;
use glimray::import;
use serde_json::json;

/// A scene of this size with a mesh: a triangle and a lamp of this width in its plane, scaled by `thin` across it.
fn sized(size: f64, thin: f64) -> String {
    let at = |x: f64| x * size;
    format!(
        "[camera]\nlook_from = [0, {}, {}]\nlook_at = [0, 0, 0]\n\
         [materials.lamp]\nphong = {{ diffuse = [0, 0, 0] }}\nemission = [9, 9, 9]\n\
         [[objects]]\ntriangle = {{ vertices = [[0, 0, 0], [{1}, 0, 0], [0, 0, {1}]] }}\n\
         [[objects]]\ntriangle = {{ vertices = [[0, 0, 0], [{0}, 0, 0], [0, 0, {2}]] }}\n\
         material = \"lamp\"\ntransform = {{ translate = [0, {0}, 0] }}\n",
        at(1.0),
        at(4.0),
        at(thin),
    )
}

#[test]
fn scenes_beyond_the_squares_of_f32_are_warned_of() {
    let mut verdict = Verdict::on("sizes of scenes");
    for (size, expected) in [
        (1.0, None),
        (1e-7, None),
        (1e8, None),
        (1e-11, Some("below 1e-9")),
        (1e-16, Some("below 1e-9")),
        (1e10, Some("above 1e9")),
    ] {
        let notes = scene("a.toml", sized(size, 1.0)).skipped;
        let is_said = |says: &str| {
            let is_it =
                |note: &String| note.starts_with("the scene measures") && note.contains(says);
            notes.iter().filter(|note| is_it(note)).count() == 1
        };
        let holds = expected.map_or(notes.is_empty(), is_said);
        verdict.that(format!("{size:e}"), holds, || format!("{notes:?}"));
    }
    verdict.close();
}

#[test]
fn emissive_slivers_that_lose_their_light_are_warned_of() {
    assert_eq!(scene("a.toml", sized(1.0, 1e-5)).skipped, [""; 0]);
    let lost = "emissive triangles too thin for f32, whose light is lost: 1";
    let notes = scene("a.toml", sized(1.0, 1e-9)).skipped;
    assert!(notes.iter().any(|note| note == lost), "{notes:?}");
    // Without an area nothing is lost.
    let notes = scene("a.toml", sized(1.0, 0.0)).skipped;
    assert_eq!(notes, ["dropped 1 triangle without area"]);
    // A transform leaves no room between the numbers of f32 at this place.
    let placed = sized(1.0, 1.0)
        + "[[objects]]\nmesh = { file = \"a.obj\" }\nmaterial = \"lamp\"\n\
           transform = { translate = [0.1, 1, 100.37] }\n";
    let sliver = "v 0 0 0\nv 4 0 0\nv 0 0 1e-5\nf 1 2 3\n";
    let folder = folder(&[("a.toml", placed.as_bytes()), ("a.obj", sliver.as_bytes())]);
    let notes = import::load(&folder.path().join("a.toml")).expect("a scene");
    let notes = notes.skipped;
    assert!(
        notes.len() == 1 && notes[0].contains("so thin for their distance"),
        "{notes:?}"
    );
}

/// A triangle in the plane z = 0 keeps its area under a scale of 0 along z, and loses it under one along x or y.
#[test]
fn emissive_meshes_that_a_transform_squashes_are_warned_of() {
    let mut verdict = Verdict::on("scales of a glowing triangle");
    for (scale, is_squashed) in [
        ([1.0, 1.0, 1.0], false),
        ([1e-6, 1e-6, 1e-6], false),
        ([1.0, 1.0, 0.0], false),
        ([1.0, 0.01, 1.0], false),
        ([-1.0, 2.0, 1.0], false),
        ([0.0, 1.0, 1.0], true),
        ([1.0, 0.0, 1.0], true),
    ] {
        for emission in [0.0, 1.0] {
            let scene = Model::triangle(json!({ "material": 0 }))
                .with(json!({
                    "materials": [{ "emissiveFactor": [emission, 0, 0] }],
                    "nodes": [{ "mesh": 0, "scale": scale }],
                }))
                .scene();
            let is_said = scene.skipped.iter().any(|note| note.contains("squashed"));
            let name = format!("{scale:?}, emission {emission}");
            verdict.that(name, is_said == (is_squashed && emission > 0.0), || {
                format!("{:?}", scene.skipped)
            });
        }
    }
    verdict.close();
}
