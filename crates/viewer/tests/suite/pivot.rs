//! The point that the camera turns around, and views along an axis.

use crate::harness::Window;
use eframe::egui::{self, Key, Modifiers, PointerButton};
use glam::{DVec2, DVec3, dvec3};
use glimray::scene::{Camera, LightKind};
use glimray_viewer::model::camera::ray_through;

/// A file of the course names no point to look at.
const ROOM: &str = "assets/scenes/spheres_and_triangles.scene";
/// The wall in the middle of its picture.
const WALL: f64 = -12.0;

fn open(arguments: &[&str]) -> Window {
    let size = ["--samples", "2"];
    let mut window = Window::open(&[arguments, &size].concat());
    window.settle();
    window
}

fn press(window: &mut Window, key: Key) {
    window.harness.key_press(key);
    window.settle();
}

fn pivot(window: &Window) -> DVec3 {
    window.session().controller.as_ref().expect("a rig").pivot()
}

/// A drag of the left button from the middle of the picture.
fn drag(window: &mut Window, by: egui::Vec2) {
    let middle = window.session().viewport.expect("a picture").rect.center();
    window.harness.hover_at(middle);
    window.harness.step();
    for (pos, pressed) in [(middle, true), (middle + by, false)] {
        window.harness.hover_at(pos);
        window.harness.step();
        window.harness.event(egui::Event::PointerButton {
            pos,
            button: PointerButton::Primary,
            pressed,
            modifiers: Modifiers::NONE,
        });
        window.harness.step();
    }
    window.settle();
}

/// Where a point is in a picture of height 1 around its middle, by the textbook.
fn seen(camera: &Camera, point: DVec3) -> DVec2 {
    let forward = (camera.look_at - camera.look_from).normalize();
    let right = forward.cross(camera.up).normalize();
    let q = point - camera.look_from;
    let height = match camera.orthographic_height {
        Some(height) => height,
        None => 2.0 * q.dot(forward) * (camera.fov_y / 2.0).tan(),
    };
    DVec2::new(q.dot(right), q.dot(right.cross(forward))) / height
}

#[test]
fn a_camera_without_a_point_to_look_at_turns_round_the_middle_of_its_picture() {
    let mut window = open(&[ROOM]);
    let start = window.camera();
    assert_eq!(start, Camera::default(), "the picture is the file's");
    let hit = pivot(&window);
    assert_eq!((hit.x, hit.y), (0.0, 0.0));
    assert!((hit.z - WALL).abs() < 1e-3, "not at the wall: {hit}");
    drag(&mut window, egui::vec2(120.0, 0.0));
    let turned = window.camera();
    assert_ne!(turned, start);
    assert!(
        seen(&turned, hit).length() < 1e-6,
        "the wall left the middle"
    );
    press(&mut window, Key::Home);
    assert_eq!(window.camera(), start);
    assert_eq!(pivot(&window), hit, "Home forgot the pivot");
}

#[test]
fn orthographic_views_keep_the_size_of_what_is_at_the_pivot() {
    let mut window = open(&[ROOM]);
    let beside = pivot(&window) + dvec3(0.5, 0.25, 0.0);
    let before = seen(&window.camera(), beside);
    press(&mut window, Key::Num5);
    let camera = window.camera();
    assert!(camera.orthographic_height.is_some());
    let after = seen(&camera, beside);
    assert!(before.distance(after) < 1e-6, "{before} and {after}");
}

#[test]
fn views_along_an_axis_show_the_scene_or_the_selection() {
    let mut window = open(&[ROOM]);
    let scene = window.session().subject().expect("bounds");
    for key in [Key::Num7, Key::Num3, Key::Num1] {
        press(&mut window, key);
        let camera = window.camera();
        assert!(
            seen(&camera, scene.0.midpoint(scene.1)).length() < 1e-6,
            "{key:?}"
        );
        let fills = widest(&window, scene);
        assert!((0.8..=1.0).contains(&fills), "{key:?}: {fills}");
    }
    // The red ball at (−1.35, −0.55, −5.2).
    use glimray::scene::ObjectRef::Shape;
    use glimray_viewer::model::objects::Id;
    window.session().selection = Some(Id::Object(Shape(0)));
    press(&mut window, Key::Num7);
    let ball = dvec3(-1.35, -0.55, -5.2);
    assert!(seen(&window.camera(), ball).length() < 1e-6);
}

/// How much of the picture's width or height a box takes, whichever is more.
fn widest(window: &Window, (min, max): (DVec3, DVec3)) -> f64 {
    let camera = window.camera();
    let (width, height) = window.session().picture_size();
    let corners = (0..8).map(|corner| {
        let side = |bit: usize| [min[bit], max[bit]][corner >> bit & 1];
        seen(&camera, DVec3::new(side(0), side(1), side(2))).abs()
    });
    let most = corners.fold(DVec2::ZERO, DVec2::max);
    2.0 * most.y.max(most.x * f64::from(height) / f64::from(width))
}

#[test]
fn the_whole_scene_is_framed_past_its_lamps() {
    let mut window = Window::open(&["--size", "64x48", "--samples", "1"]);
    window.settle();
    window.harness.key_press_modifiers(Modifiers::SHIFT, Key::F);
    window.settle();
    let (camera, scene) = (window.camera(), window.request().scene);
    let (min, max) = window.session().subject().expect("bounds");
    let target = min.midpoint(max);
    let LightKind::Rectangle {
        center,
        edge_u,
        edge_v,
    } = scene.lights[0].kind
    else {
        panic!("the demo has another lamp");
    };
    let normal = edge_u.cross(edge_v);
    let is_hidden = |x: u32, y: u32| {
        let size = DVec2::new(64.0, 48.0);
        let at = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
        let (from, along) = ray_through(&camera, at, size);
        let distance = (center - from).dot(normal) / along.dot(normal);
        let off = from + distance * along - center;
        let is_inside = [edge_u, edge_v]
            .iter()
            .all(|edge| off.dot(*edge).abs() <= edge.length_squared());
        is_inside && distance > 0.0 && distance < from.distance(target)
    };
    let pixels = (0..64).flat_map(|x| (0..48).map(move |y| (x, y)));
    let hidden = pixels.filter(|(x, y)| is_hidden(*x, *y)).count();
    assert!(hidden < 64 * 48 / 50, "the lamp hides {hidden} pixels");
    assert!(seen(&camera, target).length() < 1e-6);
}

#[test]
fn each_gesture_of_the_camera_is_a_step_that_can_be_undone() {
    let mut window = open(&[ROOM, "--size", "64x48"]);
    let undo = |window: &mut Window| {
        window.harness.key_press_modifiers(Modifiers::ALT, Key::Z);
        window.settle();
    };
    let redo = |window: &mut Window| {
        let keys = Modifiers::ALT | Modifiers::SHIFT;
        window.harness.key_press_modifiers(keys, Key::Z);
        window.settle();
    };
    let mut views = vec![window.camera()];
    drag(&mut window, egui::vec2(30.0, 10.0));
    views.push(window.camera());
    press(&mut window, Key::Num7);
    views.push(window.camera());
    // Both before the first has arrived.
    window.harness.key_press(Key::Num3);
    window.harness.step();
    press(&mut window, Key::Num5);
    views.push(window.camera());
    assert!(views.windows(2).all(|two| two[0] != two[1]));
    undo(&mut window);
    assert!(
        window.camera().orthographic_height.is_none(),
        "two commands are one step"
    );
    undo(&mut window);
    for view in views[..3].iter().rev() {
        assert_same_view(&window.camera(), view);
        undo(&mut window);
    }
    assert_eq!(window.camera(), views[0], "not the scene's own camera");
    let told = "No camera movement to undo";
    let messages = window.session().messages.all().to_vec();
    assert!(messages.iter().any(|message| message.text == told));
    for view in &views[1..3] {
        redo(&mut window);
        assert_same_view(&window.camera(), view);
    }
    redo(&mut window);
    redo(&mut window);
    assert_same_view(&window.camera(), &views[3]);
    undo(&mut window);
    drag(&mut window, egui::vec2(20.0, 0.0));
    let turned = window.camera();
    redo(&mut window);
    assert_eq!(
        window.camera(),
        turned,
        "a new gesture ends what could be repeated"
    );
}

#[track_caller]
fn assert_same_view(a: &Camera, b: &Camera) {
    let near = |a: DVec3, b: DVec3| a.distance(b) <= 1e-6 * a.length().max(1.0);
    let is_same = near(a.look_from, b.look_from) && near(a.look_at, b.look_at);
    assert!(is_same && a.fov_y == b.fov_y, "{a:?} and {b:?}");
}
