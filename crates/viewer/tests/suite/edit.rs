//! Editing in the window: what is selected, changed, taken back and saved.

use crate::harness::Window;
use crate::reference::compare::render;
use eframe::egui::{Key, Pos2, vec2};
use egui_kittest::kittest::{NodeT, Queryable};
use glam::{DAffine3, DVec3, dvec3, vec3};
use glimray::import;
use glimray::render::Tone;
use glimray::scene::{Background, Geometry, ObjectRef, Scene};
use glimray_app::scene_file;
use glimray_viewer::actions::saving;
use glimray_viewer::model::bindings::Action;
use glimray_viewer::model::file_dialog::{FileDialogs, Reply};
use glimray_viewer::model::objects::{self, Id};
use glimray_viewer::model::tool::Tool;
use glimray_viewer::state::dialogs::Dialog;
use glimray_viewer::state::files::Intent;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// Two balls beside each other, seen along −z from a distance of 8, and a lamp.
const BALLS: &str = r#"
background = [0.1, 0.2, 0.3]
ambient = [0.2, 0.2, 0.2]

[camera]
look_from = [0, 0, 8]
look_at = [0, 0, 0]
fov_y_deg = 30

[[lights]]
point = { position = [3, 4, 5], color = [0.9, 0.9, 0.9] }

[materials]
red = { phong = { diffuse = [0.75, 0.125, 0.0625], specular = [0.25, 0.25, 0.25], shininess = 20 } }
blue = { phong = { diffuse = [0.0625, 0.125, 0.75] } }

[[objects]]
sphere = { center = [-1, 0, 0], radius = 0.75 }
material = "red"

[[objects]]
sphere = { center = [1, 0, 0], radius = 0.75 }
material = "blue"
"#;

pub(super) const RED: Id = Id::Object(ObjectRef::Shape(0));
pub(super) const BLUE: Id = Id::Object(ObjectRef::Shape(1));

/// A file of these balls in a folder of its own.
pub(super) fn file() -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("balls.toml");
    std::fs::write(&path, BALLS).expect("a file");
    (folder, path)
}

/// A window that shows them in so many pixels, with one sample each.
pub(super) fn open(path: &Path, size: &str) -> Window {
    let path = path.to_str().expect("a path in UTF-8");
    let mut window = Window::open(&[path, "--size", size, "--samples", "1"]);
    window.settle();
    window
}

pub(super) fn perform(window: &mut Window, action: Action) {
    window.session().clicked.push(action);
    window.settle();
}

pub(super) fn scene(window: &Window) -> Scene {
    let session = window.session();
    Scene::clone(session.scene().expect("a scene"))
}

fn notices(window: &Window) -> Vec<String> {
    let notices = window.session().messages.current();
    notices.into_iter().map(|notice| notice.text).collect()
}

/// Where on the screen a point of the world is.
pub(super) fn on_screen(window: &Window, point: DVec3) -> Pos2 {
    let session = window.session();
    let viewport = session.viewport.expect("a picture");
    let camera = session.camera().expect("a camera");
    let at = glimray_viewer::model::camera::project(&camera, point, viewport.extent());
    viewport.point(at.expect("in front of the camera"))
}

/// Drags with the left button from one point of the screen to another.
pub(super) fn drag(window: &mut Window, from: Pos2, to: Pos2) {
    window.harness.hover_at(from);
    window.harness.step();
    window.harness.drag_at(from);
    window.harness.step();
    for share in [0.4, 1.0] {
        window.harness.hover_at(from + (to - from) * share);
        window.harness.step();
    }
    window.harness.drop_at(to);
    window.settle();
}

/// Types a number into a field.
fn set(window: &mut Window, field: &str, value: f64) {
    window
        .harness
        .get_by_label(field)
        .set_value_accesskit(value);
    window.settle();
}

fn assert_shows(window: &mut Window, wanted: &Scene, what: &str) {
    let (expected, _) = render(wanted, &window.request().settings);
    let image = window.image(Tone::LINEAR);
    assert!(
        image == expected,
        "{what}: the picture is not that of the scene"
    );
}

#[test]
fn a_click_in_the_picture_and_one_in_the_outline_select_the_same() {
    let (_folder, path) = file();
    let mut window = open(&path, "320x240");
    let blue = on_screen(&window, dvec3(1.0, 0.0, 0.0));
    window.harness.drag_at(blue);
    window.harness.step();
    window.harness.drop_at(blue);
    window.settle();
    assert_eq!(window.session().selection, Some(BLUE));
    window.harness.get_by_label("sphere 1 (red)").click();
    window.settle();
    assert_eq!(window.session().selection, Some(RED));
    // Arrows go on from there.
    window.harness.key_press(Key::ArrowDown);
    window.settle();
    assert_eq!(window.session().selection, Some(BLUE));
    let nowhere = on_screen(&window, dvec3(0.0, 1.5, 0.0));
    window.harness.drag_at(nowhere);
    window.harness.step();
    window.harness.drop_at(nowhere);
    window.settle();
    assert_eq!(window.session().selection, None);
}

#[test]
fn search_leaves_what_has_the_words() {
    let (_folder, path) = file();
    let mut window = open(&path, "64x48");
    window.session().editing.listing.query = "blue".into();
    window.settle();
    window.harness.get_by_label("sphere 2 (blue)");
    assert!(window.harness.query_by_label("sphere 1 (red)").is_none());
}

#[test]
fn a_material_that_is_changed_gives_the_picture_of_the_changed_scene() {
    let (_folder, path) = file();
    let mut window = open(&path, "64x48");
    window.harness.get_by_label("red").click();
    window.settle();
    let mut wanted = scene(&window);
    set(&mut window, "Diffuse green", 0.5);
    wanted.materials[0].classical_mut().diffuse = vec3(0.75, 0.5, 0.0625);
    // Without a colour of its own, ambient light is reflected in the diffuse colour.
    wanted.materials[0].classical_mut().ambient = wanted.materials[0].classical().diffuse;
    assert_eq!(scene(&window), wanted);
    assert_shows(&mut window, &wanted, "diffuse");
    // An opaque material becomes transparent: other code on the GPU.
    set(&mut window, "Transmit red", 0.5);
    wanted.materials[0].classical_mut().transmit.x = 0.5;
    assert_shows(&mut window, &wanted, "transmit");
    perform(&mut window, Action::Undo);
    wanted.materials[0].classical_mut().transmit.x = 0.0;
    assert_shows(&mut window, &wanted, "undone");
}

#[test]
fn a_background_and_a_light_that_are_changed_give_the_picture_of_the_changed_scene() {
    let (_folder, path) = file();
    let mut window = open(&path, "64x48");
    let mut wanted = scene(&window);
    set(&mut window, "Background red", 0.875);
    wanted.background = Background::Color(vec3(0.875, 0.2, 0.3));
    assert_shows(&mut window, &wanted, "background");
    window.harness.get_by_label("point light 1").click();
    window.settle();
    set(&mut window, "Intensity", 0.45);
    wanted.lights[0].color *= 0.5;
    assert_shows(&mut window, &wanted, "intensity");
    set(&mut window, "Position y", -4.0);
    wanted.lights[0].kind = glimray::scene::LightKind::Point {
        position: dvec3(3.0, -4.0, 5.0),
    };
    assert_eq!(scene(&window), wanted);
    assert_shows(&mut window, &wanted, "position");
}

#[test]
fn a_background_that_becomes_a_sky_with_a_lower_sun_is_that_of_a_file_with_this_sky() {
    let (folder, path) = file();
    let mut window = open(&path, "64x48");
    window.harness.get_by_label("Kind").click();
    window.settle();
    window.harness.get_by_label("Sky").click();
    window.settle();
    set(&mut window, "Sun elevation", 20.0);
    set(&mut window, "Sun azimuth", 30.0);
    let sky = "background = { sky = { elevation_deg = 20, azimuth_deg = 30 } }";
    let other = folder.path().join("sky.toml");
    let text = BALLS.replace("background = [0.1, 0.2, 0.3]", sky);
    std::fs::write(&other, text).expect("a file");
    let wanted = import::load(&other).expect("a scene");
    assert_eq!(scene(&window).background, wanted.background);
    assert_eq!(scene(&window).pictures, wanted.pictures);
    assert_shows(&mut window, &wanted, "sky");
    for _ in 0..3 {
        perform(&mut window, Action::Undo);
    }
    let before = Background::Color(vec3(0.1, 0.2, 0.3));
    assert_eq!(scene(&window).background, before);
}

#[test]
fn an_arrow_moves_what_is_selected_as_far_as_the_hand_and_as_numbers_do() {
    let (_folder, path) = file();
    let mut window = open(&path, "400x300");
    {
        let mut session = window.session();
        session.selection = Some(RED);
        session.tool = Tool::Move;
    }
    window.settle();
    let origin = on_screen(&window, dvec3(-1.0, 0.0, 0.0));
    let grip = origin + vec2(60.0, 0.0);
    drag(&mut window, grip, grip + vec2(40.0, 0.0));
    // The arrow lies in the plane of the picture: a pixel there is 2 d tan(fov / 2) / height wide.
    let pixel = 2.0 * 8.0 * 15_f64.to_radians().tan() / 300.0;
    let Geometry::Sphere { center, radius } = scene(&window).shapes[0].geometry else {
        panic!("a sphere stays one");
    };
    let expected = dvec3(-1.0 + 40.0 * pixel, 0.0, 0.0);
    // Not to the last digit: egui counts points in single floats.
    assert!(
        center.distance(expected) < 1e-4,
        "{center} is not {expected}"
    );
    assert_eq!(radius, 0.75);
    {
        let session = window.session();
        let document = session.document.as_ref().expect("a document");
        assert_eq!(document.undo_name(), Some("move sphere 1 (red)"));
        assert_eq!(document.undo_count(), 1);
    }
    let by_hand = window.session().selection_bounds();
    perform(&mut window, Action::Undo);
    set(&mut window, "Position x", center.x);
    assert_eq!(window.session().selection_bounds(), by_hand);
}

#[test]
fn escape_puts_back_what_is_being_dragged() {
    let (_folder, path) = file();
    let mut window = open(&path, "400x300");
    let before = scene(&window);
    {
        let mut session = window.session();
        session.selection = Some(RED);
        session.tool = Tool::Move;
    }
    window.settle();
    let grip = on_screen(&window, dvec3(-1.0, 0.0, 0.0)) + vec2(60.0, 0.0);
    window.harness.drag_at(grip);
    window.harness.step();
    for by in [20.0, 40.0] {
        window.harness.hover_at(grip + vec2(by, 0.0));
        window.harness.step();
    }
    assert_ne!(scene(&window), before);
    window.harness.key_press(Key::Escape);
    window.harness.step();
    assert_eq!(scene(&window), before);
    window.harness.hover_at(grip + vec2(70.0, 0.0));
    window.harness.step();
    window.harness.drop_at(grip + vec2(70.0, 0.0));
    window.settle();
    assert_eq!(scene(&window), before);
    assert_eq!(window.session().tool, Tool::Move);
}

#[test]
fn steps_are_taken_back_and_done_again_by_their_names() {
    let (_folder, path) = file();
    let mut window = open(&path, "64x48");
    let before = scene(&window);
    window.session().selection = Some(BLUE);
    perform(&mut window, Action::ToggleVisible);
    let hidden = scene(&window);
    assert_shows(&mut window, &hidden, "hidden");
    perform(&mut window, Action::Delete);
    assert_eq!(scene(&window).shapes.len(), 1);
    assert_eq!(window.session().selection, None);
    perform(&mut window, Action::Undo);
    perform(&mut window, Action::Undo);
    assert_eq!(scene(&window), before);
    assert_shows(&mut window, &before, "undone");
    let told = notices(&window);
    let wanted = ["Undid delete sphere 2 (blue)", "Undid hide sphere 2 (blue)"];
    assert_eq!(told[told.len() - 2..], wanted);
    perform(&mut window, Action::Redo);
    assert_eq!(scene(&window), hidden);
    assert_eq!(
        notices(&window).last().expect("a notice"),
        "Redid hide sphere 2 (blue)"
    );
}

#[test]
fn a_copy_is_selected_and_stands_in_the_same_place() {
    let (_folder, path) = file();
    let mut window = open(&path, "64x48");
    window.session().selection = Some(RED);
    perform(&mut window, Action::Duplicate);
    let after = scene(&window);
    assert_eq!(after.shapes.len(), 3);
    assert_eq!(after.shapes[2], after.shapes[0]);
    assert_eq!(
        window.session().selection,
        Some(Id::Object(ObjectRef::Shape(2)))
    );
}

#[test]
fn a_saved_scene_gives_the_same_picture() {
    let (folder, path) = file();
    let mut window = open(&path, "64x48");
    window.session().selection = Some(RED);
    window.settle();
    set(&mut window, "Position y", 0.375);
    let edited = scene(&window);
    window.harness.key_press(Key::K);
    window.settle();
    perform(&mut window, Action::SaveSceneAs);
    let other = folder.path().join("other.toml");
    let name = other.to_str().expect("a path in UTF-8");
    window
        .harness
        .get_by_label("File name")
        .set_text_value_accesskit(name);
    window.harness.step();
    window.harness.step();
    window.harness.get_by_label("Save").click();
    window.settle();
    assert!(
        notices(&window).iter().any(|n| n.starts_with("Saved ")),
        "{:?}",
        notices(&window)
    );
    let read = glimray::import::load(&other).expect("a scene");
    let (expected, _) = render(&edited, &window.request().settings);
    let (again, _) = render(&read, &window.request().settings);
    assert!(expected == again, "the saved scene gives another picture");
    assert!(
        !window
            .session()
            .document
            .as_ref()
            .expect("a document")
            .is_changed()
    );
    let old = std::fs::read_to_string(&path).expect("the old file");
    assert_eq!(old, BALLS, "the old file was touched");
    let preferences = window.session().preferences.clone();
    assert_eq!(preferences.cameras_of(&path).len(), 1);
    assert_eq!(
        preferences.cameras_of(&other),
        preferences.cameras_of(&path)
    );
}

/// Types a name into the sheet that asks for one, and presses Enter.
fn enter_name(window: &mut Window, name: &str) {
    perform(window, Action::SaveSceneAs);
    let field = window.harness.get_by_label("File name");
    field.set_text_value_accesskit(name);
    window.harness.run_steps(2);
    window.harness.get_by_label("File name").focus();
    window.harness.step();
    window.harness.key_press(Key::Enter);
    window.settle();
}

#[test]
fn enter_replaces_no_file_of_a_person_and_writes_none_without_a_name() {
    let (folder, path) = file();
    let mut window = open(&path, "64x48");
    window
        .session()
        .edit("brighten", |scene| scene.ambient *= 2.0);
    enter_name(&mut window, path.to_str().expect("a path in UTF-8"));
    assert_eq!(std::fs::read_to_string(&path).expect("the file"), BALLS);
    window.harness.get_by_label("Cancel").click();
    window.settle();
    for name in ["/", "/.toml"] {
        enter_name(&mut window, &format!("{}{name}", folder.path().display()));
        window
            .harness
            .get_by_label("Enter a name, such as scene.toml.");
        window.harness.get_by_label("Cancel").click();
        window.settle();
    }
    assert_eq!(
        std::fs::read_dir(folder.path()).expect("a folder").count(),
        1
    );
    assert!(window.session().has_changes());
}

#[test]
fn a_saved_scene_that_someone_else_changed_is_not_replaced_without_a_question() {
    let (folder, path) = file();
    let mut window = open(&path, "64x48");
    let other = folder.path().join("other.toml");
    window
        .session()
        .edit("brighten", |scene| scene.ambient *= 2.0);
    enter_name(&mut window, other.to_str().expect("a path in UTF-8"));
    window
        .session()
        .edit("brighten", |scene| scene.ambient *= 2.0);
    perform(&mut window, Action::SaveScene);
    assert!(
        !window.session().has_changes(),
        "what is our own is saved at once"
    );
    std::fs::write(&other, BALLS).expect("a file");
    window
        .session()
        .edit("brighten", |scene| scene.ambient *= 2.0);
    perform(&mut window, Action::SaveScene);
    assert_eq!(std::fs::read_to_string(&other).expect("the file"), BALLS);
    // Nor when it was read again.
    glimray_viewer::actions::files::go_on(&mut window.session(), Intent::Reload);
    window.settle();
    perform(&mut window, Action::SaveScene);
    assert_eq!(std::fs::read_to_string(&other).expect("the file"), BALLS);
}

#[test]
fn what_the_command_line_said_is_in_the_saved_file_and_not_said_again() {
    let (folder, path) = file();
    let path = path.to_str().expect("a path in UTF-8");
    let set = ["--look-from", "0,0,9", "--set", "ambient=[0.5,0.5,0.5]"];
    let mut window =
        Window::open(&[&[path, "--size", "64x48", "--samples", "1"], set.as_slice()].concat());
    window.settle();
    let other = folder.path().join("other.toml");
    enter_name(&mut window, other.to_str().expect("a path in UTF-8"));
    let line = window.copied();
    assert!(line.contains("other.toml"), "{line}");
    assert!(
        !line.contains("--set") && !line.contains("--look-from"),
        "{line}"
    );
}

#[test]
fn settings_of_the_picture_are_kept_in_the_scene_when_they_are_wanted_there() {
    let (folder, path) = file();
    let mut window = open(&path, "64x48");
    {
        let look = &mut window.session().view;
        look.set_samples(2);
        look.tone.exposure_ev = 0.5;
        look.background = Some(Background::Color(vec3(0.5, 0.25, 0.125)));
    }
    window.settle();
    window
        .harness
        .get_by_label("Save settings to scene")
        .click();
    window.settle();
    let kept = scene(&window);
    assert_eq!((kept.output.samples, kept.output.exposure_ev), (2, 0.5));
    assert_eq!(kept.background, Background::Color(vec3(0.5, 0.25, 0.125)));
    assert!(!window.session().has_unsaved_view_settings());
    let other = folder.path().join("kept.toml");
    glimray_app::scene_file::save(&other, &kept, false).expect("a file");
    let read = glimray::import::load(&other).expect("a scene");
    assert_eq!(read.output, kept.output);
    assert_shows(&mut window, &read, "kept");
    perform(&mut window, Action::Undo);
    assert_eq!(scene(&window).output.samples, 1);
}

#[test]
fn revert_goes_back_to_the_file_and_can_itself_be_undone() {
    let (_folder, path) = file();
    let mut window = open(&path, "64x48");
    let before = scene(&window);
    window.session().selection = Some(RED);
    window.settle();
    set(&mut window, "Radius", 0.5);
    let edited = scene(&window);
    assert_ne!(edited, before);
    perform(&mut window, Action::Revert);
    assert_eq!(scene(&window), before);
    assert_shows(&mut window, &before, "reverted");
    perform(&mut window, Action::Undo);
    assert_eq!(scene(&window), edited);
}

#[test]
fn the_camera_under_the_hand_can_become_the_scenes_own() {
    let (_folder, path) = file();
    let mut window = open(&path, "64x48");
    {
        let mut session = window.session();
        let rig = session.controller.as_mut().expect("a camera");
        rig.orbit_by(0.5, 0.25);
        rig.arrive();
    }
    window.settle();
    let seen = window.camera();
    window
        .harness
        .get_by_label("Set scene camera from view")
        .click_accesskit();
    window.settle();
    let own = scene(&window).frame(0.0).camera;
    assert_eq!((own.look_from, own.look_at), (seen.look_from, seen.look_at));
    assert!(
        window
            .session()
            .controller
            .as_ref()
            .expect("a camera")
            .is_home()
    );
}

#[test]
fn undo_keeps_the_selection_on_the_same_object() {
    let (_folder, path) = file();
    let mut window = open(&path, "64x48");
    window.session().selection = Some(RED);
    perform(&mut window, Action::Delete);
    // The other ball is the first one now.
    window.session().selection = Some(RED);
    perform(&mut window, Action::Undo);
    assert_eq!(window.session().selection, Some(BLUE));
    perform(&mut window, Action::Redo);
    assert_eq!(window.session().selection, Some(RED));
    perform(&mut window, Action::Undo);
    window.session().selection = Some(RED);
    perform(&mut window, Action::Redo);
    assert_eq!(window.session().selection, None, "what is gone");
    window.session().selection = Some(RED);
    perform(&mut window, Action::Duplicate);
    // The number of balls is that of the file, but the balls are others.
    perform(&mut window, Action::Revert);
    assert_eq!(window.session().selection, None, "another scene");
}

#[test]
fn labels_are_those_of_the_scene_on_screen_where_the_outline_is_hidden() {
    let (folder, path) = file();
    let mut window = open(&path, "64x48");
    assert_eq!(window.session().label(RED), "sphere 1 (red)");
    window.harness.key_press(Key::O);
    window.settle();
    let other = folder.path().join("other.toml");
    std::fs::write(&other, BALLS.replace("red", "green")).expect("a file");
    window.session().open(other);
    window.settle();
    assert_eq!(window.session().label(RED), "sphere 1 (green)");
}

#[test]
fn escape_in_a_field_leaves_only_the_field() {
    let (_folder, path) = file();
    let mut window = open(&path, "64x48");
    window.session().selection = Some(RED);
    window.session().tool = Tool::Move;
    window.settle();
    for field in ["Search the outline", "Radius"] {
        window.harness.get_by_label(field).focus();
        window.harness.run_steps(3);
        window.harness.key_press(Key::Escape);
        window.settle();
        assert_eq!(window.session().tool, Tool::Move, "{field}");
        assert_eq!(window.session().selection, Some(RED), "{field}");
    }
    window.harness.key_press(Key::Escape);
    window.settle();
    assert_eq!(window.session().tool, Tool::Select);
}

#[test]
fn escape_closes_a_menu_and_nothing_else() {
    let (_folder, path) = file();
    let mut window = open(&path, "64x48");
    window.session().selection = Some(RED);
    window.settle();
    window.harness.get_by_label("View").click();
    window.settle();
    let is_open = |window: &Window| {
        window
            .harness
            .query_by_label_contains("Frame all")
            .is_some()
    };
    assert!(is_open(&window), "there is no menu");
    window.harness.key_press(Key::Escape);
    window.settle();
    assert!(!is_open(&window), "the menu stays");
    assert_eq!(window.session().selection, Some(RED));
}

#[test]
fn a_key_renames_what_is_selected() {
    let (_folder, path) = file();
    let mut window = open(&path, "64x48");
    let red = Id::Material(0);
    assert_eq!(window.session().label(red), "red");
    window.session().selection = Some(red);
    window.settle();
    window.harness.key_press(Key::O);
    window.settle();
    assert!(
        window
            .harness
            .query_by_label("Search the outline")
            .is_none()
    );
    window.harness.key_press(Key::F2);
    window.settle();
    window
        .harness
        .get_by_label("New name")
        .set_text_value_accesskit("apple");
    window.harness.step();
    window.harness.key_press(Key::Enter);
    window.settle();
    assert_eq!(window.session().label(red), "apple");

    // The field starts with what something without a name is called.
    window.session().selection = Some(RED);
    window.harness.key_press(Key::F2);
    window.settle();
    let field = window.harness.get_by_label("New name");
    assert_eq!(field.accesskit_node().value().as_deref(), Some("sphere 1"));
    field.set_text_value_accesskit("ball");
    window.harness.step();
    window.harness.key_press(Key::Enter);
    window.settle();
    assert_eq!(window.session().label(RED), "ball (apple)");
}

#[test]
fn no_key_but_escape_goes_past_a_question() {
    let (_folder, path) = file();
    let mut window = open(&path, "64x48");
    window.session().selection = Some(RED);
    window.settle();
    let before = scene(&window);
    type Question = (&'static str, fn(&mut Window));
    let questions: [Question; 4] = [
        ("unsaved", |window| {
            window.session().files.undecided = Some(Intent::Close);
        }),
        ("path", |window| {
            window.session().files.typed = Some(String::new());
        }),
        ("picture", |window| window.harness.key_press(Key::F12)),
        ("scene", |window| {
            saving::ask(&mut window.session());
        }),
    ];
    for (name, ask) in questions {
        ask(&mut window);
        window.harness.run_steps(3);
        for key in [Key::Delete, Key::F1, Key::V, Key::F12] {
            window.harness.key_press(key);
            window.harness.run_steps(2);
        }
        assert_eq!(scene(&window), before, "{name}");
        assert!(
            !window.session().dialogs.is_open(Dialog::Shortcuts),
            "{name}"
        );
        window.harness.key_press(Key::Escape);
        window.settle();
        let session = window.session();
        let files = &session.files;
        assert!(files.undecided.is_none() && files.typed.is_none(), "{name}");
        assert!(
            files.saving.is_none() && !session.editing.is_asking(),
            "{name}"
        );
        assert_eq!(session.selection, Some(RED), "{name}");
    }
}

/// A ball of glass, a spot light and a camera with a lens.
const FIELDS: &str = r#"
[camera]
look_from = [0, 0, 8]
look_at = [0, 0, 0]
fov_y_deg = 30
lens = { radius = 0.1, focus_distance = 8, blades = 6 }

[[lights]]
spot = { position = [3, 4, 5], look_at = [0, 0, 0], outer_deg = 30, color = [0.9, 0.9, 0.9] }

[[lights]]
sphere = { center = [0, 5, 0], radius = 1, color = [0.9, 0.9, 0.9], radiance = 1 }

[materials]
glass = { optics = { transmit = [0.5, 0.5, 0.5], ior = 1.5 } }

[[objects]]
sphere = { center = [0, 0, 0], radius = 0.75 }
material = "glass"
"#;

#[test]
fn what_fields_take_can_be_saved_and_opened_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("fields.toml");
    std::fs::write(&path, FIELDS).expect("a file");
    let mut window = open(&path, "64x48");
    let light = |index| Id::Object(ObjectRef::Light(index));
    let fields = [
        (
            Id::Material(0),
            &[
                "Shininess",
                "Index (ior)",
                "Opacity",
                "Priority",
                "Reflect red",
                "Transmit red",
                "Absorption red",
            ][..],
        ),
        (light(0), &["Intensity", "Inner angle", "Outer angle"]),
        (light(1), &["Radius"]),
        (
            Id::Camera(0),
            &["Field of view", "Radius", "Focus", "Blades"],
        ),
        (RED, &["Radius"]),
    ];
    let saved = folder.path().join("saved.toml");
    for most in [-1e30, 1e30] {
        for (id, names) in fields {
            window.session().selection = Some(id);
            window.settle();
            for name in names {
                set(&mut window, name, most);
                let scene = scene(&window);
                scene_file::save(&saved, &scene, true).expect("a file");
                let read = glimray::import::load(&saved);
                assert!(read.is_ok(), "{name} at {most:e}: {:?}", read.err());
            }
        }
    }
}

#[test]
fn no_camera_is_without_an_up() {
    let (_folder, path) = file();
    let text = BALLS.replace("look_at = [0, 0, 0]", "look_at = \"target\"");
    let text = text.replace(
        "radius = 0.75 }\nmaterial = \"red\"",
        "radius = 0.75 }\nname = \"target\"\nmaterial = \"red\"",
    );
    std::fs::write(&path, text).expect("a file");
    let mut window = open(&path, "64x48");
    window.session().selection = Some(Id::Camera(0));
    window.settle();
    set(&mut window, "Up y", 0.0);
    assert_eq!(scene(&window).cameras[0].up, DVec3::Y);
}

/// Labels of all lines of the outline.
fn labels(scene: &Scene) -> Vec<String> {
    let outline = glimray_viewer::model::outline::Outline::of(scene);
    outline
        .entries
        .into_iter()
        .map(|entry| entry.label)
        .collect()
}

#[test]
fn saving_a_scene_and_reading_it_again_renames_nothing() {
    let mut scene = crate::reference::scenes::meshes();
    for mesh in &mut scene.meshes {
        std::sync::Arc::make_mut(mesh).name.clear();
    }
    // A mesh of two instances, so that numbers of meshes and of instances differ.
    let twice = scene.instances[0].clone();
    scene.instances.push(twice);
    let folder = tempfile::tempdir().expect("a folder");
    for turn in ["once.toml", "twice.toml"] {
        let path = folder.path().join(turn);
        scene_file::save(&path, &scene, false).expect("a file");
        let read = glimray::import::load(&path).expect("a scene");
        assert_eq!(labels(&read), labels(&scene), "{turn}");
        scene = read;
    }
}

#[test]
fn showing_all_of_a_scene_leaves_lamps_aside_unless_there_is_nothing_else() {
    let folder = tempfile::tempdir().expect("a folder");
    let lamp = "\n[materials.lamp]\nemission = [8, 8, 8]\n\n[[objects]]\n\
                rectangle = { center = [-40, 60, 5], normal = [0, -1, 0], size = [3, 3] }\n\
                material = \"lamp\"\n";
    let all = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).expect("a file");
        let mut window = open(&path, "64x48");
        window
            .harness
            .key_press_modifiers(eframe::egui::Modifiers::SHIFT, Key::F);
        window.settle();
        window.camera()
    };
    let lit = all("lit.toml", &format!("{BALLS}{lamp}"));
    assert_eq!(lit, all("balls.toml", BALLS));
    let (camera, _) = BALLS.split_once("[materials]").expect("materials");
    let alone = all("lamp.toml", &format!("{camera}{lamp}"));
    assert!(
        alone.look_at.distance(dvec3(-40.0, 60.0, 5.0)) < 1e-6,
        "{alone:?}"
    );
}

#[test]
fn undo_and_redo_name_their_step_in_the_menu_and_are_grey_without_one() {
    let (_folder, path) = file();
    let mut window = open(&path, "64x48");
    let entry = |window: &mut Window, label: &str| {
        window.harness.get_by_label("Edit").click();
        window.harness.run_steps(3);
        // The button of the panel is called the same.
        let is_enabled = (window.harness.get_all_by_label_contains(label))
            .any(|node| !node.accesskit_node().is_disabled());
        window.harness.key_press(Key::Escape);
        window.harness.run_steps(3);
        is_enabled
    };
    assert!(!entry(&mut window, "Undo"));
    assert!(!entry(&mut window, "Redo"));
    window.session().selection = Some(RED);
    perform(&mut window, Action::Delete);
    assert!(entry(&mut window, "Undo delete sphere 1 (red)"));
    assert!(!entry(&mut window, "Redo"));
    perform(&mut window, Action::Undo);
    assert!(!entry(&mut window, "Undo"));
    assert!(entry(&mut window, "Redo delete sphere 1 (red)"));
}

#[test]
fn ambient_follows_diffuse_until_it_is_unlinked() {
    let (_folder, path) = file();
    let mut window = open(&path, "64x48");
    window.session().selection = Some(Id::Material(0));
    window.settle();
    let colors = |window: &Window| {
        let material = &scene(window).materials[0];
        (
            material.classical().diffuse.y,
            material.classical().ambient.y,
        )
    };
    let follows = "Ambient follows diffuse";
    assert!(window.harness.query_by_label("Ambient green").is_none());
    set(&mut window, "Diffuse green", 0.5);
    assert_eq!(colors(&window), (0.5, 0.5));
    window.harness.get_by_label(follows).click_accesskit();
    window.settle();
    set(&mut window, "Diffuse green", 0.25);
    assert_eq!(colors(&window), (0.25, 0.5));
    set(&mut window, "Ambient green", 0.75);
    assert_eq!(colors(&window), (0.25, 0.75));
    window.harness.get_by_label(follows).click_accesskit();
    window.settle();
    assert_eq!(colors(&window), (0.25, 0.25));
}

#[test]
fn a_uniform_scale_keeps_the_ratios_of_its_factors() {
    let (_folder, path) = file();
    let mut window = open(&path, "64x48");
    // A sphere has a radius instead; with other proportions it is an ellipsoid.
    let stretched = DAffine3::from_scale(dvec3(0.5, 0.75, 0.75));
    window.session().edit("stretch", |scene| {
        objects::set_place(scene, RED, stretched, 0.0).expect("it can be stretched");
    });
    window.session().selection = Some(RED);
    window.settle();
    let scale = |window: &Window| {
        let place = objects::place(&scene(window), RED, 0.0).expect("a place");
        place.to_scale_rotation_translation().0
    };
    let before = scale(&window);
    set(&mut window, "Scale x", before.x * 2.0);
    let uneven = scale(&window);
    assert!(
        uneven.distance(before * dvec3(2.0, 1.0, 1.0)) < 1e-9,
        "{uneven}"
    );
    window
        .harness
        .get_by_label("Uniform scale")
        .click_accesskit();
    window.settle();
    set(&mut window, "Scale y", before.y * 3.0);
    let even = scale(&window);
    assert!(even.distance(uneven * 3.0) < 1e-9, "{even}");
}

#[test]
fn the_dialogs_for_scene_and_picture_both_show_the_folder_browse_and_cancel() {
    let (folder, path) = file();
    let mut window = open(&path, "64x48");
    let chosen = folder.path().join("chosen.toml");
    let answer = chosen.clone();
    window.session().files.dialogs = FileDialogs::answering(move |request| {
        assert!(request.saves);
        Reply::Chosen(answer.clone())
    });
    let shown = format!("Folder: {}", folder.path().display());
    for action in [Action::SaveSceneAs, Action::SavePicture] {
        perform(&mut window, action);
        let is_open = |window: &Window| {
            let session = window.session();
            session.editing.is_asking() || session.files.saving.is_some()
        };
        assert!(is_open(&window), "{action:?}");
        window.harness.get_by_label(&shown);
        window.harness.get_by_label("Browse…");
        window.harness.get_by_label("Cancel").click();
        window.settle();
        assert!(!is_open(&window), "{action:?}");
    }
    perform(&mut window, Action::SaveSceneAs);
    window.harness.get_by_label("Browse…").click();
    window.settle();
    window.harness.get_by_label("Save").click();
    window.settle();
    assert!(chosen.exists());
}
