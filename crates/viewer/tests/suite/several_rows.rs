//! Rows of the properties while several things are selected: an edit changes all that have the row.

use crate::edit::{perform, scene};
use crate::harness::Window;
use crate::support::effort::within;
use eframe::egui::Role;
use egui_kittest::kittest::{NodeT, Queryable};
use glam::{DVec3, Vec3};
use glimray::scene::{Bsdf, Geometry, ObjectRef, Phong, Scene, Transform};
use glimray_viewer::model::bindings::Action;
use glimray_viewer::model::objects::{self, Id};
use tempfile::TempDir;

/// Three balls, of which two share a material, and two lights.
const SCENE: &str = r#"
[camera]
look_from = [0, 0, 9]
look_at = [0, 0, 0]

[materials.red]
phong = { diffuse = [0.75, 0.25, 0.25], ambient = [0.5, 0.5, 0.5], shininess = 10 }

[materials.blue]
phong = { diffuse = [0.25, 0.25, 0.75], ambient = [0.5, 0.5, 0.5], shininess = 10 }

[materials.metal]
pbr = { base_color = [0.5, 0.5, 0.5], roughness = 0.25 }

[[objects]]
sphere = { center = [-2, 1, 0], radius = 1 }
material = "red"

[[objects]]
sphere = { center = [0, 2, 0], radius = 0.5 }
material = "blue"

[[objects]]
sphere = { center = [2, 3, 0], radius = 0.25 }
material = "blue"

[[objects]]
sphere = { center = [4, 0, 0], radius = 1 }
material = "metal"

[[lights]]
point = { position = [3, 4, 5], color = [1, 1, 1] }

[[lights]]
point = { position = [-3, 4, 5], color = [0.5, 0.5, 0.5] }
"#;

fn open() -> (TempDir, Window) {
    open_text(SCENE)
}

fn open_text(text: &str) -> (TempDir, Window) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("scene.toml");
    std::fs::write(&path, text).expect("a scene");
    let path = path.to_str().expect("UTF-8");
    let mut window = Window::open(&[path, "--size=16x12", "--samples=1"]);
    window.settle();
    (folder, window)
}

fn ball(index: usize) -> Id {
    Id::Object(ObjectRef::Shape(index))
}

fn select(window: &mut Window, ids: &[Id]) {
    window.session().select(ids.to_vec());
    window.settle();
}

fn number(window: &mut Window, label: &str, value: f64) {
    let row = (window.harness).get_by_role_and_label(Role::SpinButton, label);
    row.set_value_accesskit(value);
    window.settle();
}

fn radii(scene: &Scene) -> Vec<f64> {
    let radius = |geometry: &Geometry| match geometry {
        Geometry::Sphere { radius, .. } => *radius,
        _ => panic!("no ball"),
    };
    let shapes = scene.shapes.iter();
    shapes.map(|shape| radius(&shape.geometry)).collect()
}

fn centers(scene: &Scene) -> Vec<[f64; 3]> {
    let center = |geometry: &Geometry| match geometry {
        Geometry::Sphere { center, .. } => center.to_array(),
        _ => panic!("no ball"),
    };
    let shapes = scene.shapes.iter();
    shapes.map(|shape| center(&shape.geometry)).collect()
}

fn phong(scene: &Scene, index: usize) -> &Phong {
    match &scene.materials[index].bsdf {
        Bsdf::Phong(phong) => phong,
        Bsdf::MetallicRoughness(_) => panic!("another model"),
    }
}

#[test]
fn an_edited_number_is_that_of_all_in_one_step() {
    let (_folder, mut window) = open();
    let before = scene(&window);
    select(&mut window, &[ball(0), ball(1), ball(2)]);
    number(&mut window, "Radius", 2.0);
    assert_eq!(radii(&scene(&window)), [2.0, 2.0, 2.0, 1.0]);
    // Only the part that was edited changes.
    number(&mut window, "Position y", 5.0);
    let found = centers(&scene(&window));
    let wanted = [
        [-2.0, 5.0, 0.0],
        [0.0, 5.0, 0.0],
        [2.0, 5.0, 0.0],
        [4.0, 0.0, 0.0],
    ];
    assert_eq!(found, wanted);
    let told = window.session().document.as_ref().and_then(|document| {
        assert_eq!(document.undo_count(), 2);
        document.undo_name().map(str::to_owned)
    });
    assert_eq!(told.as_deref(), Some("change position of 3 items"));
    perform(&mut window, Action::Undo);
    perform(&mut window, Action::Undo);
    assert!(scene(&window) == before);
}

#[test]
fn materials_of_all_selected_objects_change_each_once() {
    let (_folder, mut window) = open();
    select(&mut window, &[ball(0), ball(1), ball(2), ball(3)]);
    number(&mut window, "Diffuse red", 0.5);
    let found = scene(&window);
    assert_eq!(phong(&found, 0).diffuse, Vec3::new(0.5, 0.25, 0.25));
    assert_eq!(phong(&found, 1).diffuse, Vec3::new(0.5, 0.25, 0.75));
    let name = window.session().document.as_ref().and_then(|document| {
        let name = document.undo_name();
        name.map(str::to_owned)
    });
    // Two objects share one, and that of the fourth has no such row.
    assert_eq!(name.as_deref(), Some("change diffuse of 2 items"));
    // All materials emit, of whichever model they are.
    number(&mut window, "Emission blue", 1.0);
    let found = scene(&window);
    let blues = found.materials.iter().map(|it| it.emission.z);
    assert_eq!(blues.collect::<Vec<_>>(), [1.0; 3]);
    let row = (window.harness).get_by_role_and_label(Role::ComboBox, "Material");
    row.click_accesskit();
    window.harness.run_steps(4);
    crate::making::click_row(&mut window, "metal");
    window.settle();
    let found = scene(&window);
    assert!(found.shapes.iter().all(|shape| shape.material == 2));
}

#[test]
fn lights_change_together_and_nothing_else_does() {
    let (_folder, mut window) = open();
    let light = |index| Id::Object(ObjectRef::Light(index));
    select(&mut window, &[light(1), light(0), ball(0)]);
    number(&mut window, "Intensity", 4.0);
    let found = scene(&window);
    assert_eq!(found.lights[0].color, Vec3::splat(4.0));
    assert_eq!(found.lights[1].color, Vec3::splat(4.0));
    assert_eq!(radii(&found), [1.0, 0.5, 0.25, 1.0]);
}

#[test]
fn rows_whose_values_differ_show_a_dash_until_they_are_edited() {
    let (_folder, mut window) = open();
    let shown = |window: &Window, label: &str| {
        let row = window
            .harness
            .get_by_role_and_label(Role::SpinButton, label);
        let found = row.accesskit_node().value();
        found.unwrap_or_default()
    };
    select(&mut window, &[ball(0), ball(1)]);
    assert_eq!(shown(&window, "Radius"), "—");
    assert_eq!(shown(&window, "Shininess"), "10");
    assert_eq!(shown(&window, "Diffuse green"), "0.25");
    assert_eq!(shown(&window, "Diffuse red"), "—");
    // The number of the first one counts too if it is typed.
    let row = (window.harness).get_by_role_and_label(Role::SpinButton, "Radius");
    row.click();
    window.harness.run_steps(3);
    crate::focus::type_text(&mut window, "1");
    window.harness.key_press(eframe::egui::Key::Enter);
    window.settle();
    assert_eq!(radii(&scene(&window))[..2], [1.0, 1.0]);
    assert_eq!(shown(&window, "Radius"), "1");
}

fn toggle(window: &mut Window, label: &str) {
    let row = (window.harness).get_by_role_and_label(Role::CheckBox, label);
    row.click_accesskit();
    window.settle();
}

#[test]
fn a_linked_scale_changes_all_factors_of_all() {
    let boxes = r#"
[camera]
look_from = [0, 0, 9]
look_at = [0, 0, 0]

[materials.grey]
phong = { diffuse = [0.5, 0.5, 0.5] }

[[objects]]
box = { min = [-1, -2, -3], max = [1, 2, 3] }
material = "grey"

[[objects]]
box = { min = [4, -1, -2], max = [12, 1, 2] }
material = "grey"
"#;
    let (_folder, mut window) = open_text(boxes);
    select(&mut window, &[ball(0), ball(1)]);
    let scale = |window: &Window, index: usize| {
        let place = objects::place(&scene(window), ball(index), 0.0).expect("a place");
        Transform::of(place).0.scale
    };
    let before = [0, 1].map(|index| scale(&window, index));
    toggle(&mut window, "Uniform scale");
    number(&mut window, "Scale x", 2.0);
    for index in [0, 1] {
        let factor = scale(&window, index) / before[index];
        let wanted = DVec3::splat(2.0 / before[index].x);
        assert!(factor.abs_diff_eq(wanted, 1e-9), "{index}: {factor}");
    }
}

#[test]
fn the_ambient_colours_of_all_follow_or_stay_as_those_of_the_first() {
    let same = SCENE
        .replace("ambient = [0.5, 0.5, 0.5], ", "")
        .replace(
            "shininess = 10",
            "shininess = 10, ambient = [0.25, 0.25, 0.25]",
        )
        .replace("[0.75, 0.25, 0.25]", "[0.25, 0.25, 0.25]")
        .replace("[0.25, 0.25, 0.75]", "[0.25, 0.25, 0.25]");
    let (_folder, mut window) = open_text(&same);
    select(&mut window, &[ball(0), ball(1)]);
    number(&mut window, "Diffuse red", 0.5);
    let found = scene(&window);
    let half = Vec3::new(0.5, 0.25, 0.25);
    for index in [0, 1] {
        let phong = phong(&found, index);
        assert_eq!((phong.diffuse, phong.ambient), (half, half), "{index}");
    }
    toggle(&mut window, "Ambient follows diffuse");
    number(&mut window, "Diffuse red", 1.0);
    number(&mut window, "Ambient blue", 0.75);
    let found = scene(&window);
    for index in [0, 1] {
        let phong = phong(&found, index);
        assert_eq!(phong.diffuse, Vec3::new(1.0, 0.25, 0.25), "{index}");
        assert_eq!(phong.ambient, Vec3::new(0.5, 0.25, 0.75), "{index}");
    }
    toggle(&mut window, "Ambient follows diffuse");
    let found = scene(&window);
    for index in [0, 1] {
        let phong = phong(&found, index);
        assert_eq!(phong.ambient, phong.diffuse, "{index}");
    }
}

#[test]
fn each_row_keeps_to_its_own_limits() {
    let (_folder, mut window) = open();
    select(&mut window, &[ball(0), ball(3)]);
    number(&mut window, "Index (ior)", 0.5);
    let found = scene(&window);
    assert_eq!(phong(&found, 0).ior, 0.5);
    let metal = found.materials[2].metallic_roughness().expect("the model");
    assert_eq!(metal.ior, 1.0, "files refuse less");
}

#[test]
fn ten_thousand_selected_objects_cost_a_frame_little() {
    const COUNT: usize = 10_000;
    let head = SCENE.split("[[objects]]").next().expect("materials");
    let one = |index: usize| {
        let (x, y) = (index % 100, index / 100);
        format!(
            "[[objects]]\nsphere = {{ center = [{x}, {y}, 0], radius = 0.4 }}\nmaterial = \"red\"\n"
        )
    };
    let objects: String = (0..COUNT).map(one).collect();
    let (_folder, mut window) = open_text(&format!("{head}{objects}"));
    let all: Vec<Id> = (0..COUNT).map(ball).collect();
    select(&mut window, &all);
    // Ten frames of 50 ms, with all other panels.
    within(500.0, || window.harness.run_steps(10));
    // All are compared and edited once.
    within(2000.0, || {
        let row = (window.harness).get_by_role_and_label(Role::SpinButton, "Position z");
        row.set_value_accesskit(3.0);
        window.harness.run_steps(4);
    });
    window.settle();
    assert!(
        centers(&scene(&window))
            .iter()
            .all(|center| center[2] == 3.0)
    );
}

#[test]
fn a_mesh_is_filled_for_all_its_objects_or_copied_once_for_some() {
    use glam::DAffine3;
    use glimray::scene::{Instance, Material, Mesh};
    let instance = |mesh: usize| Instance {
        mesh,
        placement: DAffine3::IDENTITY,
        node: None,
        name: String::new(),
    };
    let mesh = Mesh {
        positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
        normals: vec![Vec3::Z; 3],
        materials: vec![0; 3],
        triangles: vec![[0, 1, 2]],
        ..Mesh::default()
    };
    let mut scene = Scene {
        meshes: vec![mesh.into()],
        instances: (0..3).map(|_| instance(0)).collect(),
        materials: vec![Material::default(); 3],
        ..Scene::default()
    };
    let given = |scene: &Scene| -> Vec<u32> {
        let instances = scene.instances.iter();
        let material = |it: &Instance| scene.meshes[it.mesh].materials[2];
        instances.map(material).collect()
    };
    let all = [0, 1, 2].map(ObjectRef::Instance);
    objects::assign_all(&mut scene, &all, 1).expect("given");
    assert_eq!((given(&scene), scene.meshes.len()), (vec![1; 3], 1));
    objects::assign_all(&mut scene, &all[1..], 2).expect("given");
    assert_eq!((given(&scene), scene.meshes.len()), (vec![1, 2, 2], 2));
    assert_eq!(scene.instances[1].mesh, scene.instances[2].mesh);
}
