//! Pictures on materials: opened, replaced, moved and removed by hand, and saved with the scene.

use crate::edit::{perform, scene};
use crate::harness::Window;
use crate::making::click;
use eframe::egui::Role;
use egui_kittest::kittest::{NodeT, Queryable};
use glimray::render::Tone;
use glimray::scene::{Bsdf, MetallicRoughness, ObjectRef, Pattern, Phong, Scene, Texels};
use glimray_io::import;
use glimray_viewer::actions::saving;
use glimray_viewer::model::bindings::Action;
use glimray_viewer::model::file_dialog::{FileDialogs, Reply};
use glimray_viewer::model::objects::Id;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// A rectangle that fills the picture and shows nothing but its diffuse colour under ambient light.
const SCENE: &str = r#"
ambient = [1, 1, 1]

[camera]
look_from = [0, 0, 5]
look_at = [0, 0, 0]
orthographic = 2

[materials.tested]
phong = { diffuse = [1, 1, 1] }

[materials.physical]
pbr = { base_color = [1, 1, 1], metallic = 0 }

[[objects]]
rectangle = { center = [0, 0, 0], normal = [0, 0, 1], size = [2, 2] }
material = "tested"

[[objects]]
sphere = { center = [9, 0, 0], radius = 1 }
material = "physical"
"#;

/// Writes a picture of 2 × 1 texels: red on the left, and a colour on the right.
pub(super) fn picture(path: &Path, right: [u8; 4]) -> PathBuf {
    let mut picture = image::RgbaImage::new(2, 1);
    picture.put_pixel(0, 0, image::Rgba([255, 0, 0, 255]));
    picture.put_pixel(1, 0, image::Rgba(right));
    picture.save(path).expect("a picture");
    path.to_owned()
}

fn open() -> (TempDir, Window) {
    open_text(SCENE)
}

/// Beside the scene lies the square as a model.
fn open_text(text: &str) -> (TempDir, Window) {
    let folder = tempfile::tempdir().expect("a folder");
    let square = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n\
                  f 1/1 2/2 3/3 4/4\n";
    std::fs::write(folder.path().join("square.obj"), square).expect("a model");
    let path = folder.path().join("scene.toml");
    std::fs::write(&path, text).expect("a scene");
    let path = path.to_str().expect("UTF-8");
    let mut window = Window::open(&[path, "--size=16x16", "--integrator=whitted"]);
    window.harness.set_size(eframe::egui::vec2(1000.0, 1600.0));
    window.settle();
    (folder, window)
}

/// The file dialog will answer with this file.
pub(super) fn answer(window: &Window, path: &Path) {
    let path = path.to_owned();
    let dialogs = FileDialogs::answering(move |_| Reply::Chosen(path.clone()));
    window.session().files.dialogs = dialogs;
}

fn select(window: &mut Window, shape: usize) {
    let id = Id::Object(ObjectRef::Shape(shape));
    window.session().select(vec![id]);
    window.settle();
}

fn unfold_textures(window: &mut Window) {
    let heading = (window.harness).get_by_role_and_label(Role::DisclosureTriangle, "Textures");
    heading.click_accesskit();
    window.settle();
}

/// Presses a button as a screen reader does, wherever the panel is scrolled to.
fn press(window: &mut Window, label: &str) {
    let button = window.harness.get_by_role_and_label(Role::Button, label);
    button.click_accesskit();
    window.harness.run_steps(3);
}

/// The red and the green of the pixels in a row through the middle, from left to right.
fn row(window: &mut Window) -> Vec<[f32; 2]> {
    let image = window.image(Tone::LINEAR);
    let middle = (image.width * (image.height / 2)) as usize;
    let row = &image.pixels[middle..middle + image.width as usize];
    row.iter().map(|[red, green, ..]| [*red, *green]).collect()
}

/// How many pixels of the row are red and how many green.
fn counts(window: &mut Window) -> [usize; 2] {
    let row = row(window);
    [0, 1].map(|channel| {
        let is_it = |pixel: &&[f32; 2]| pixel[channel] > 0.9 && pixel[1 - channel] < 0.1;
        row.iter().filter(is_it).count()
    })
}

fn phong(scene: &Scene) -> &Phong {
    match &scene.materials[0].bsdf {
        Bsdf::Phong(phong) => phong,
        Bsdf::MetallicRoughness(_) => panic!("another model"),
    }
}

fn layers(scene: &Scene) -> &MetallicRoughness {
    scene.materials[1].metallic_roughness().expect("the model")
}

fn texels(scene: &Scene, texture: usize) -> &Texels {
    match scene.textures[texture].pattern {
        Pattern::Picture { picture, .. } => &scene.pictures[picture].texels,
        _ => panic!("no picture"),
    }
}

#[test]
fn a_picture_is_opened_replaced_and_removed_in_one_step_each() {
    let (folder, mut window) = open();
    let green = picture(&folder.path().join("green.png"), [0, 255, 0, 255]);
    let blue = picture(&folder.path().join("blue.png"), [0, 0, 255, 255]);
    select(&mut window, 0);
    unfold_textures(&mut window);
    let plain = scene(&window);
    answer(&window, &green);
    press(&mut window, "Open × Ambient");
    window.settle();
    // Texels are interpolated where they look larger than a pixel: their middles are of one colour.
    let [reds, greens] = counts(&mut window);
    assert!(reds > 0 && greens == reds, "{reds} red and {greens} green");
    let opened = scene(&window);
    assert_eq!(phong(&opened).textures.ambient, Some(0));
    assert!(matches!(texels(&opened, 0), Texels::Srgb8(_)));
    let name = |window: &Window| {
        let row = window
            .harness
            .get_by_role_and_label(Role::ComboBox, "× Ambient");
        row.accesskit_node().value()
    };
    assert_eq!(name(&window).as_deref(), Some("green.png (texture 1)"));
    answer(&window, &blue);
    press(&mut window, "Replace × Ambient");
    window.settle();
    let replaced = scene(&window);
    assert!(texels(&replaced, 0) != texels(&opened, 0));
    assert_eq!(counts(&mut window)[1], 0);
    assert_eq!(replaced.textures.len(), 1, "the place is kept");
    assert_eq!(name(&window).as_deref(), Some("blue.png (texture 1)"));
    press(&mut window, "Remove × Ambient");
    window.settle();
    assert_eq!(phong(&scene(&window)).textures.ambient, None);
    for before in [&replaced, &opened, &plain] {
        perform(&mut window, Action::Undo);
        assert!(scene(&window) == *before);
    }
    perform(&mut window, Action::Redo);
    assert!(scene(&window) == opened);
}

#[test]
fn the_placement_of_a_picture_repeats_shifts_and_mirrors_it() {
    let (folder, mut window) = open();
    let green = picture(&folder.path().join("green.png"), [0, 255, 0, 255]);
    select(&mut window, 0);
    unfold_textures(&mut window);
    answer(&window, &green);
    press(&mut window, "Open × Ambient");
    window.settle();
    click_fold(&mut window, "Placement of × Ambient");
    let check = window
        .harness
        .get_by_role_and_label(Role::CheckBox, "Sharp texels");
    check.click_accesskit();
    window.settle();
    let is_red = |window: &mut Window| -> Vec<bool> {
        row(window).iter().map(|[red, _]| *red > 0.5).collect()
    };
    let halves = is_red(&mut window);
    assert!(halves[..8].iter().all(|red| *red) && halves[8..].iter().all(|red| !red));
    let set = |window: &mut Window, label: &str, value: f64| {
        let row = window
            .harness
            .get_by_role_and_label(Role::SpinButton, label);
        row.set_value_accesskit(value);
        window.settle();
    };
    set(&mut window, "Repeats u", 2.0);
    let quarters = is_red(&mut window);
    for (pixel, red) in quarters.iter().enumerate() {
        assert_eq!(*red, pixel / 4 % 2 == 0, "pixel {pixel} of {quarters:?}");
    }
    set(&mut window, "Repeats u", 1.0);
    set(&mut window, "Offset u", 0.5);
    let shifted = is_red(&mut window);
    assert!(shifted[..8].iter().all(|red| !red) && shifted[8..].iter().all(|red| *red));
    // Turned by half a turn about its upper left corner, it lies to the left of the surface and above it, where it is repeated.
    set(&mut window, "Offset u", 0.0);
    set(&mut window, "Turn", 180.0);
    assert_eq!(is_red(&mut window), shifted);
}

fn click_fold(window: &mut Window, label: &str) {
    let fold = window.harness.get_by_label(label);
    fold.click_accesskit();
    window.settle();
}

#[test]
fn a_picture_lies_on_a_model_that_had_no_texture() {
    let rectangle = "rectangle = { center = [0, 0, 0], normal = [0, 0, 1], size = [2, 2] }";
    let (folder, mut window) =
        open_text(&SCENE.replace(rectangle, "mesh = { file = \"square.obj\" }"));
    let green = picture(&folder.path().join("green.png"), [0, 255, 0, 255]);
    let model = Id::Object(ObjectRef::Instance(0));
    window.session().select(vec![model]);
    window.settle();
    unfold_textures(&mut window);
    answer(&window, &green);
    press(&mut window, "Open × Ambient");
    window.settle();
    let [reds, greens] = counts(&mut window);
    assert!(reds > 0 && greens == reds, "{reds} red and {greens} green");
}

#[test]
fn a_picture_of_numbers_is_not_decoded_as_colours_and_wakes_its_factor() {
    let (folder, mut window) = open();
    let grey = picture(&folder.path().join("grey.png"), [128, 128, 128, 255]);
    select(&mut window, 1);
    unfold_textures(&mut window);
    answer(&window, &grey);
    press(&mut window, "Open × Transmission");
    window.settle();
    let found = scene(&window);
    assert_eq!(layers(&found).textures.transmission, Some(0));
    assert_eq!(layers(&found).transmission, 1.0);
    assert!(matches!(texels(&found, 0), Texels::Linear8(_)));
    perform(&mut window, Action::Undo);
    assert_eq!(layers(&scene(&window)).transmission, 0.0);
}

#[test]
fn a_saved_scene_has_its_pictures_beside_it_wherever_they_were() {
    let (_folder, mut window) = open();
    let far = tempfile::tempdir().expect("a folder");
    let green = picture(&far.path().join("green.png"), [0, 255, 0, 255]);
    select(&mut window, 0);
    unfold_textures(&mut window);
    answer(&window, &green);
    press(&mut window, "Open × Ambient");
    window.settle();
    let shown = window.image(Tone::LINEAR);
    let target = tempfile::tempdir().expect("a folder");
    let path = target.path().join("saved.toml");
    saving::write(&mut window.session(), &path).expect("a saved scene");
    drop(far);
    let read = import::load(&path).expect("a scene");
    let before = scene(&window);
    assert_eq!(texels(&read, 0), texels(&before, 0));
    let path = path.to_str().expect("UTF-8");
    let mut again = Window::open(&[path, "--size=16x16", "--integrator=whitted"]);
    again.settle();
    assert!(again.image(Tone::LINEAR) == shown);
}

#[test]
fn a_file_that_is_no_picture_is_refused_in_one_line() {
    let (folder, mut window) = open();
    let path = folder.path().join("words.png");
    std::fs::write(&path, "not a picture").expect("a file");
    select(&mut window, 0);
    unfold_textures(&mut window);
    let before = scene(&window);
    answer(&window, &path);
    press(&mut window, "Open × Diffuse");
    window.settle();
    assert!(scene(&window) == before);
    let told = window.session().messages.current();
    let last = told.last().expect("a message").text.clone();
    assert!(last.contains("words.png") && last.contains("PNG"), "{last}");
    assert_eq!(last.lines().count(), 1, "{last}");
}

#[test]
fn without_a_file_dialog_the_path_is_typed() {
    let (folder, mut window) = open();
    let green = picture(&folder.path().join("green.png"), [0, 255, 0, 255]);
    let dialogs = FileDialogs::answering(|_| Reply::Unavailable);
    window.session().files.dialogs = dialogs;
    select(&mut window, 0);
    unfold_textures(&mut window);
    press(&mut window, "Open × Ambient");
    window.settle();
    let field = window.harness.get_by_label("Path");
    field.type_text(green.to_str().expect("UTF-8"));
    window.settle();
    click(&mut window, "Open");
    window.settle();
    assert_eq!(phong(&scene(&window)).textures.ambient, Some(0));
}

#[test]
fn a_picture_is_opened_for_all_selected_materials_that_have_the_slot() {
    let (folder, mut window) = open();
    let green = picture(&folder.path().join("green.png"), [0, 255, 0, 255]);
    let both = [0, 1].map(|index| Id::Object(ObjectRef::Shape(index)));
    window.session().select(both.to_vec());
    window.settle();
    unfold_textures(&mut window);
    let before = scene(&window);
    answer(&window, &green);
    press(&mut window, "Open × Emission");
    window.settle();
    let found = scene(&window);
    let emissions = found.materials.iter().map(|it| it.textures.emission);
    assert_eq!(emissions.collect::<Vec<_>>(), [Some(0), Some(0)]);
    assert_eq!((found.textures.len(), found.pictures.len()), (1, 1));
    // The other material has no ambient colour.
    press(&mut window, "Open × Ambient");
    window.settle();
    let found = scene(&window);
    assert!(phong(&found).textures.ambient.is_some());
    for _ in 0..2 {
        perform(&mut window, Action::Undo);
    }
    assert!(scene(&window) == before);
}

#[test]
fn a_picture_goes_to_no_other_material_than_was_asked_for() {
    let (folder, mut window) = open();
    let green = picture(&folder.path().join("green.png"), [0, 255, 0, 255]);
    let dialogs = FileDialogs::answering(|_| Reply::Unavailable);
    window.session().files.dialogs = dialogs;
    select(&mut window, 0);
    unfold_textures(&mut window);
    press(&mut window, "Open × Ambient");
    window.settle();
    window.session().change("swap", |scene| {
        scene.materials.swap(0, 1);
        Ok(())
    });
    let before = scene(&window);
    let field = window.harness.get_by_label("Path");
    field.type_text(green.to_str().expect("UTF-8"));
    window.settle();
    click(&mut window, "Open");
    window.settle();
    assert!(scene(&window) == before);
    let told = window.session().messages.current();
    let last = told.last().expect("a message").text.clone();
    assert!(
        last.contains("tested") && last.lines().count() == 1,
        "{last}"
    );
}

/// A square in the plane z = 0 with the u and v of its corners, whose material has a normal map in texture 0.
fn mapped() -> Scene {
    use glam::{Vec2, Vec3};
    use glimray::scene::{Material, Mesh, Space, Texture};
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(Vec2::from);
    let mut material = Material::default();
    material.textures.normal = Some(0);
    let texture = Texture {
        pattern: Pattern::Checker {
            a: Vec3::ZERO,
            b: Vec3::ONE,
        },
        space: Space::Uv,
        pattern_from_space: glam::DAffine3::IDENTITY,
    };
    let mut scene = Scene {
        meshes: vec![
            Mesh {
                positions: corners.map(|it| it.extend(0.0)).to_vec(),
                normals: vec![Vec3::Z; 4],
                uvs: corners.to_vec(),
                materials: vec![0; 4],
                triangles: vec![[0, 1, 2], [0, 2, 3]],
                ..Mesh::default()
            }
            .into(),
        ],
        materials: vec![material],
        textures: vec![texture],
        ..Scene::default()
    };
    scene.complete_tangents();
    scene
}

#[test]
fn tangents_follow_the_placement_of_a_normal_map() {
    let mut scene = mapped();
    let is_along = |scene: &Scene, direction: glam::Vec3| {
        let tangents = &scene.meshes[0].tangents;
        (tangents.iter()).all(|it| it.truncate().abs_diff_eq(direction, 1e-6))
    };
    assert!(is_along(&scene, glam::Vec3::X));
    let turn = |scene: &mut Scene, turned: glam::DAffine3| {
        scene.change_mappings(|scene| scene.textures[0].pattern_from_space = turned);
    };
    // u of the picture is v of the square.
    let quarter =
        glam::DAffine3::from_mat3(glam::dmat3(-glam::DVec3::Y, glam::DVec3::X, glam::DVec3::Z));
    turn(&mut scene, quarter);
    assert!(is_along(&scene, glam::Vec3::Y));
    turn(&mut scene, glam::DAffine3::IDENTITY);
    assert!(is_along(&scene, glam::Vec3::X));
    // Tangents that lie along no axis, as a file may give them, stay where a picture is only shifted.
    let given = glam::vec4(0.6, 0.8, 0.0, 1.0);
    std::sync::Arc::make_mut(&mut scene.meshes[0]).tangents = vec![given; 4];
    turn(
        &mut scene,
        glam::DAffine3::from_translation(glam::DVec3::splat(0.25)),
    );
    assert!(is_along(&scene, given.truncate()));
    // After another picture is removed, the coordinates of the surface count.
    turn(&mut scene, quarter);
    scene.change_mappings(|scene| scene.materials[0].textures.normal = None);
    turn(&mut scene, glam::DAffine3::IDENTITY);
    scene.change_mappings(|scene| scene.materials[0].textures.normal = Some(0));
    assert!(is_along(&scene, glam::Vec3::X));
}
