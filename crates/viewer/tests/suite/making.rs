//! Making a scene by hand: new scenes, things that are added, and several that are moved as one. Only keys and the mouse.

mod many;
mod walk;

use super::edit::{BLUE, RED, file, on_screen, open, perform, scene};
use super::focus::{click_at, type_text};
use crate::harness::Window;
use eframe::egui::{Key, Modifiers, PointerButton, Pos2, Role, vec2};
use egui_kittest::kittest::{NodeT, Queryable};
use glam::{DVec3, dvec3};
use glimray::import;
use glimray::render::{Integrator, Tone};
use glimray::scene::{Background, Geometry, LightKind, ObjectRef, Origin, Scene};
use glimray_viewer::actions::{adding, files};
use glimray_viewer::model::bindings::{Action, Preset};
use glimray_viewer::model::objects::{self, Id};
use glimray_viewer::state::files::Intent;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// A new scene in a window of a small picture.
pub(super) fn new_scene() -> (tempfile::TempDir, Window) {
    let (folder, path) = file();
    let mut window = open(&path, "160x120");
    window
        .harness
        .key_press_modifiers(Modifiers::COMMAND, Key::N);
    window.settle();
    (folder, window)
}

pub(super) fn press(window: &mut Window, modifiers: Modifiers, key: Key) {
    window.harness.key_press_modifiers(modifiers, key);
    window.harness.run_steps(3);
}

/// Clicks the row of the outline that is called so.
pub(super) fn click_row(window: &mut Window, label: &str) {
    click_which(window, label, true);
}

/// Clicks the button that is called so.
pub(super) fn click(window: &mut Window, label: &str) {
    click_which(window, label, false);
}

/// Rows of the outline are selected or not; other buttons are neither.
fn click_which(window: &mut Window, label: &str, is_row: bool) {
    let pos = {
        let mut nodes = window.harness.get_all_by_label(label);
        let is_it = |node: &egui_kittest::Node| {
            let node = node.accesskit_node();
            node.role() == Role::Button && node.toggled().is_some() == is_row
        };
        nodes.find(is_it).expect("a widget").rect().center()
    };
    click_at(window, pos, PointerButton::Primary);
}

/// Clicks what is called so with Ctrl, which adds it to the selection.
pub(super) fn also(window: &mut Window, label: &str) {
    let node = window.harness.get_by_label(label);
    node.click_modifiers(Modifiers::COMMAND);
    window.settle();
}

/// Chooses in a menu of the menu bar.
pub(super) fn choose(window: &mut Window, menu: &str, entry: &str) {
    click(window, menu);
    window.harness.run_steps(3);
    click(window, entry);
}

pub(super) fn middle(window: &Window) -> Pos2 {
    window.session().viewport.expect("a picture").rect.center()
}

pub(super) fn undo_count(window: &Window) -> usize {
    let session = window.session();
    session.document.as_ref().expect("a document").undo_count()
}

fn selected(window: &Window) -> Vec<Id> {
    window.session().selected()
}

fn has_message(window: &Window, text: &str) -> bool {
    let messages = window.session().messages.current();
    messages.iter().any(|message| message.text.contains(text))
}

#[track_caller]
fn assert_new(scene: &Scene) {
    assert_eq!((scene.shapes.len(), scene.instances.len()), (0, 0));
    assert!(scene.lights.is_empty());
    assert_eq!(scene.cameras.len(), 1);
    let Background::Picture { picture, .. } = scene.background else {
        panic!("there is no sky");
    };
    let origin = &scene.pictures[picture].origin;
    assert!(matches!(origin, Origin::Sky { .. }), "{origin:?}");
}

#[test]
fn a_new_scene_is_a_sky_without_a_file_and_asks_for_changes_first() {
    let (folder, mut window) = new_scene();
    assert_new(&scene(&window));
    {
        let session = window.session();
        assert_eq!(
            (session.title(), &session.path),
            ("untitled".to_owned(), &None)
        );
        assert!(!session.has_changes());
    }
    let image = window.image(Tone::LINEAR);
    let is_lit = |pixel: &[f32; 4]| pixel[..3].iter().any(|channel| *channel > 0.0);
    assert!(image.pixels.iter().all(is_lit), "the sky is black");
    choose(&mut window, "Add", "Sphere");
    press(&mut window, Modifiers::NONE, Key::Enter);
    assert_eq!(scene(&window).shapes.len(), 1);
    // Files of the scene before are nothing to this one.
    let before = folder.path().join("balls.toml");
    std::fs::write(before, "ambient = [1, 1, 1]").expect("a file");
    window.settle();
    assert_eq!(scene(&window).shapes.len(), 1);
    choose(&mut window, "File", "New Ctrl+N");
    assert_eq!(scene(&window).shapes.len(), 1, "it did not ask");
    click(&mut window, "New without saving");
    window.settle();
    assert_new(&scene(&window));
    assert_eq!(undo_count(&window), 0);
}

#[test]
fn an_empty_file_is_opened_as_a_new_scene_but_not_read_again_as_one() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("mine.toml");
    for text in ["", "\n  \n"] {
        std::fs::write(&path, text).expect("a file");
        let mut window = open(&path, "64x48");
        assert_new(&scene(&window));
        assert_eq!(window.session().title(), "mine.toml");
        choose(&mut window, "Add", "Box");
        press(&mut window, Modifiers::NONE, Key::Enter);
        press(&mut window, Modifiers::NONE, Key::F5);
        click(&mut window, "Reload");
        window.settle();
        assert_eq!(scene(&window).shapes.len(), 1, "the last scene stays");
        let session = window.session();
        let broken = session.files.broken.as_ref().expect("an error");
        assert!(broken.trouble.message.contains("the file is empty"));
    }
    // For everything else it stays an error.
    import::load(&path).expect_err("an empty file");
}

/// The title of everything that can be added but a model.
const ADDITIONS: [&str; 17] = [
    "Sphere",
    "Box",
    "Cylinder",
    "Cone",
    "Torus",
    "Ellipsoid",
    "Plane",
    "Rectangle",
    "Disc",
    "Triangle",
    "Point light",
    "Directional light",
    "Spot light",
    "Rectangle light",
    "Disc light",
    "Sphere light",
    "Camera",
];

pub(super) fn save_as(window: &mut Window, path: &Path) {
    press(window, Modifiers::COMMAND | Modifiers::SHIFT, Key::S);
    press(window, Modifiers::COMMAND, Key::A);
    type_text(window, path.to_str().expect("a path in UTF-8"));
    press(window, Modifiers::NONE, Key::Enter);
    window.settle();
    assert!(path.exists(), "it is not saved");
}

#[test]
fn everything_can_be_added_with_a_name_and_comes_back_from_a_file() {
    let (folder, mut window) = new_scene();
    let empty = scene(&window);
    for (count, title) in (1..).zip(ADDITIONS) {
        choose(&mut window, "Add", title);
        press(&mut window, Modifiers::NONE, Key::Enter);
        window.settle();
        let scene = scene(&window);
        let [id] = selected(&window)[..] else {
            panic!("{title} is not selected");
        };
        assert_eq!(objects::name(&scene, id), Some(title));
        assert_eq!(undo_count(&window), count, "{title}");
        assert_eq!(window.session().label(id), title);
    }
    let made = scene(&window);
    assert_eq!((made.shapes.len(), made.instances.len()), (9, 1));
    assert_eq!((made.lights.len(), made.cameras.len()), (6, 2));
    // Each surface has a material of its own, with its name, and so has the scene from before.
    let names: Vec<_> = made.materials.iter().map(|it| it.name.as_str()).collect();
    assert_eq!(names[1..], ADDITIONS[..10]);
    choose(&mut window, "Add", "Sphere");
    press(&mut window, Modifiers::NONE, Key::Enter);
    assert_eq!(scene(&window).shapes[9].name, "Sphere 2");
    press(&mut window, Modifiers::COMMAND, Key::Z);
    let path = folder.path().join("all.toml");
    save_as(&mut window, &path);
    let read = import::load(&path).expect("a scene");
    let names = |scene: &Scene| -> Vec<String> {
        let shapes = scene.shapes.iter().map(|it| it.name.clone());
        let instances = scene.instances.iter().map(|it| it.name.clone());
        let lights = scene.lights.iter().map(|it| it.name.clone());
        let cameras = scene.cameras.iter().map(|it| it.name.clone());
        shapes
            .chain(instances)
            .chain(lights)
            .chain(cameras)
            .collect()
    };
    assert_eq!(names(&read), names(&made));
    assert_eq!(read.lights, made.lights);
    let geometry = |scene: &Scene| -> Vec<Geometry> {
        scene.shapes.iter().map(|shape| shape.geometry).collect()
    };
    assert_eq!(geometry(&read), geometry(&made));
    for _ in ADDITIONS {
        press(&mut window, Modifiers::COMMAND, Key::Z);
    }
    assert!(scene(&window) == empty);
}

#[test]
fn what_is_added_at_the_cursor_follows_it_and_is_one_step() {
    let (_folder, mut window) = new_scene();
    let at = middle(&window) + vec2(-40.0, -30.0);
    window.harness.hover_at(at);
    window.harness.step();
    press(&mut window, Modifiers::SHIFT, Key::A);
    let entry = window.harness.get_by_label("Sphere").rect();
    assert!(
        entry.left() - at.x < 20.0,
        "the menu is at {entry:?}, not at {at:?}"
    );
    click(&mut window, "Sphere");
    let start = scene(&window).shapes[0].geometry;
    let pivot = DVec3::ZERO;
    assert_eq!(
        start,
        Geometry::Sphere {
            center: pivot,
            radius: 1.0
        }
    );
    let entered = middle(&window);
    window.harness.hover_at(entered);
    window.harness.run_steps(2);
    let to = entered + vec2(40.0, 20.0);
    window.harness.hover_at(to);
    window.harness.run_steps(2);
    click_at(&mut window, to, PointerButton::Primary);
    window.settle();
    let Geometry::Sphere { center, radius } = scene(&window).shapes[0].geometry else {
        panic!("a sphere stays one");
    };
    assert_eq!(radius, 1.0);
    let moved = on_screen(&window, center) - on_screen(&window, pivot);
    // The pointer was above the entry of the menu first, from where the way counts.
    assert!(moved.length() > 20.0, "it moved by {moved}");
    assert_eq!((undo_count(&window), selected(&window).len()), (1, 1));
    assert!(window.session().editing.modal.is_none());
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(scene(&window).shapes.len(), 0, "it is more than one step");
}

#[test]
fn escape_and_a_right_click_leave_what_was_added_where_it_was() {
    let (_folder, mut window) = new_scene();
    for (count, ends_by_key) in [(1, true), (2, false)] {
        choose(&mut window, "Add", "Cylinder");
        let before = scene(&window);
        let entered = middle(&window);
        window.harness.hover_at(entered);
        window.harness.run_steps(2);
        let to = entered + vec2(50.0, 0.0);
        window.harness.hover_at(to);
        window.harness.run_steps(2);
        assert!(scene(&window) != before, "it does not follow");
        match ends_by_key {
            true => press(&mut window, Modifiers::NONE, Key::Escape),
            false => click_at(&mut window, to, PointerButton::Secondary),
        }
        window.settle();
        assert!(scene(&window) == before, "by a key: {ends_by_key}");
        assert_eq!((before.shapes.len(), undo_count(&window)), (count, count));
    }
}

#[test]
fn a_flight_to_the_left_opens_no_menu() {
    let (_folder, mut window) = new_scene();
    window.harness.hover_at(middle(&window));
    let is_open = |window: &Window| window.harness.query_by_label("Ellipsoid").is_some();
    window.harness.key_down(Key::W);
    window.harness.run_steps(3);
    press(&mut window, Modifiers::SHIFT, Key::A);
    assert!(!is_open(&window));
    window.harness.key_up(Key::W);
    window.settle();
    let before = window.camera();
    press(&mut window, Modifiers::SHIFT, Key::A);
    assert!(is_open(&window));
    window.settle();
    assert_eq!(window.camera(), before, "it flew");
    press(&mut window, Modifiers::NONE, Key::Escape);
    window.settle();
    assert!(!is_open(&window));
}

#[test]
fn a_model_from_a_file_stands_where_a_plane_would_be() {
    let (folder, mut window) = new_scene();
    let text = "v 0 0 0\nv 300 0 0\nv 0 400 0\nf 1 2 3\n";
    let path = folder.path().join("sail.obj");
    std::fs::write(&path, text).expect("a file");
    choose(&mut window, "Add", "Plane");
    press(&mut window, Modifiers::NONE, Key::Enter);
    let lights = scene(&window).lights.len();
    window.session().files.typed_model = Some(String::new());
    window.harness.run_steps(2);
    type_text(&mut window, path.to_str().expect("a path in UTF-8"));
    press(&mut window, Modifiers::NONE, Key::Enter);
    window.settle();
    press(&mut window, Modifiers::NONE, Key::Enter);
    let made = scene(&window);
    assert_eq!((made.instances.len(), made.lights.len()), (1, lights));
    let [id @ Id::Node(node)] = selected(&window)[..] else {
        panic!("the model's node is not selected");
    };
    assert_eq!(made.nodes[node].name, "sail");
    let (min, max) = objects::bounds(&made, id, 0.0).expect("bounds");
    // 400 of the file become 2: as high as the sphere, on the same ground, and in the middle.
    assert!(
        (max - min).abs_diff_eq(dvec3(1.5, 2.0, 0.0), 1e-6),
        "{}",
        max - min
    );
    assert!(min.midpoint(max).abs_diff_eq(DVec3::ZERO, 1e-6));
    let Geometry::Plane { point, .. } = made.shapes[0].geometry else {
        panic!("not a plane");
    };
    assert_eq!(point.y, -1.0);
    assert_eq!(undo_count(&window), 2);
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert!(scene(&window).nodes.is_empty());
}

/// A model of one triangle in a file.
fn sail(folder: &Path) -> PathBuf {
    let path = folder.join("sail.obj");
    std::fs::write(&path, "v 0 0 0\nv 3 0 0\nv 0 4 0\nf 1 2 3\n").expect("a file");
    path
}

#[test]
fn a_model_that_is_read_while_something_is_moved_waits_for_that() {
    let (folder, mut window) = new_scene();
    choose(&mut window, "Add", "Plane");
    window.harness.run_steps(3);
    assert!(window.session().editing.modal.is_some());
    adding::add_model(&mut window.session(), sail(folder.path()));
    for _ in 0..40 {
        window.harness.step();
        std::thread::sleep(Duration::from_millis(5));
    }
    let is_added = |window: &Window| !scene(window).nodes.is_empty();
    assert_eq!((is_added(&window), undo_count(&window)), (false, 1));
    press(&mut window, Modifiers::NONE, Key::Enter);
    window.settle();
    assert_eq!((is_added(&window), undo_count(&window)), (true, 2));
    assert!(window.session().editing.modal.is_some(), "it is not placed");
}

#[test]
fn a_model_that_is_read_while_a_name_is_typed_takes_no_keys() {
    let (folder, path) = file();
    let mut window = open(&path, "64x48");
    window.session().files.typed = Some(String::new());
    window.harness.run_steps(3);
    adding::add_model(&mut window.session(), sail(folder.path()));
    window.settle();
    assert!(!scene(&window).nodes.is_empty(), "it is not added");
    assert!(window.session().editing.modal.is_none());
}

#[test]
fn a_model_that_is_read_when_another_scene_is_shown_is_not_added_there() {
    let (folder, path) = file();
    let mut window = open(&path, "64x48");
    {
        let mut session = window.session();
        adding::add_model(&mut session, sail(folder.path()));
        files::go_on(&mut session, Intent::New);
    }
    window.settle();
    assert_eq!(window.session().title(), "untitled");
    assert_eq!((scene(&window).nodes.len(), undo_count(&window)), (0, 0));
}

#[test]
fn a_copy_follows_the_pointer_and_the_click_that_places_it_selects_nothing_else() {
    let (_folder, path) = file();
    let mut window = open(&path, "400x300");
    window
        .session()
        .preferences
        .bindings
        .set_preset(Preset::Blender);
    let before = scene(&window);
    let red = on_screen(&window, dvec3(-1.0, 0.0, 0.0));
    click_at(&mut window, red, PointerButton::Primary);
    window.settle();
    assert_eq!(selected(&window), [RED]);
    press(&mut window, Modifiers::SHIFT, Key::D);
    // Onto the other ball.
    let blue = on_screen(&window, dvec3(1.0, 0.0, 0.0));
    window.harness.hover_at(blue);
    window.harness.run_steps(2);
    click_at(&mut window, blue, PointerButton::Primary);
    window.settle();
    let copy = Id::Object(ObjectRef::Shape(2));
    assert_eq!(selected(&window), [copy]);
    let Geometry::Sphere { center, .. } = scene(&window).shapes[2].geometry else {
        panic!("a copy is a sphere");
    };
    assert!(center.distance(dvec3(1.0, 0.0, 0.0)) < 0.02, "{center}");
    press(&mut window, Modifiers::NONE, Key::X);
    assert!(scene(&window) == before, "another thing is deleted");
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(selected(&window), [copy], "what came back is not selected");
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(
        scene(&window),
        before,
        "copying and moving are more than one step"
    );
}

pub(super) fn center_of(scene: &Scene, shape: usize) -> DVec3 {
    match scene.shapes[shape].geometry {
        Geometry::Sphere { center, .. } => center,
        _ => panic!("not a sphere"),
    }
}

#[test]
fn all_that_is_selected_is_moved_turned_and_scaled_about_its_middle() {
    let (_folder, path) = file();
    let mut window = open(&path, "400x300");
    window
        .session()
        .preferences
        .bindings
        .set_preset(Preset::Blender);
    let before = scene(&window);
    click_row(&mut window, "sphere 1 (red)");
    also(&mut window, "sphere 2 (blue)");
    also(&mut window, "point light 1");
    let all = [RED, BLUE, Id::Object(ObjectRef::Light(0))];
    let mut now = selected(&window);
    now.sort_unstable();
    assert_eq!(now.len(), 3);
    let keys = |window: &mut Window, keys: &[Key]| {
        window.harness.hover_at(middle(window));
        window.harness.step();
        keys.iter()
            .for_each(|key| press(window, Modifiers::NONE, *key));
        window.settle();
    };
    keys(&mut window, &[Key::G, Key::Y, Key::Num2, Key::Enter]);
    let moved = scene(&window);
    for shape in 0..2 {
        let way = center_of(&moved, shape) - center_of(&before, shape);
        assert!(way.abs_diff_eq(dvec3(0.0, 2.0, 0.0), 1e-9), "{way}");
    }
    let LightKind::Point { position } = moved.lights[0].kind else {
        panic!("not a point light");
    };
    assert!(position.abs_diff_eq(dvec3(3.0, 6.0, 5.0), 1e-9));
    assert_eq!(undo_count(&window), 1);
    let name = window
        .session()
        .document
        .as_ref()
        .expect("a document")
        .undo_name()
        .map(str::to_owned);
    assert_eq!(name.as_deref(), Some("move 3 items"));
    assert_eq!(selected(&window).len(), 3, "the selection shrank");
    // The middle of the three: (1, 10/3, 5/3). A half turn about y takes x and z to the other side of it.
    keys(
        &mut window,
        &[Key::R, Key::Y, Key::Num1, Key::Num8, Key::Num0, Key::Enter],
    );
    let turned = scene(&window);
    assert!(center_of(&turned, 0).abs_diff_eq(dvec3(3.0, 2.0, 10.0 / 3.0), 1e-9));
    assert!(center_of(&turned, 1).abs_diff_eq(dvec3(1.0, 2.0, 10.0 / 3.0), 1e-9));
    keys(&mut window, &[Key::S, Key::Num2, Key::Enter]);
    let scaled = scene(&window);
    let middle = dvec3(1.0, 10.0 / 3.0, 5.0 / 3.0);
    for shape in 0..2 {
        let (far, near) = (
            center_of(&scaled, shape) - middle,
            center_of(&turned, shape) - middle,
        );
        assert!(
            far.abs_diff_eq(2.0 * near, 1e-9),
            "{far} is not twice {near}"
        );
        assert!(matches!(
            scaled.shapes[shape].geometry,
            Geometry::Sphere { radius: 1.5, .. }
        ));
    }
    assert_eq!(
        (undo_count(&window), selected(&window).len()),
        (3, all.len())
    );
    for _ in 0..3 {
        press(&mut window, Modifiers::COMMAND, Key::Z);
    }
    assert!(scene(&window) == before);
}

#[test]
fn the_handle_of_several_is_in_their_middle_and_each_has_its_box() {
    let (_folder, path) = file();
    let mut window = open(&path, "400x300");
    press(&mut window, Modifiers::COMMAND, Key::A);
    assert_eq!(selected(&window).len(), 3);
    click_row(&mut window, "sphere 1 (red)");
    also(&mut window, "sphere 2 (blue)");
    press(&mut window, Modifiers::NONE, Key::G);
    window.settle();
    let before = scene(&window);
    // Between the balls there is nothing but the handle.
    let grip = on_screen(&window, DVec3::ZERO) + vec2(0.0, -60.0);
    window.harness.hover_at(grip);
    window.harness.step();
    window.harness.drag_at(grip);
    window.harness.step();
    for up in [20.0, 40.0] {
        window.harness.hover_at(grip - vec2(0.0, up));
        window.harness.step();
    }
    window.harness.drop_at(grip - vec2(0.0, 40.0));
    window.settle();
    let after = scene(&window);
    let pixel = 2.0 * 8.0 * 15_f64.to_radians().tan() / 300.0;
    for shape in 0..2 {
        let way = center_of(&after, shape) - center_of(&before, shape);
        assert!(
            way.abs_diff_eq(dvec3(0.0, 40.0 * pixel, 0.0), 1e-3),
            "{way}"
        );
    }
}

#[test]
fn several_that_were_left_are_not_selected_again_with_one_of_them() {
    let (_folder, path) = file();
    let mut window = open(&path, "400x300");
    let both = |window: &mut Window| {
        click_row(window, "sphere 1 (red)");
        also(window, "sphere 2 (blue)");
        assert_eq!(selected(window), [BLUE, RED]);
    };
    let click_blue = |window: &mut Window| {
        let at = on_screen(window, dvec3(1.0, 0.0, 0.0));
        click_at(window, at, PointerButton::Primary);
        window.settle();
    };
    both(&mut window);
    click_blue(&mut window);
    assert_eq!(selected(&window), [BLUE], "by a click in the picture");
    both(&mut window);
    perform(&mut window, Action::SelectNothing);
    assert!(selected(&window).is_empty());
    click_blue(&mut window);
    assert_eq!(selected(&window), [BLUE], "after nothing was selected");
    both(&mut window);
    window.session().begin_rename();
    press(&mut window, Modifiers::COMMAND, Key::N);
    window.settle();
    let session = window.session();
    assert_eq!(session.title(), "untitled");
    assert_eq!(session.editing.group, None, "in another scene");
    assert_eq!(session.editing.renaming, None);
}

#[test]
fn a_focus_by_click_ends_when_its_camera_is_left() {
    let (_folder, path) = file();
    let mut window = open(&path, "64x48");
    {
        let mut session = window.session();
        session.selection = Some(Id::Camera(0));
        session.tool_state.focuses = Some(0);
    }
    window.settle();
    assert_eq!(window.session().tool_state.focuses, Some(0));
    click_row(&mut window, "sphere 1 (red)");
    window.settle();
    assert_eq!(window.session().tool_state.focuses, None);
}

#[test]
fn a_new_scene_is_not_taken_for_the_demo() {
    let (_folder, mut window) = new_scene();
    let bookmarks = |window: &Window| {
        let views = files::cameras::all(&window.session());
        views.iter().filter(|view| view.is_bookmark).count()
    };
    let is_told = |window: &Window, text: &str| {
        let session = window.session();
        let messages = session.messages.all();
        messages.iter().any(|message| message.text.contains(text))
    };
    perform(&mut window, Action::SaveCamera);
    assert_eq!(bookmarks(&window), 1);
    perform(&mut window, Action::CopyCamera);
    let text = "The new scene has no file yet. Save it first.";
    assert!(is_told(&window, text), "it is copied");
    perform(&mut window, Action::OpenNext);
    assert!(is_told(&window, "The new scene is not in a folder yet"));
    perform(&mut window, Action::SavePicture);
    let saving = window.session().files.saving.take();
    let name = saving.expect("a dialog").path;
    assert!(name.contains("untitled_"), "{name}");
    files::open_built_in(&mut window.session());
    window.settle();
    assert_eq!(bookmarks(&window), 0, "the demo has another's bookmark");
    press(&mut window, Modifiers::COMMAND, Key::N);
    window.settle();
    assert_eq!(bookmarks(&window), 0, "another new scene has it");
}

/// A ball without light.
const DARK: &str = "[camera]\nlook_from = [0, 0, 5]\nlook_at = [0, 0, 0]\n\n\
                    [[objects]]\nsphere = { center = [0, 0, 0], radius = 1 }\n";

/// The mean of the picture's brightest channels.
fn brightness(window: &mut Window) -> f32 {
    let image = window.image(Tone::LINEAR);
    let sum: f32 = (image.pixels.iter())
        .map(|pixel| pixel[0].max(pixel[1]).max(pixel[2]))
        .sum();
    sum / image.pixels.len() as f32
}

#[test]
fn a_scene_without_light_says_so_with_ways_out() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("dark.toml");
    std::fs::write(&path, DARK).expect("a file");
    // The words of `glimray render`.
    let warning = "The scene has no light, so its surfaces are black.";
    for (way, integrator) in [
        ("Add a light", Integrator::Whitted),
        ("Sky", Integrator::Path),
    ] {
        let mut window = open(&path, "64x48");
        assert!(has_message(&window, warning));
        assert_eq!(brightness(&mut window), 0.0);
        click(&mut window, way);
        window.settle();
        assert!(!has_message(&window, warning), "{way}: it is still said");
        assert!(brightness(&mut window) > 0.005, "{way}: it is still dark");
        let shown = window.session().view.settings.integrator;
        assert_eq!(shown, integrator);
        assert_eq!(undo_count(&window), 1);
        press(&mut window, Modifiers::COMMAND, Key::Z);
        window.settle();
        assert!(
            has_message(&window, warning),
            "{way}: without it, it is dark again"
        );
    }
    // A scene with light is not warned of.
    let (_folder, path) = file();
    let mut window = open(&path, "64x48");
    assert!(!has_message(&window, warning));
    // Nor is it before there is something to see.
    press(&mut window, Modifiers::COMMAND, Key::N);
    window.settle();
    assert!(!has_message(&window, "light"));
}

#[test]
fn each_scene_without_light_is_warned_of_once() {
    let folder = tempfile::tempdir().expect("a folder");
    let paths = ["one.toml", "two.toml"].map(|name| folder.path().join(name));
    for path in &paths {
        std::fs::write(path, DARK).expect("a file");
    }
    let warning = "The scene has no light, so its surfaces are black.";
    let dismiss = |window: &Window| {
        let messages = window.session().messages.current();
        let mut texts = messages.into_iter().map(|message| message.text);
        let text = texts.find(|text| text.contains(warning));
        (window.session().messages).dismiss(&text.expect("a warning"));
    };
    let mut window = open(&paths[0], "64x48");
    dismiss(&window);
    for path in &paths {
        files::open(&mut window.session(), vec![path.clone()]);
        window.settle();
        assert!(has_message(&window, warning), "{path:?}");
    }
    // Reloading a scene is no reason to repeat the warning.
    dismiss(&window);
    press(&mut window, Modifiers::NONE, Key::F5);
    window.settle();
    assert!(!has_message(&window, warning), "after reloading");
    files::open(&mut window.session(), vec![paths[0].clone()]);
    window.settle();
    assert!(has_message(&window, warning));
    press(&mut window, Modifiers::COMMAND, Key::N);
    window.settle();
    assert!(!has_message(&window, warning), "of a scene that was left");
}

#[test]
fn a_classical_picture_of_a_scene_under_its_sky_offers_path_tracing() {
    let (_folder, mut window) = new_scene();
    choose(&mut window, "Add", "Sphere");
    press(&mut window, Modifiers::NONE, Key::Enter);
    window.settle();
    let warning = "lit by its environment alone, which only path tracing sees";
    assert!(!has_message(&window, warning));
    press(&mut window, Modifiers::SHIFT, Key::Num1);
    window.settle();
    assert!(has_message(&window, warning));
    click(&mut window, "Path tracing");
    window.settle();
    let shown = window.session().view.settings.integrator;
    assert_eq!(shown, Integrator::Path);
    assert!(!has_message(&window, warning));
}

fn rename(window: &mut Window, name: &str) {
    press(window, Modifiers::NONE, Key::F2);
    press(window, Modifiers::COMMAND, Key::A);
    type_text(window, name);
    press(window, Modifiers::NONE, Key::Enter);
    window.settle();
}

#[test]
fn objects_and_lights_are_renamed_and_keep_their_names_in_a_file() {
    let (folder, path) = file();
    let mut window = open(&path, "64x48");
    for (label, name) in [("sphere 2 (blue)", "Sea"), ("point light 1", "Sun")] {
        click_row(&mut window, label);
        rename(&mut window, name);
    }
    for label in ["Sea (blue)", "Sun", "sphere 1 (red)"] {
        assert!(
            window.harness.query_all_by_label(label).count() > 0,
            "{label}"
        );
    }
    let other = folder.path().join("named.toml");
    save_as(&mut window, &other);
    let text = std::fs::read_to_string(&other).expect("a file");
    assert!(text.contains("name = \"Sea\""), "{text}");
    let read = import::load(&other).expect("a scene");
    assert_eq!(
        (read.shapes[1].name.as_str(), read.lights[0].name.as_str()),
        ("Sea", "Sun")
    );
    assert_eq!(read.shapes[0].name, "");
    // A name that is confirmed as it is changes nothing.
    let steps = undo_count(&window);
    click_row(&mut window, "sphere 1 (red)");
    press(&mut window, Modifiers::NONE, Key::F2);
    press(&mut window, Modifiers::NONE, Key::Enter);
    window.settle();
    assert_eq!(undo_count(&window), steps);
}

#[test]
fn the_numbers_of_others_stay_when_something_is_deleted() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("row.toml");
    let ball =
        |x: usize| format!("[[objects]]\nsphere = {{ center = [{x}, 0, 0], radius = 0.4 }}\n");
    let balls: String = (0..4).map(ball).collect();
    std::fs::write(&path, format!("ambient = [1, 1, 1]\n{balls}")).expect("a file");
    let mut window = open(&path, "64x48");
    let label = |number: usize| format!("sphere {number} (material 1)");
    for number in [1, 3] {
        click_row(&mut window, &label(number));
        press(&mut window, Modifiers::NONE, Key::Delete);
        window.settle();
    }
    for number in 1..=4 {
        let is_there = window.harness.query_all_by_label(&label(number)).count() > 0;
        assert_eq!(is_there, number % 2 == 0, "{number}");
    }
    for (number, x) in [(2, 1.0), (4, 3.0)] {
        click_row(&mut window, &label(number));
        let [Id::Object(ObjectRef::Shape(index))] = selected(&window)[..] else {
            panic!("not a shape");
        };
        assert_eq!(center_of(&scene(&window), index).x, x);
    }
}
