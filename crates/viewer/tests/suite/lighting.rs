//! Light by hand: the background turned by a drag, the map of the sky, built-in environments, and handles of lamps.

use super::edit::{on_screen, perform, scene};
use super::making::undo_count;
use crate::harness::Window;
use crate::reference::compare::render;
use eframe::egui::{self, Key, Modifiers, PointerButton, Pos2, Role, Vec2, vec2};
use egui_kittest::kittest::Queryable;
use glam::{DVec3, dvec2, dvec3};
use glimray::import;
use glimray::render::Tone;
use glimray::scene::{Background, BuiltIn, LightKind, ObjectRef, Origin, Scene};
use glimray_viewer::actions::saving;
use glimray_viewer::model::bindings::{Action, Preset};
use glimray_viewer::model::camera::ray_through;
use glimray_viewer::model::objects::Id;
use std::path::PathBuf;
use tempfile::TempDir;

const LAMP: Id = Id::Object(ObjectRef::Light(0));

/// A ball in front of a background, seen along −z, with more lines.
fn open(background: &str, lines: &str) -> (TempDir, PathBuf, Window) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("ball.toml");
    let text = format!(
        "{background}\n[output]\nintegrator = \"path\"\n[camera]\nlook_from = [0, 0, 8]\nlook_at = [0, 0, 0]\n\
         fov_y_deg = 40\n{lines}\n[[objects]]\nsphere = {{ center = [0, 0, 0], radius = 1 }}\n"
    );
    std::fs::write(&path, text).expect("a file");
    let name = path.to_str().expect("a path in UTF-8");
    let mut window = Window::open(&[name, "--size", "160x120", "--samples", "1"]);
    window.settle();
    (folder, path, window)
}

fn button(window: &mut Window, pos: Pos2, button: PointerButton, modifiers: Modifiers, down: bool) {
    window.harness.event(egui::Event::PointerButton {
        pos,
        button,
        pressed: down,
        modifiers,
    });
    window.harness.step();
}

/// Presses a button with modifiers and moves the pointer, without letting go.
fn pull(window: &mut Window, from: Pos2, way: Vec2, which: PointerButton, modifiers: Modifiers) {
    window
        .harness
        .event(egui::Event::ModifiersChanged(modifiers));
    window.harness.hover_at(from);
    window.harness.step();
    button(window, from, which, modifiers, true);
    for share in [0.3, 0.7, 1.0] {
        window.harness.hover_at(from + share * way);
        window.harness.step();
    }
}

fn let_go(window: &mut Window, at: Pos2, which: PointerButton) {
    button(window, at, which, Modifiers::NONE, false);
    window
        .harness
        .event(egui::Event::ModifiersChanged(Modifiers::NONE));
    window.settle();
}

pub(super) fn turn(window: &mut Window, way: Vec2) {
    let from = window.session().viewport.expect("a picture").rect.center();
    pull(
        window,
        from,
        way,
        PointerButton::Secondary,
        Modifiers::SHIFT,
    );
    let_go(window, from + way, PointerButton::Secondary);
}

fn drag(window: &mut Window, from: Pos2, to: Pos2) {
    pull(
        window,
        from,
        to - from,
        PointerButton::Primary,
        Modifiers::NONE,
    );
    let_go(window, to, PointerButton::Primary);
}

/// Elevation and azimuth of the sun of the scene's sky, in degrees.
fn sun(scene: &Scene) -> [f64; 2] {
    let Background::Picture { picture, .. } = scene.background else {
        panic!("{:?}", scene.background);
    };
    match scene.pictures[picture].origin {
        Origin::Sky { elevation, azimuth } => [elevation, azimuth].map(f64::to_degrees),
        ref other => panic!("{other:?}"),
    }
}

fn rotation(scene: &Scene) -> f64 {
    match scene.background {
        Background::Picture { rotation, .. } => rotation.to_degrees(),
        ref other => panic!("{other:?}"),
    }
}

#[track_caller]
fn near(found: f64, expected: f64, tolerance: f64) {
    assert!(
        (found - expected).abs() <= tolerance,
        "{found}, expected {expected}"
    );
}

fn height(window: &Window) -> f32 {
    window.session().viewport.expect("a picture").rect.height()
}

#[test]
fn a_drag_with_shift_and_the_right_button_moves_the_sun_in_one_step_that_is_saved() {
    for preset in Preset::ALL {
        let (_folder, path, mut window) = open("background = \"sky\"", "");
        window.session().preferences.bindings.set_preset(preset);
        let whole = height(&window);
        // The height of the picture is half a turn.
        turn(&mut window, vec2(whole / 6.0, whole / 12.0));
        let [elevation, azimuth] = sun(&scene(&window));
        near(elevation, 45.0 - 15.0, 0.06);
        near(azimuth, -135.0 + 30.0, 0.06);
        assert_eq!((undo_count(&window), rotation(&scene(&window))), (1, 0.0));
        assert_eq!(
            window.camera().look_from,
            dvec3(0.0, 0.0, 8.0),
            "{preset:?}"
        );
        saving::write(&mut window.session(), &path).expect("a file");
        window.settle();
        assert_eq!(
            sun(&import::load(&path).expect("a scene")),
            sun(&scene(&window))
        );
        window
            .harness
            .key_press_modifiers(Modifiers::COMMAND, Key::Z);
        window.settle();
        near(sun(&scene(&window))[0], 45.0, 1e-9);
    }
}

#[test]
fn the_sun_stays_above_the_horizon_and_below_the_zenith() {
    let (_folder, _, mut window) = open("background = \"sky\"", "");
    let whole = height(&window);
    turn(&mut window, vec2(0.0, 0.45 * whole));
    assert_eq!(sun(&scene(&window))[0], 0.0);
    for _ in 0..2 {
        turn(&mut window, vec2(0.0, -0.4 * whole));
    }
    assert_eq!(sun(&scene(&window))[0], 90.0);
}

/// A feature in the middle of the picture follows the pointer.
#[test]
fn what_is_ahead_follows_the_pointer_that_turns_a_picture() {
    let (_folder, _, mut window) = open(
        "background = { environment = \"studio\", rotation_deg = 170 }",
        "",
    );
    let whole = height(&window);
    turn(&mut window, vec2(-whole / 9.0, -whole / 3.0));
    // To the left is counter-clockwise from above: 20 degrees from 170 lead to −170.
    near(rotation(&scene(&window)), -170.0, 0.06);
    assert_eq!(undo_count(&window), 1);
}

#[test]
fn a_sky_that_an_option_has_added_can_be_turned_too() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("model.obj");
    std::fs::write(&path, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").expect("a file");
    let name = path.to_str().expect("a path in UTF-8");
    let flags = [
        "--size",
        "320x240",
        "--samples",
        "1",
        "--environment",
        "sunset",
    ];
    let mut window = Window::open(&[&[name], &flags[..]].concat());
    window.settle();
    near(sun(&scene(&window))[0], 4.0, 1e-9);
    let whole = height(&window);
    turn(&mut window, vec2(0.0, -whole / 9.0));
    near(sun(&scene(&window))[0], 24.0, 0.06);
}

#[test]
fn escape_puts_the_sun_back_and_a_plain_background_says_that_it_has_no_direction() {
    let (_folder, _, mut window) = open("background = \"sky\"", "");
    let from = window.session().viewport.expect("a picture").rect.center();
    let way = vec2(40.0, 20.0);
    pull(
        &mut window,
        from,
        way,
        PointerButton::Secondary,
        Modifiers::SHIFT,
    );
    assert_ne!(sun(&scene(&window)), [45.0, -135.0]);
    window.harness.key_press(Key::Escape);
    window.harness.run_steps(2);
    let_go(&mut window, from + way, PointerButton::Secondary);
    assert_eq!(undo_count(&window), 0);
    near(sun(&scene(&window))[1], -135.0, 1e-9);

    let (_folder, _, mut window) = open("background = [0.1, 0.2, 0.3]", "");
    turn(&mut window, way);
    assert_eq!(undo_count(&window), 0);
    let session = window.session();
    let mut told = session.messages.all().iter().map(|it| it.text.as_str());
    assert!(told.any(|text| text.contains("The background has no direction")));
}

#[test]
fn the_sun_goes_where_the_map_of_the_sky_is_clicked() {
    let (_folder, _, mut window) = open("background = \"sky\"", "");
    let map = window.harness.get_by_label("Map of the sky").rect();
    // Half-way from the zenith to the horizon in the direction +x, which is at the right.
    let at = map.center() + vec2(0.5 * 40.0, 0.0);
    button(
        &mut window,
        at,
        PointerButton::Primary,
        Modifiers::NONE,
        true,
    );
    button(
        &mut window,
        at,
        PointerButton::Primary,
        Modifiers::NONE,
        false,
    );
    window.settle();
    let [elevation, azimuth] = sun(&scene(&window));
    near(elevation, 45.0, 1.0);
    near(azimuth, 90.0, 1.0);
    assert_eq!(undo_count(&window), 1);
}

#[test]
fn an_environment_of_the_list_is_saved_by_its_name_and_renders_the_same() {
    let (_folder, path, mut window) = open("background = [0.1, 0.2, 0.3]", "");
    let list = window.harness.get_by_role_and_label(Role::ComboBox, "Kind");
    list.click();
    window.harness.run_steps(3);
    window.harness.get_by_label("Studio").click();
    window.settle();
    assert_eq!(undo_count(&window), 1);
    saving::write(&mut window.session(), &path).expect("a file");
    window.settle();
    let text = std::fs::read_to_string(&path).expect("a file");
    assert!(
        text.lines().any(|line| line == "background = \"studio\""),
        "{text}"
    );
    let read = import::load(&path).expect("a scene");
    assert_eq!(*read.pictures[0], BuiltIn::Studio.picture());
    let (expected, _) = render(&read, &window.request().settings);
    assert!(window.image(Tone::LINEAR) == expected, "another picture");
}

/// Whether there is a handle at a point of the screen.
fn grabs(window: &mut Window, at: Pos2) -> bool {
    window.harness.hover_at(at);
    window.harness.step();
    window.harness.output().platform_output.cursor_icon == egui::CursorIcon::Grab
}

fn select(window: &mut Window) {
    window.session().select(vec![LAMP]);
    window.settle();
}

/// A length on the screen at the origin, in points per unit of the scene.
fn points_per_unit(window: &Window) -> f32 {
    on_screen(window, DVec3::X).x - on_screen(window, DVec3::ZERO).x
}

const SPOT: &str = "[[lights]]\nspot = { position = [0, 2, 0], direction = [0, -1, 0], inner_deg = 10, outer_deg = 20, \
                    color = [9, 9, 9] }\n";

/// The end of a direction: 130 points from its start.
fn aim(window: &Window, at: DVec3, way: DVec3) -> Pos2 {
    let reach = 130.0 / points_per_unit(window);
    on_screen(window, at + f64::from(reach) * way)
}

#[test]
fn the_aim_of_a_spot_follows_the_pointer_and_snaps_to_the_surface_it_is_dropped_on() {
    let (_folder, _, mut window) = open("ambient = [0.1, 0.1, 0.1]", SPOT);
    select(&mut window);
    let from = aim(&window, dvec3(0.0, 2.0, 0.0), DVec3::NEG_Y);
    // Beside the ball: the plane of the aim at the depth of the lamp.
    let beside = on_screen(&window, dvec3(2.0, 0.5, 0.0));
    drag(&mut window, from, beside);
    let expected = dvec3(2.0, -1.5, 0.0).normalize();
    let direction = |window: &Window| match scene(window).lights[0].kind {
        LightKind::Spot { direction, .. } => direction,
        ref other => panic!("{other:?}"),
    };
    assert!(
        direction(&window).distance(expected) < 0.02,
        "{}",
        direction(&window)
    );
    assert_eq!(undo_count(&window), 1);

    let from = aim(&window, dvec3(0.0, 2.0, 0.0), direction(&window));
    let on_ball = on_screen(&window, dvec3(0.3, 0.4, 0.0));
    drag(&mut window, from, on_ball);
    // The front of the unit ball, nearer to the camera than the lamp: in the middle of the pixel under the pointer.
    let viewport = window.session().viewport.expect("a picture");
    let [x, y] = viewport.pixel(on_ball).expect("a pixel");
    let camera = window.camera();
    let size = window.shown().size;
    let size = dvec2(size.0.into(), size.1.into());
    let middle = dvec2(f64::from(x) + 0.5, f64::from(y) + 0.5);
    let (eye, along): (DVec3, DVec3) = ray_through(&camera, middle, size);
    let b = eye.dot(along);
    let hit = eye + along * (-b - (b * b - eye.length_squared() + 1.0).sqrt());
    let expected = (hit - dvec3(0.0, 2.0, 0.0)).normalize();
    let found = direction(&window);
    assert!(
        found.distance(expected) < 1e-3,
        "{found}, expected {expected}"
    );
    assert!(found.z > 0.2, "{found} is in the plane of the lamp");
    assert_eq!(undo_count(&window), 2);
    window
        .harness
        .key_press_modifiers(Modifiers::COMMAND, Key::Z);
    window.settle();
    assert!(direction(&window).distance(dvec3(0.8, -0.6, 0.0)) < 0.02);
}

#[test]
fn the_rim_of_a_cone_follows_the_pointer_as_an_angle() {
    let (_folder, _, mut window) = open("ambient = [0.1, 0.1, 0.1]", SPOT);
    select(&mut window);
    let reach = f64::from(130.0 / points_per_unit(&window));
    let lamp = dvec3(0.0, 2.0, 0.0);
    let rim = |angle_deg: f64, side: f64| {
        let (sine, cosine) = angle_deg.to_radians().sin_cos();
        lamp + reach * dvec3(side * sine, -cosine, 0.0)
    };
    // The camera looks along −z: the handle is at the left or the right of the axis.
    let ends = [1.0, -1.0].map(|side| on_screen(&window, rim(20.0, side)));
    let side = match grabs(&mut window, ends[0]) {
        true => 1.0,
        false => -1.0,
    };
    let (from, to) = (
        on_screen(&window, rim(20.0, side)),
        on_screen(&window, rim(50.0, side)),
    );
    drag(&mut window, from, to);
    let cone = |window: &Window| match scene(window).lights[0].kind {
        LightKind::Spot { inner, outer, .. } => [inner, outer].map(f64::to_degrees),
        ref other => panic!("{other:?}"),
    };
    let [inner, outer] = cone(&window);
    near(outer, 50.0, 0.5);
    near(inner, 10.0, 1e-6);
    // The inner angle goes no farther than the outer one.
    let (from, to) = (
        on_screen(&window, rim(10.0, -side)),
        on_screen(&window, rim(70.0, -side)),
    );
    drag(&mut window, from, to);
    let [inner, outer] = cone(&window);
    assert_eq!(inner, outer);
    assert_eq!(undo_count(&window), 2);
}

#[test]
fn the_edges_of_area_lamps_follow_the_pointer() {
    let rectangle = "[[lights]]\nrectangle = { center = [0, 0, 1], edge_u = [1, 0, 0], edge_v = [0, 0.5, 0], \
                     color = [9, 9, 9] }\n";
    let (_folder, _, mut window) = open("ambient = [0.1, 0.1, 0.1]", rectangle);
    let edges = |window: &Window| match scene(window).lights[0].kind {
        LightKind::Rectangle { edge_u, edge_v, .. } => [edge_u, edge_v],
        ref other => panic!("{other:?}"),
    };
    let [u, v] = edges(&window);
    select(&mut window);
    let center = dvec3(0.0, 0.0, 1.0);
    let (from, to) = (
        on_screen(&window, center + u),
        on_screen(&window, center + 1.6 * u),
    );
    drag(&mut window, from, to);
    let [wide, same] = edges(&window);
    assert!(
        wide.distance(1.6 * u) < 0.02 && same.distance(v) < 1e-9,
        "{wide} {same}"
    );
    assert_eq!(undo_count(&window), 1);

    let sphere = "[[lights]]\nsphere = { center = [0, 2, 0], radius = 0.5, color = [9, 9, 9] }\n";
    let (_folder, _, mut window) = open("ambient = [0.1, 0.1, 0.1]", sphere);
    select(&mut window);
    let center = dvec3(0.0, 2.0, 0.0);
    let side = side_of_handle(&mut window, center);
    let (from, to) = (
        on_screen(&window, center + 0.5 * side),
        on_screen(&window, center + 1.25 * side),
    );
    drag(&mut window, from, to);
    match scene(&window).lights[0].kind {
        LightKind::Sphere { radius, .. } => near(radius, 1.25, 0.01),
        ref other => panic!("{other:?}"),
    }
}

#[test]
fn handles_of_lamps_are_an_overlay_of_its_own() {
    let (_folder, _, mut window) = open("ambient = [0.1, 0.1, 0.1]", SPOT);
    select(&mut window);
    let handle = aim(&window, dvec3(0.0, 2.0, 0.0), DVec3::NEG_Y);
    for is_shown in [true, false, true] {
        assert_eq!(grabs(&mut window, handle), is_shown);
        perform(&mut window, Action::ToggleLampHandles);
    }
    drag(&mut window, handle, handle + vec2(60.0, 0.0));
    assert_eq!(undo_count(&window), 0, "a hidden handle is dragged");
}

#[test]
fn escape_puts_a_lamp_back() {
    let (_folder, _, mut window) = open("ambient = [0.1, 0.1, 0.1]", SPOT);
    select(&mut window);
    let before = scene(&window);
    let from = aim(&window, dvec3(0.0, 2.0, 0.0), DVec3::NEG_Y);
    let way = vec2(60.0, 0.0);
    pull(
        &mut window,
        from,
        way,
        PointerButton::Primary,
        Modifiers::NONE,
    );
    assert_ne!(scene(&window), before);
    window.harness.key_press(Key::Escape);
    window.harness.run_steps(2);
    let_go(&mut window, from + way, PointerButton::Primary);
    assert_eq!(scene(&window), before);
    assert_eq!(undo_count(&window), 0);
}

/// The view along the axis ends behind a lamp, whose back would cover the picture.
#[test]
fn a_lamp_before_the_scene_does_not_hide_it_from_views_along_axes() {
    let lamp = "[[lights]]\nrectangle = { center = [0, 0, 2.2], edge_u = [2, 0, 0], edge_v = [0, -2, 0], \
                color = [3, 3, 3] }\n";
    for orthographic in [false, true] {
        let (_folder, _, mut window) = open("background = [0, 0, 0.5]", lamp);
        if orthographic {
            window.harness.key_press(Key::Num5);
            window.settle();
        }
        window.harness.key_press(Key::Num1);
        window.settle();
        let camera = window.camera();
        let way = (camera.look_at - camera.look_from).normalize();
        assert!(way.distance(DVec3::NEG_Z) < 1e-9, "{way}");
        assert!(camera.look_from.z > 2.2, "the lamp is not in the way");
        let image = window.image(Tone::LINEAR);
        let [r, g, b, _] = image
            .pixel(image.width / 2, image.height / 2)
            .expect("a pixel");
        assert!(
            r > 0.2 && g > 0.2 && b > 0.2,
            "the ball is not lit: {r} {g} {b}"
        );
        let [.., b, _] = image.pixel(2, 2).expect("a pixel");
        assert_eq!(b, 0.5, "the background is hidden");
        // Once it is moved, the camera sees all that is before it again.
        window.harness.key_press(Key::ArrowLeft);
        window.settle();
        assert_eq!(window.camera().clip, glimray::scene::Camera::UNCLIPPED);
    }
}

/// The direction from the middle of a ball of radius 0.5 to its handle, at the left or the right.
fn side_of_handle(window: &mut Window, center: DVec3) -> DVec3 {
    let mut sides = [DVec3::X, DVec3::NEG_X].into_iter();
    let is_there = |side: &DVec3| {
        let at = on_screen(window, center + 0.5 * *side);
        grabs(window, at)
    };
    sides.find(is_there).expect("a handle")
}

#[test]
fn a_lamp_whose_handle_is_let_go_in_motion_is_changed_once() {
    let sphere = "[[lights]]\nsphere = { center = [0, 2, 0], radius = 0.5, color = [9, 9, 9] }\n";
    let (_folder, _path, mut window) = open("ambient = [0.1, 0.1, 0.1]", sphere);
    select(&mut window);
    let center = dvec3(0.0, 2.0, 0.0);
    let side = side_of_handle(&mut window, center);
    let from = on_screen(&window, center + 0.5 * side);
    let to = on_screen(&window, center + 1.25 * side);
    let none = Modifiers::NONE;
    pull(
        &mut window,
        from,
        0.5 * (to - from),
        PointerButton::Primary,
        none,
    );
    // The pointer moves on in the frame in which the button is let go.
    let released = egui::Event::PointerButton {
        pos: to,
        button: PointerButton::Primary,
        pressed: false,
        modifiers: none,
    };
    let events = &mut window.harness.input_mut().events;
    events.extend([egui::Event::PointerMoved(to), released]);
    window.harness.step();
    window.settle();
    let LightKind::Sphere { radius, .. } = scene(&window).lights[0].kind else {
        panic!("not a sphere");
    };
    assert!((radius - 1.25).abs() < 0.01, "{radius}");
    assert_eq!(undo_count(&window), 1);
}

#[test]
fn a_lamp_that_is_framed_is_not_cut_off() {
    let lamp = "[[lights]]\ndisc = { center = [0, 0, 4], normal = [0, 0, -1], radius = 1, color = [9, 9, 9] }\n";
    let (_folder, _path, mut window) = open("background = [0, 0, 0]", lamp);
    window.session().select(vec![LAMP]);
    window.settle();
    window.harness.key_press(Key::F);
    window.settle();
    let camera = window.camera();
    let distance = camera.look_from.distance(dvec3(0.0, 0.0, 4.0));
    assert!(camera.clip.0 < distance, "{} of {distance}", camera.clip.0);
}

#[test]
fn the_exposure_stands_beside_the_strength_of_an_environment() {
    let (_folder, _path, mut window) = open("background = \"studio\"", "");
    let row = (window.harness).get_by_role_and_label(Role::SpinButton, "View exposure");
    row.set_value_accesskit(1.0);
    window.settle();
    assert_eq!(window.request().tone.exposure_ev, 1.0);
}
