//! Rows of a material in the Properties panel: each one edits what the picture shows.

use super::edit::{perform, scene};
use crate::harness::Window;
use crate::support::verdict::Verdict;
use eframe::egui::Role;
use egui_kittest::kittest::{NodeT, Queryable, by};
use glimray::image::Image;
use glimray::render::Tone;
use glimray_viewer::model::bindings::Action;
use glimray_viewer::model::objects::Id;
use std::collections::BTreeSet;
use tempfile::TempDir;

/// A cube whose faces have texture coordinates.
const CUBE: &str = "\
v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1
vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1
f 5/1 6/2 7/3 8/4\nf 2/1 1/2 4/3 3/4\nf 1/1 5/2 8/3 4/4\nf 6/1 2/2 3/3 7/4\nf 8/1 7/2 3/3 4/4\nf 1/1 2/2 6/3 5/4\n";

/// The cube of the material that is tested, a ball of glass that overlaps it, and a wall with the texture.
const SCENE: &str = r#"
background = [0.3, 0.4, 0.6]
ambient = [0.2, 0.25, 0.3]

[camera]
look_from = [2.2, 1.8, 5]
look_at = [0, 0, 0]
fov_y_deg = 35

[[lights]]
point = { position = [3, 4, 5], color = [0.9, 0.9, 0.9] }

[textures.map]
picture = "map.png"
space = "uv"

[materials.ball]
optics = { reflect = [1, 1, 1], transmit = [0.9, 0.7, 0.8], opacity = 0, ior = 1.3, absorption = [0.5, 0.1, 0.3], fresnel = "exact" }

[materials.wall]
phong = { diffuse = { texture = "map" } }

[[objects]]
mesh = { file = "cube.obj" }
material = "tested"

[[objects]]
sphere = { center = [0.9, 0.3, 0.9], radius = 0.7 }
material = "ball"

[[objects]]
plane = { point = [0, 0, -3], normal = [0, 0, 1] }
material = "wall"
"#;

/// Every parameter of it has an effect.
const METALLIC_ROUGHNESS: &str = r#"
[materials.tested]
pbr = { base_color = [0.8, 0.5, 0.4], metallic = 0.25, roughness = 0.3, ior = 1.5, specular = 0.75, specular_color = [0.75, 0.5, 0.25], transmission = 0.6, thickness = 1, attenuation_color = [0.5, 0.7, 0.75], attenuation_distance = 1, dispersion = 2, clearcoat = 0.5, clearcoat_roughness = 0.25, clearcoat_normal_map = { picture = "map.png" }, sheen_color = [0.5, 0.25, 0.5], sheen_roughness = 0.5, anisotropy = 0.6, anisotropy_rotation_deg = 20, iridescence = 0.7, iridescence_ior = 1.4, iridescence_thickness = [200, 500], iridescence_thickness_map = { texture = "map" }, diffuse_transmission = 0.3, diffuse_transmission_color = [0.75, 0.5, 0.75] }
emission = [0.1, 0.2, 0.3]
coverage = { alpha = 0.9 }
"#;

/// Every coefficient of it has an effect. A mesh without textures would lose its texture coordinates.
const PHONG: &str = r#"
[materials.tested]
phong = { diffuse = { texture = "map" }, specular = [0.25, 0.5, 0.25], shininess = 20, ambient = [0.5, 0.75, 0.5] }
optics = { reflect = [0.25, 0.5, 0.25], transmit = [0.5, 0.25, 0.5], opacity = 0.75, ior = 1.5, absorption = [0.25, 0.5, 0.25], fresnel = "schlick" }
emission = [0.1, 0.2, 0.3]
coverage = { alpha = 0.9 }
"#;

/// Numbers for rows where [`other`] would not show.
const VALUES: &[(&str, f64)] = &[
    ("Anisotropy rotation", 70.0),
    ("Priority", 1.0),
    // Every volume is as thick as the mesh.
    ("Thickness", 0.0),
];

/// Another number for a row with `value`.
fn other(label: &str, value: f64) -> f64 {
    let own = VALUES.iter().find(|(row, _)| *row == label);
    match own {
        Some((_, value)) => *value,
        None if value > 0.5 => 0.5 * value,
        None => value + 0.25,
    }
}

fn open(material: &str, integrator: &str) -> (TempDir, Window) {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    std::fs::write(at("cube.obj"), CUBE).expect("a mesh");
    let texels = [
        [200, 90, 220, 230],
        [90, 160, 240, 120],
        [150, 60, 200, 200],
        [60, 220, 130, 250],
    ];
    let mut map = image::RgbaImage::new(2, 2);
    for (place, texel) in map.pixels_mut().zip(texels) {
        *place = image::Rgba(texel);
    }
    map.save(at("map.png")).expect("a picture");
    std::fs::write(at("scene.toml"), format!("{SCENE}{material}")).expect("a scene");
    let path = at("scene.toml");
    let path = path.to_str().expect("UTF-8");
    let (size, samples) = (["--size", "16x12"], ["--samples", "2"]);
    let arguments = [&[path][..], &size, &samples, &["--integrator", integrator]].concat();
    let mut window = Window::open(&arguments);
    window.settle();
    (folder, window)
}

/// The role and the label of a control.
type Control = (Role, String);

/// Numbers, check boxes and choices in the window. Of the numbers of a colour only the first one.
fn controls(window: &Window) -> BTreeSet<(u8, String)> {
    let is_control = |node: &egui_kittest::kittest::AccessKitNode<'_>| {
        matches!(
            node.role(),
            Role::SpinButton | Role::CheckBox | Role::ComboBox
        )
    };
    let found = window.harness.query_all(by().predicate(is_control));
    let control = |node: egui_kittest::Node<'_>| {
        let node = node.accesskit_node();
        let label = node.label().unwrap_or_default();
        let kind = match node.role() {
            Role::SpinButton => 0,
            Role::CheckBox => 1,
            _ => 2,
        };
        (kind, label)
    };
    let is_first =
        |(_, label): &(u8, String)| !label.ends_with(" green") && !label.ends_with(" blue");
    found.map(control).filter(is_first).collect()
}

/// The rows of the material `tested`, which has this index.
fn rows(window: &mut Window, index: usize) -> Vec<Control> {
    window.session().selection = Some(Id::Camera(0));
    window.settle();
    let others = controls(window);
    window.session().selection = Some(Id::Material(index));
    window.settle();
    let role = |kind| [Role::SpinButton, Role::CheckBox, Role::ComboBox][usize::from(kind)];
    let own = controls(window)
        .difference(&others)
        .cloned()
        .collect::<Vec<_>>();
    own.into_iter()
        .map(|(kind, label)| (role(kind), label))
        .collect()
}

/// Changes the value of a row.
fn change(window: &mut Window, (role, label): &Control) {
    let row = window.harness.get_by_role_and_label(*role, label);
    match role {
        Role::SpinButton => {
            let value = row.accesskit_node().numeric_value().expect("a number");
            row.set_value_accesskit(other(label, value));
        }
        Role::CheckBox => row.click_accesskit(),
        _ => {
            let now = row.accesskit_node().value().unwrap_or_default();
            row.click_accesskit();
            window.harness.run_steps(4);
            let options = [
                "None",
                "Picture (texture 1)",
                "Constant",
                "Fresnel's equations",
                "Sum",
                "Blend",
                "Gold",
            ];
            let wanted = options
                .iter()
                .find(|option| **option != now && window.harness.query_by_label(option).is_some());
            let wanted = wanted.unwrap_or_else(|| panic!("{label}: no other option than {now}"));
            window.harness.get_by_label(wanted).click_accesskit();
        }
    }
    window.settle();
}

/// Every row of the panel changes the scene and the picture, and undo takes both back.
fn every_row_shows(material: &str, integrator: &str, some: &[&str]) {
    let (_folder, mut window) = open(material, integrator);
    let before = scene(&window);
    let index = before.materials.iter().position(|it| it.name == "tested");
    let found = rows(&mut window, index.expect("the material"));
    for wanted in some {
        let is_it = |(_, label): &Control| label == wanted;
        assert!(found.iter().any(is_it), "no row {wanted} in {found:?}");
    }
    let plain: Image = window.image(Tone::LINEAR);
    let mut verdict = Verdict::on("rows of a material");
    for row in &found {
        change(&mut window, row);
        let edited = scene(&window);
        let shows = window.image(Tone::LINEAR) != plain;
        verdict.that(&row.1, edited != before && shows, || {
            format!(
                "scene changed: {}, picture changed: {shows}",
                edited != before
            )
        });
        perform(&mut window, Action::Undo);
        assert!(scene(&window) == before, "{}: undo", row.1);
    }
    verdict.close();
    assert!(window.image(Tone::LINEAR) == plain, "not taken back");
}

#[test]
fn every_row_of_a_metallic_roughness_material_changes_the_picture() {
    let some = ["Base colour red", "Metallic", "Roughness", "Film from"];
    every_row_shows(METALLIC_ROUGHNESS, "path", &some);
}

#[test]
fn every_row_of_a_phong_material_changes_the_picture() {
    let some = ["Diffuse red", "Ambient red", "Shininess", "Mixing"];
    every_row_shows(PHONG, "whitted", &some);
}

#[test]
fn a_metallic_roughness_material_loses_the_colours_that_a_file_gives_to_the_classical_integrators()
{
    let material = format!("{METALLIC_ROUGHNESS}phong = {{ diffuse = [1, 0, 0] }}\n");
    let (_folder, mut window) = open(&material, "whitted");
    let before = scene(&window);
    let index = before.materials.iter().position(|it| it.name == "tested");
    window.session().selection = index.map(Id::Material);
    window.settle();
    let plain = window.image(Tone::LINEAR);
    change(&mut window, &(Role::CheckBox, "Own colours".to_owned()));
    assert!(window.image(Tone::LINEAR) != plain);
    // The row is only there for what a file gives.
    assert!(window.harness.query_by_label("Own colours").is_none());
    perform(&mut window, Action::Undo);
    assert!(scene(&window) == before && window.image(Tone::LINEAR) == plain);
}
