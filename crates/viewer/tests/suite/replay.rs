//! Recordings of what a person does: played again they lead to the same, and the same use for long
//! takes no more memory.

use super::pixels::{self, Bytes};
use crate::harness::Window;
use eframe::App;
use eframe::egui::{
    Event, Key, Modifiers, MouseWheelSource, MouseWheelUnit, PointerButton, Pos2, RawInput,
    TouchPhase, vec2,
};
use glimray::scene::Camera;
use std::path::Path;
use std::process::Command;

/// Seconds of a frame.
const FRAME: f64 = 1.0 / 60.0;

/// One frame in which `events` happen, as a window's own loop has it.
fn frame(window: &mut Window, events: Vec<Event>, number: usize) {
    let mut raw = RawInput {
        events,
        time: Some(number as f64 * FRAME),
        ..RawInput::default()
    };
    let ctx = window.harness.ctx.clone();
    window.harness.state_mut().raw_input_hook(&ctx, &mut raw);
    window.harness.input_mut().events.extend(raw.events);
    window.harness.step();
}

fn button(pos: Pos2, button: PointerButton, pressed: bool) -> Event {
    Event::PointerButton {
        pos,
        button,
        pressed,
        modifiers: Modifiers::NONE,
    }
}

fn key(key: Key) -> [Event; 2] {
    [true, false].map(|pressed| Event::Key {
        key,
        physical_key: None,
        pressed,
        repeat: false,
        modifiers: Modifiers::NONE,
    })
}

/// The input of someone who looks round: an orbit, a pan, the wheel, an integrator and back, exposure.
fn script(middle: Pos2) -> Vec<Vec<Event>> {
    let mut frames = Vec::new();
    for which in [PointerButton::Primary, PointerButton::Middle] {
        frames.push(vec![Event::PointerMoved(middle)]);
        frames.push(vec![button(middle, which, true)]);
        let path = (1..8).map(|i| middle + vec2(4.0, 1.5) * i as f32);
        frames.extend(path.map(|at| vec![Event::PointerMoved(at)]));
        frames.push(vec![button(middle + vec2(28.0, 10.5), which, false)]);
    }
    for up in [1.0, 1.0, -1.0] {
        frames.push(vec![Event::MouseWheel {
            unit: MouseWheelUnit::Line,
            delta: vec2(0.0, up),
            phase: TouchPhase::Move,
            source: MouseWheelSource::Wheel,
            modifiers: Modifiers::NONE,
        }]);
    }
    for pressed in [Key::Plus, Key::Period, Key::Num5] {
        frames.push(key(pressed).into());
        frames.extend((0..6).map(|_| Vec::new()));
    }
    frames
}

/// All that there is to remember of a session that has come to rest.
#[derive(PartialEq)]
struct State {
    camera: Camera,
    look: String,
    picture: Bytes,
}

fn state(window: &mut Window) -> State {
    window.settle();
    let session = window.session();
    let look = format!("{:?} {:?}", session.view, session.playback);
    drop(session);
    let screen = window.shown().screen.expect("a screen");
    State {
        camera: window.camera(),
        look,
        picture: pixels::on(&screen, &window.gpu),
    }
}

fn open(flag: &str, file: &Path) -> Window {
    let file = file.to_str().expect("Unicode");
    let mut window = Window::open(&["--size", "64x48", "--samples", "2", flag, file]);
    window.settle();
    window
}

#[test]
fn a_recording_played_twice_ends_in_the_same_state_and_picture() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("session.jsonl");
    let mut window = open("--record", &file);
    let start = window.camera();
    let middle = window.session().viewport.expect("a picture").rect.center();
    for (number, events) in script(middle).into_iter().enumerate() {
        frame(&mut window, events, number);
    }
    let recorded = state(&mut window);
    assert_ne!(window.camera(), start, "the script does nothing");
    drop(window);
    let lines = std::fs::read_to_string(&file).expect("a recording");
    let is_event = |line: &str| {
        let line: serde_json::Value = serde_json::from_str(line).expect("a line of JSON");
        line["time"].is_f64() && line["event"] != serde_json::Value::Null
    };
    let events: usize = script(middle).iter().map(Vec::len).sum();
    assert_eq!(lines.lines().count(), events);
    assert!(lines.lines().all(is_event), "{lines}");
    let play = || {
        let mut window = open_replay(&file);
        let mut number = 0;
        while window.session().recording.is_playing() {
            frame(&mut window, Vec::new(), number);
            number += 1;
            assert!(number < 10_000, "it never ends");
        }
        state(&mut window)
    };
    let (first, second) = (play(), play());
    assert!(first == second, "two replays are not the same");
    assert_eq!(first.look, recorded.look);
    // The hand that was recorded paused between its frames, and the camera glides in as many more steps.
    let (there, here) = (&first.camera, &recorded.camera);
    let off = (there.look_from.distance(here.look_from)).max(there.look_at.distance(here.look_at));
    assert!(off < 1e-9, "the cameras are {off} apart");
    let pairs = (first.picture.rgb.iter()).zip(&recorded.picture.rgb);
    let differing = pairs.filter(|(a, b)| a != b).count();
    assert!(differing < 64 * 48 / 100, "{differing} pixels differ");
}

/// Does not wait for it to settle: it does not before all is played.
fn open_replay(file: &Path) -> Window {
    let file = file.to_str().expect("Unicode");
    let mut window = Window::open(&["--size", "64x48", "--samples", "2", "--replay", file]);
    window.harness.step();
    window.harness.step();
    window
}

/// Names how often the long test does the same, in place of a few times.
const SOAK: &str = "GLIMRAY_SOAK_ROUNDS";
const FEW_ROUNDS: usize = 12;
/// Allocations of this many bytes go back to the system when they are freed. By default glibc keeps up to tens of megabytes,
/// more or less by chance.
const MAPPED: (&str, &str) = ("MALLOC_MMAP_THRESHOLD_", "65536");

/// Kibibytes of this process that are in memory.
fn resident() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").expect("Linux");
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"));
    let number = line.and_then(|line| line.split_whitespace().next());
    number
        .and_then(|number| number.parse().ok())
        .expect("a number")
}

/// Repeats the script as often as [`SOAK`] says, in a process of its own: the memory that it takes
/// in the first two fifths of the rounds is compared with what it takes at the end.
#[test]
#[ignore = "run by the test below"]
fn soak() {
    let rounds = std::env::var(SOAK).map_or(FEW_ROUNDS, |n| n.parse().expect("a number"));
    assert!(
        rounds >= 5,
        "{rounds} rounds tell nothing: give {SOAK} more"
    );
    let mut window = Window::open(&["--samples", "2"]);
    window.settle();
    let middle = window.session().viewport.expect("a picture").rect.center();
    let (mut early, mut late) = (0, 0);
    let mut number = 0;
    for round in 0..rounds {
        for events in script(middle) {
            frame(&mut window, events, number);
            number += 1;
        }
        window
            .session()
            .controller
            .as_mut()
            .expect("a rig")
            .go_home();
        window.settle();
        late = resident();
        if round < rounds * 2 / 5 {
            early = early.max(late);
        }
    }
    println!("{rounds} rounds: {early} KiB early, {late} KiB at the end");
    let growth = late as f64 / early as f64 - 1.0;
    assert!(
        growth < 0.05,
        "memory grows from {early} to {late} KiB in {rounds} rounds"
    );
}

#[cfg(target_os = "linux")]
#[test]
fn long_use_takes_no_more_memory() {
    let output = Command::new(std::env::current_exe().expect("this test"))
        .args(["--exact", "replay::soak", "--ignored", "--nocapture"])
        .env(MAPPED.0, MAPPED.1)
        .output()
        .expect("this test runs");
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(
        output.status.success(),
        "{text}{}",
        String::from_utf8_lossy(&output.stderr)
    );
    assert!(text.contains("1 passed"), "{text}");
}
