//! The animation in the window: played, stepped through, and each frame that of the command line.

use crate::harness::Window;
use eframe::egui::{Key, Role};
use egui_kittest::kittest::{NodeT, Queryable};
use glimray_viewer::state::layout::Panel;

const SIZE: [&str; 4] = ["--size", "60x40", "--samples", "2"];

fn open(scene: &str) -> Window {
    let path = format!("assets/scenes/{scene}");
    let mut arguments = vec![path.as_str()];
    arguments.extend(SIZE);
    let mut window = Window::open(&arguments);
    window.settle();
    window
}

#[test]
fn the_buttons_of_the_timeline_go_where_they_say() {
    let mut window = open("orbits.toml");
    let last = window.session().playback.last_frame();
    // 6 s at 24 frames a second, the last of which is the first again.
    assert_eq!(last, 143);
    for (button, frame) in [
        ("Next frame", 1),
        ("Next frame", 2),
        ("Previous frame", 1),
        ("Last frame", 143),
        ("Next frame", 0),
        ("Previous frame", 143),
        ("First frame", 0),
    ] {
        window.harness.get_by_label(button).click();
        window.settle();
        assert_eq!(window.session().playback.frame(), frame, "{button}");
    }
    window.harness.get_by_label("Loop").click();
    window.settle();
    assert_eq!(window.session().playback.last_frame(), 144);
    window.harness.get_by_label("Play animation").click();
    window.harness.step();
    assert!(window.session().playback.is_playing);
    window.harness.run_steps(30);
    window.harness.get_by_label("Pause animation").click();
    window.settle();
    // A step of the window counts as a tenth of a second at most; a click is up to four of them.
    let frame = window.session().playback.frame();
    assert!(
        (30 * 24 / 10..=38 * 24 / 10).contains(&frame),
        "30 steps came to frame {frame}"
    );
}

#[test]
fn playing_takes_as_long_as_the_clock_says() {
    let window = open("orbits.toml");
    let mut playback = window.session().playback.clone();
    playback.toggle();
    // In pieces that are no frames.
    for _ in 0..1000 {
        playback.advance(0.001);
    }
    assert!(playback.frame().abs_diff(24) <= 1, "{}", playback.frame());
    playback.speed = 2.0;
    playback.go_to(0);
    for _ in 0..100 {
        playback.advance(0.02);
    }
    assert!(playback.frame().abs_diff(96) <= 1, "{}", playback.frame());
    // Round the end, or up to it.
    playback.speed = 1.0;
    playback.go_to(140);
    playback.advance(0.5);
    assert_eq!(playback.frame(), (140 + 12) % 144);
    playback.repeats = false;
    playback.go_to(140);
    playback.advance(0.5);
    assert_eq!((playback.frame(), playback.is_playing), (144, false));
    playback.toggle();
    assert_eq!((playback.frame(), playback.is_playing), (0, true));
}

#[test]
fn a_scene_that_stands_still_says_so() {
    let mut window = open("sphere.scene");
    let shows_time = |window: &Window| window.harness.state().layout().is_visible(Panel::Time);
    assert!(!shows_time(&window), "there is nothing to play");
    // By hand it is shown all the same, and stays.
    window.harness.get_by_label("Window").click();
    window.harness.run_steps(3);
    let entry = (window.harness).get_by_role_and_label(Role::CheckBox, "Time");
    entry.click();
    window.settle();
    window.harness.key_press(Key::Escape);
    window.settle();
    assert!(shows_time(&window));
    let button = window.harness.get_by_label("Play animation");
    assert!(button.accesskit_node().is_disabled());
    window.harness.get_by_label_contains("No animation");
    window.session().playback.toggle();
    window.settle();
    assert!(!window.session().playback.is_playing);
}

#[test]
fn the_time_panel_comes_with_a_scene_that_moves_and_goes_with_the_next_that_does_not() {
    let mut window = open("sphere.scene");
    let shows_time = |window: &Window| window.harness.state().layout().is_visible(Panel::Time);
    assert!(!shows_time(&window));
    let height = |window: &Window| {
        let picture = window.harness.get_by_label("Rendered picture");
        picture.rect().height()
    };
    let tall = height(&window);
    for (scene, is_shown) in [("orbits.toml", true), ("sphere.scene", false)] {
        window
            .session()
            .open(format!("assets/scenes/{scene}").into());
        window.settle();
        assert_eq!(shows_time(&window), is_shown, "{scene}");
        // The picture takes the room.
        assert_eq!(height(&window) < tall - 50.0, is_shown, "{scene}");
    }
}
