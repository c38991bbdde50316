//! Panels and the lines between them: hidden and shown again, squeezed and given room again, dragged quickly.

use crate::harness::Window;
use eframe::App;
use eframe::egui::{Event, Key, Modifiers, PointerButton, Pos2, RawInput, Role, pos2, vec2};
use egui_kittest::kittest::Queryable;
use glimray_viewer::model::preferences::Store;
use glimray_viewer::model::view_settings::{Comparison, Sharing};
use glimray_viewer::state::layout::Panel;

fn open() -> Window {
    let mut window = Window::open(&["--size", "64x48", "--samples", "1"]);
    window.settle();
    window
}

fn layout(window: &Window) -> String {
    serde_json::to_string(window.harness.state().layout()).expect("a layout")
}

/// Widths of the panels on the left and on the right, and the height of that below, in points.
fn sizes(window: &Window) -> [f32; 3] {
    let rect = |label| window.harness.get_by_label(label).rect();
    let picture = rect("Rendered picture");
    let room = window.harness.ctx.content_rect();
    [
        picture.min.x,
        room.max.x - picture.max.x,
        room.max.y - picture.max.y,
    ]
}

#[track_caller]
fn assert_sizes(window: &Window, expected: [f32; 3], what: &str) {
    let sizes = sizes(window);
    let is_near = sizes.iter().zip(expected).all(|(a, b)| (a - b).abs() < 0.5);
    assert!(is_near, "{what}: {sizes:?} instead of {expected:?}");
}

#[test]
fn hiding_all_panels_and_showing_them_again_restores_the_layout() {
    let mut window = open();
    let before = layout(&window);
    let widths = sizes(&window);
    window.harness.key_press(Key::N);
    window.settle();
    for panel in Panel::ALL {
        let is_visible = window.harness.state().layout().is_visible(panel);
        assert_eq!(is_visible, panel == Panel::Picture, "{panel:?}");
    }
    window.harness.key_press(Key::N);
    window.settle();
    // Hidden panels stay hidden, and the same tab of several is in front.
    assert_eq!(layout(&window), before);
    assert_sizes(&window, widths, "shown again");
}

#[test]
fn panels_get_their_sizes_back_after_the_window_was_small() {
    let mut window = open();
    let before = sizes(&window);
    window.harness.set_size(vec2(640.0, 480.0));
    window.settle();
    let small = sizes(&window);
    assert!(small[0] < before[0] - 20.0, "{small:?}, {before:?}");
    // A tab that is chosen meanwhile changes no size.
    rays_tab(&window).click();
    window.settle();
    window.harness.set_size(vec2(1000.0, 700.0));
    window.settle();
    assert_sizes(&window, before, "large again");
}

#[test]
fn panels_get_their_sizes_back_when_the_window_was_small_at_the_end() {
    let mut window = open();
    let before = sizes(&window);
    window.harness.set_size(vec2(640.0, 480.0));
    window.settle();
    let Window {
        harness,
        session,
        settings,
        ..
    } = window;
    drop(harness);
    let preferences = session.borrow().preferences.clone();
    Store::in_folder(settings.path())
        .save(&preferences)
        .expect("settings");
    let mut window = Window::open_with(&["--size", "64x48", "--samples", "1"], settings);
    window.settle();
    assert_sizes(&window, before, "started again");
}

#[test]
fn a_panel_that_someone_resizes_in_a_small_window_keeps_that_size() {
    let mut window = open();
    let before = sizes(&window);
    window.harness.set_size(vec2(640.0, 480.0));
    window.settle();
    let border = border(&window);
    for frame in quick(border, border - vec2(40.0, 0.0)) {
        pass(&mut window, frame);
    }
    window.settle();
    let resized = sizes(&window);
    window.harness.set_size(vec2(1000.0, 700.0));
    window.settle();
    assert_sizes(&window, [resized[0], before[1], before[2]], "large again");
}

/// The tab, and not the settings of the same name.
fn rays_tab(window: &Window) -> egui_kittest::Node<'_> {
    window.harness.get_by_role_and_label(Role::Button, "Rays")
}

/// The line between the panels on the left and the picture.
fn border(window: &Window) -> Pos2 {
    let picture = window.harness.get_by_label("Rendered picture").rect();
    pos2(picture.min.x - 0.5, picture.center().y)
}

/// A drag as quick as a hand can be: the press and the first movement come in one frame.
fn quick(from: Pos2, to: Pos2) -> Vec<Vec<Event>> {
    let button = |pos, pressed| Event::PointerButton {
        pos,
        button: PointerButton::Primary,
        pressed,
        modifiers: Modifiers::NONE,
    };
    vec![
        vec![Event::PointerMoved(from + vec2(0.0, 90.0))],
        vec![
            Event::PointerMoved(from),
            button(from, true),
            Event::PointerMoved(to),
        ],
        vec![Event::PointerMoved(to), button(to, false)],
        // Delayed events come in frames without events.
        vec![],
        vec![],
        vec![],
        vec![],
    ]
}

/// One frame, as a window's own loop has it.
fn pass(window: &mut Window, events: Vec<Event>) {
    let mut raw = RawInput {
        events,
        ..RawInput::default()
    };
    let ctx = window.harness.ctx.clone();
    window.harness.state_mut().raw_input_hook(&ctx, &mut raw);
    window.harness.input_mut().events.extend(raw.events);
    window.harness.step();
}

#[test]
fn a_quick_drag_takes_the_line_of_a_wipe_where_it_was_pressed() {
    let mut window = open();
    window.session().view.compare(Sharing::Wipe(0.5));
    window.settle();
    let (camera, rect) = {
        let session = window.session();
        let rect = session.viewport.expect("a picture").rect;
        (session.camera(), rect)
    };
    let to = rect.center() + vec2(rect.width() / 4.0, 0.0);
    for frame in quick(rect.center(), to) {
        pass(&mut window, frame);
    }
    window.settle();
    let session = window.session();
    let Some(Comparison {
        sharing: Sharing::Wipe(share),
        ..
    }) = session.view.comparison
    else {
        panic!("no wipe any more");
    };
    assert!((share - 0.75).abs() < 0.02, "{share}");
    assert_eq!(session.camera(), camera, "the drag went to the camera");
}

#[test]
fn a_quick_drag_takes_the_border_of_a_panel_where_it_was_pressed() {
    let mut window = open();
    let (before, camera) = (sizes(&window), window.camera());
    let border = border(&window);
    for frame in quick(border, border + vec2(60.0, 0.0)) {
        pass(&mut window, frame);
    }
    window.settle();
    let after = sizes(&window);
    assert!(
        (after[0] - before[0] - 60.0).abs() < 3.0,
        "{before:?}, {after:?}"
    );
    assert_eq!(window.camera(), camera, "the drag went to the camera");
}

#[test]
fn a_click_of_one_frame_is_a_click() {
    let mut window = open();
    let at = rays_tab(&window).rect().center();
    let button = |pressed| Event::PointerButton {
        pos: at,
        button: PointerButton::Primary,
        pressed,
        modifiers: Modifiers::NONE,
    };
    pass(
        &mut window,
        vec![Event::PointerMoved(at), button(true), button(false)],
    );
    window.settle();
    // The tab's panel is in front now.
    let mut found = window.harness.query_all_by_label("Inspect rays");
    assert!(found.next().is_some());
}
