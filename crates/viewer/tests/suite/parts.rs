//! Clips, variants, scenes and cameras of a model, chosen in the window.

use crate::harness::Window;
use eframe::egui::Role;
use egui_kittest::kittest::Queryable;
use glimray_viewer::actions::files::parts;
use glimray_viewer::actions::saving;
use glimray_viewer::state::files::Part;
use std::fs;
use tempfile::TempDir;

/// Two triangles in two scenes, two clips that move the same, two variants, two cameras.
const MODEL: &str = r#"{
  "asset": { "version": "2.0" },
  "extensionsUsed": ["KHR_materials_variants"],
  "extensions": { "KHR_materials_variants": { "variants": [{ "name": "red" }, { "name": "blue" }] } },
  "scene": 0,
  "scenes": [{ "name": "one", "nodes": [0, 2, 3] }, { "name": "two", "nodes": [0, 1, 2, 3] }],
  "nodes": [
    { "name": "left", "mesh": 0 },
    { "name": "right", "mesh": 0, "translation": [2, 0, 0] },
    { "camera": 0, "translation": [0, 0, 5] },
    { "camera": 1, "translation": [0, 0, 9] }
  ],
  "cameras": [
    { "name": "near", "type": "perspective", "perspective": { "yfov": 0.8, "znear": 0.1 } },
    { "name": "far", "type": "perspective", "perspective": { "yfov": 0.8, "znear": 0.1 } }
  ],
  "materials": [
    { "name": "grey" },
    { "name": "red", "pbrMetallicRoughness": { "baseColorFactor": [1, 0, 0, 1] } },
    { "name": "blue", "pbrMetallicRoughness": { "baseColorFactor": [0, 0, 1, 1] } }
  ],
  "meshes": [{ "primitives": [{
    "attributes": { "POSITION": 0 }, "material": 0,
    "extensions": { "KHR_materials_variants": { "mappings": [
      { "material": 1, "variants": [0] }, { "material": 2, "variants": [1] }
    ] } }
  }] }],
  "animations": [
    { "name": "jump", "samplers": [{ "input": 1, "output": 3 }],
      "channels": [{ "sampler": 0, "target": { "node": 0, "path": "translation" } }] },
    { "name": "run", "samplers": [{ "input": 2, "output": 3 }],
      "channels": [{ "sampler": 0, "target": { "node": 0, "path": "translation" } }] }
  ],
  "accessors": [
    { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0] },
    { "bufferView": 1, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [1] },
    { "bufferView": 2, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [2] },
    { "bufferView": 3, "componentType": 5126, "count": 2, "type": "VEC3" }
  ],
  "bufferViews": [
    { "buffer": 0, "byteOffset": 0, "byteLength": 36 },
    { "buffer": 0, "byteOffset": 36, "byteLength": 8 },
    { "buffer": 0, "byteOffset": 44, "byteLength": 8 },
    { "buffer": 0, "byteOffset": 52, "byteLength": 24 }
  ],
  "buffers": [{ "uri": "model.bin", "byteLength": 76 }]
}"#;

/// Positions of the triangle, times of both clips, and where they move it.
#[rustfmt::skip]
const NUMBERS: [f32; 19] = [
    0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0,
    0.0, 1.0, 0.0, 2.0,
    0.0, 0.0, 0.0, 0.0, 1.0, 0.0,
];

fn open() -> (TempDir, Window) {
    let folder = tempfile::tempdir().expect("a folder");
    let bytes: Vec<u8> = NUMBERS
        .iter()
        .flat_map(|number| number.to_le_bytes())
        .collect();
    fs::write(folder.path().join("model.bin"), bytes).expect("a file");
    let path = folder.path().join("model.gltf");
    fs::write(&path, MODEL).expect("a file");
    let path = path.to_str().expect("a name");
    let mut window = Window::open(&[path, "--size", "48x32", "--samples", "1"]);
    window.settle();
    (folder, window)
}

/// Chooses an entry of a drop-down, as a person would.
fn choose(window: &mut Window, list: &str, entry: &str) {
    let list = (window.harness).get_by_role_and_label(Role::ComboBox, list);
    list.click();
    window.harness.run_steps(3);
    window.harness.get_by_label(entry).click();
    window.harness.run_steps(3);
    window.settle();
}

#[test]
fn the_clip_of_a_model_is_chosen_and_is_no_repair() {
    let (_folder, mut window) = open();
    assert_eq!(window.session().playback.duration(), 1.0);
    assert_eq!(window.session().scene().expect("a scene").skipped, [""; 0]);
    choose(&mut window, "Clip", "run");
    assert_eq!(window.session().playback.duration(), 2.0);
    choose(&mut window, "Clip", "All that fit together");
    assert_eq!(window.session().playback.duration(), 1.0);
}

#[test]
fn the_variant_and_the_scene_of_a_model_are_chosen() {
    let (_folder, mut window) = open();
    let seen = |window: &Window| {
        let session = window.session();
        let scene = session.scene().expect("a scene");
        let materials = scene.materials.iter().map(|material| material.name.clone());
        (scene.instances.len(), materials.collect::<Vec<_>>())
    };
    let (own, materials) = seen(&window);
    assert!(materials.contains(&"grey".to_owned()), "{materials:?}");
    choose(&mut window, "Variant", "blue");
    let (_, materials) = seen(&window);
    assert!(materials.contains(&"blue".to_owned()), "{materials:?}");
    assert!(!materials.contains(&"grey".to_owned()), "{materials:?}");
    choose(&mut window, "Scene", "two");
    assert_eq!(seen(&window).0, own + 1);
    assert_eq!(seen(&window).1, materials, "the variant stays");
}

#[test]
fn a_camera_of_a_model_is_chosen_by_its_name() {
    let (_folder, mut window) = open();
    assert_eq!(window.camera().look_from.z, 5.0);
    choose(&mut window, "Camera", "far");
    assert_eq!(window.camera().look_from.z, 9.0);
}

#[test]
fn what_was_chosen_in_one_file_is_not_looked_for_in_the_next() {
    let (folder, mut window) = open();
    choose(&mut window, "Clip", "run");
    let next = folder.path().join("next.obj");
    fs::write(&next, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").expect("a file");
    glimray_viewer::actions::files::open(&mut window.session(), vec![next]);
    window.settle();
    assert_eq!(window.session().title(), "next.obj");
    assert_eq!(window.session().files.broken, None);
}

#[test]
fn a_choice_with_which_the_file_cannot_be_read_is_taken_back() {
    let (folder, mut window) = open();
    let path = folder.path().join("model.gltf");
    fs::write(&path, "{").expect("a file");
    parts::choose(&mut window.session(), Part::Clip, Some(1));
    window.settle();
    assert!(window.session().files.broken.is_some());
    let clips = parts::choices(&window.session(), Part::Clip);
    assert_eq!(clips.expect("several clips").chosen, None);
    assert_eq!(window.session().playback.duration(), 1.0);
}

#[test]
fn a_model_that_was_saved_as_a_scene_has_nothing_to_choose() {
    let (folder, mut window) = open();
    let path = folder.path().join("saved.toml");
    let has_choices = |window: &Window, part| parts::choices(&window.session(), part).is_some();
    let all = [Part::Clip, Part::Variant, Part::Scene];
    assert!(all.iter().all(|part| has_choices(&window, *part)));
    saving::write(&mut window.session(), &path).expect("a file");
    window.settle();
    assert!(!all.iter().any(|part| has_choices(&window, *part)));
}
