//! The viewer's table of bindings.

use eframe::egui::{
    Event, InputState, Key, Modifiers, MouseWheelSource, MouseWheelUnit, PointerButton, TouchPhase,
    vec2,
};
use glimray_viewer::model::bindings::{
    Action, Bindings, Category, Conflict, Manner, Mods, Preset, Trigger, markdown_table,
};
use glimray_viewer::model::camera::Flight;
use glimray_viewer::model::tool::Tool;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;

fn press(key: Key, physical: Key, modifiers: Modifiers) -> Event {
    Event::Key {
        key,
        physical_key: Some(physical),
        pressed: true,
        repeat: false,
        modifiers,
    }
}

/// The input of a frame with these events.
fn happening(events: Vec<Event>) -> InputState {
    let mut input = InputState::default();
    input.events = events;
    input
}

fn scroll(unit: MouseWheelUnit, x: f32, y: f32, modifiers: Modifiers) -> InputState {
    happening(vec![Event::MouseWheel {
        unit,
        delta: vec2(x, y),
        phase: TouchPhase::Move,
        source: MouseWheelSource::Unknown,
        modifiers,
    }])
}

fn holding(keys: &[Key], modifiers: Modifiers) -> InputState {
    let mut input = InputState::default();
    input.keys_down = keys.iter().copied().collect();
    input.modifiers = modifiers;
    input
}

fn trigger(text: &str) -> Trigger {
    text.parse().unwrap_or_else(|why| panic!("{why}"))
}

/// The table of a preset as it stands in the source.
fn written(name: &str) -> BTreeMap<String, String> {
    let source =
        fs::read_to_string("crates/viewer/src/model/bindings/preset.rs").expect("the source");
    let start = source
        .find(&format!("const {name}: &str = \""))
        .expect("the table");
    let text = &source[start..];
    let text = &text[text.find('"').expect("a start") + 1..];
    let text = &text[..text.find('"').expect("an end")];
    let lines: Vec<_> = text
        .lines()
        .filter(|line| !line.trim().is_empty())
        .collect();
    let table: BTreeMap<_, _> = lines
        .iter()
        .map(|line| {
            let (name, triggers) = line.split_once(':').expect("a colon");
            (name.trim().to_owned(), triggers.trim().to_owned())
        })
        .collect();
    assert_eq!(table.len(), lines.len(), "a command has two lines");
    table
}

#[test]
fn presets_are_read_to_the_last_word() {
    let default = written("GLIMRAY");
    let names: BTreeSet<_> = Action::ALL.iter().map(|action| action.name()).collect();
    let tools = Tool::ALL.iter().map(|tool| tool.entry().name);
    let known: BTreeSet<_> = default.keys().map(String::as_str).chain(tools).collect();
    assert_eq!(known, names);
    for (preset, table) in [
        (Preset::Glimray, "GLIMRAY"),
        (Preset::Blender, "BLENDER"),
        (Preset::Maya, "MAYA"),
    ] {
        let bindings = Bindings::new(preset);
        let own = written(table);
        for action in Action::ALL {
            let expected = match action {
                Action::Tool(tool) => tool.entry().shortcuts[preset as usize],
                _ => own.get(action.name()).unwrap_or(&default[action.name()]),
            };
            let found: Vec<_> = bindings
                .triggers(*action)
                .iter()
                .map(Trigger::to_string)
                .collect();
            assert_eq!(&found.join(", "), expected, "{action:?} in {preset:?}");
            let mut again = bindings.clone();
            let same = again.set(*action, bindings.triggers(*action).to_vec());
            assert_eq!(same, Ok(()), "{action:?} in {preset:?}");
            assert_eq!(again, bindings);
        }
        assert!(own.keys().all(|name| Action::from_name(name).is_some()));
    }
}

#[test]
fn tools_keep_their_names_and_their_keys_of_other_programs() {
    for (tool, name, keys) in [
        (Tool::Select, "select-mode", ["C", "C", "Q"]),
        (Tool::Move, "move-tool", ["G", "G", "W"]),
        (Tool::Rotate, "rotate-tool", ["R", "R", "E"]),
        (Tool::Scale, "scale-tool", ["Z", "S", "R"]),
        (Tool::Inspect, "inspect-rays", ["I", "I", "I"]),
        (Tool::Measure, "measure", ["Alt+M", "Alt+M", "Alt+M"]),
        (Tool::Region, "region-render", ["B", "Ctrl+B", "B"]),
    ] {
        let action = Action::from_name(name);
        assert_eq!(action, Some(Action::Tool(tool)), "{name}");
        for (preset, key) in Preset::ALL.into_iter().zip(keys) {
            let found = Bindings::new(preset).action_for(&trigger(key));
            assert_eq!(found, action, "{key} in {preset:?}");
        }
    }
}

#[test]
fn no_preset_gives_one_trigger_to_two_commands() {
    for preset in Preset::ALL {
        assert_eq!(Bindings::new(preset).conflicts(), [], "{preset:?}");
    }
}

#[test]
fn commands_have_names_and_descriptions_of_their_own() {
    let mut names = BTreeSet::new();
    let mut descriptions = BTreeSet::new();
    for action in Action::ALL {
        let name = action.name();
        assert!(
            name.bytes().all(|b| b.is_ascii_lowercase() || b == b'-'),
            "{name}"
        );
        assert!(names.insert(name), "{name}");
        assert_eq!(Action::from_name(name), Some(*action));
        let text = action.description();
        assert!(
            !text.ends_with('.') && text.len() < 80 && !text.contains('|'),
            "{text}"
        );
        assert!(descriptions.insert(text), "{text}");
    }
    // In the table's order, every heading once.
    let mut categories: Vec<_> = Action::ALL.iter().map(|action| action.category()).collect();
    categories.dedup();
    assert_eq!(categories, Category::ALL);
    assert_eq!(Action::from_name("no-such-command"), None);
}

#[test]
fn what_the_issue_promises_is_on_the_keys_that_it_names() {
    let bindings = Bindings::default();
    for (text, action) in [
        ("Drag left", Action::Orbit),
        ("Drag middle", Action::Pan),
        ("Shift+Drag left", Action::Pan),
        ("Wheel", Action::Zoom),
        ("Drag right", Action::Zoom),
        ("Ctrl+Wheel", Action::ZoomToCursor),
        ("Ctrl+Drag right", Action::ZoomToCursor),
        ("Hold W", Action::FlyForward),
        ("Hold A", Action::FlyLeft),
        ("Hold S", Action::FlyBack),
        ("Hold D", Action::FlyRight),
        ("Hold Q", Action::FlyDown),
        ("Hold E", Action::FlyUp),
        ("Hold Shift", Action::FlyFaster),
        ("DoubleClick left", Action::SetPivot),
        ("F", Action::FrameSelection),
        ("1", Action::ViewFront),
        ("3", Action::ViewRight),
        ("7", Action::ViewTop),
        ("Ctrl+1", Action::ViewBack),
        ("5", Action::ToggleOrthographic),
        ("Home", Action::Home),
        ("H", Action::Help),
    ] {
        assert_eq!(bindings.action_for(&trigger(text)), Some(action), "{text}");
    }
    let blender = Bindings::new(Preset::Blender);
    assert_eq!(
        blender.drag(PointerButton::Middle, Mods::NONE),
        Some(Action::Orbit)
    );
    assert_eq!(
        blender.drag(PointerButton::Middle, Modifiers::SHIFT),
        Some(Action::Pan)
    );
    assert_eq!(
        blender.drag(PointerButton::Primary, Mods::NONE),
        Some(Action::SelectBox)
    );
    let maya = Bindings::new(Preset::Maya);
    assert_eq!(
        maya.drag(PointerButton::Primary, Modifiers::ALT),
        Some(Action::Orbit)
    );
    assert_eq!(
        maya.drag(PointerButton::Primary, Mods::NONE),
        Some(Action::SelectBox)
    );
    assert_eq!(
        maya.click(PointerButton::Primary, Mods::NONE),
        Some(Action::Select)
    );
    assert_eq!(
        maya.double_click(PointerButton::Primary, Mods::NONE),
        Some(Action::SetPivot)
    );
}

#[test]
fn triggers_are_read_as_they_are_written() {
    for preset in Preset::ALL {
        let bindings = Bindings::new(preset);
        for action in Action::ALL {
            for known in bindings.triggers(*action) {
                assert_eq!(trigger(&known.to_string()), *known);
                assert_eq!(trigger(&known.to_string().to_lowercase()), *known);
            }
        }
    }
    for key in Key::ALL {
        for bits in 0..8 {
            let mods = Mods {
                command: bits & 1 != 0,
                shift: bits & 2 != 0,
                alt: bits & 4 != 0,
            };
            let pressed = Trigger::Key(mods, *key);
            assert_eq!(trigger(&pressed.to_string()), pressed);
        }
    }
    assert_eq!(trigger("cmd+shift+z"), trigger("Shift+Ctrl+Z"));
}

#[test]
fn what_is_no_trigger_is_refused_in_one_line() {
    for text in [
        "",
        "Ctrl+",
        "Ctrl",
        "Strg+Z",
        "Drag",
        "Drag top",
        "Ctrl+Drag",
        "Wheel up",
        "Hold",
        "Hold Ctrl+W",
        "Hold top",
        "A B",
        "DoubleClick",
        "Ctrl+Shift",
        "💡",
    ] {
        let refused = text.parse::<Trigger>();
        let why = refused.expect_err(text);
        assert!(
            why.contains(&format!("`{text}`")) && !why.contains('\n'),
            "{why}"
        );
    }
}

#[test]
fn labels_are_those_of_the_system() {
    let label = |text: &str| (trigger(text).label(false), trigger(text).label(true));
    let both = |a: &str, b: &str| (a.to_owned(), b.to_owned());
    assert_eq!(label("Ctrl+Shift+Z"), both("Ctrl+Shift+Z", "⇧⌘Z"));
    assert_eq!(label("Alt+Drag left"), both("Alt+left drag", "⌥left drag"));
    assert_eq!(label("Hold Shift"), both("hold Shift", "hold ⇧"));
    assert_eq!(label("Ctrl+Wheel"), both("Ctrl+wheel", "⌘wheel"));
    assert_eq!(label("Left"), both("←", "←"));
}

#[test]
fn keys_give_commands_by_the_layout_and_digits_by_their_place() {
    let bindings = Bindings::default();
    let given = |event: Event| bindings.pressed_by(&event);
    let none = Modifiers::NONE;
    assert_eq!(
        given(press(Key::F, Key::F, none)),
        Some(Action::FrameSelection)
    );
    assert_eq!(given(press(Key::F, Key::F, Modifiers::COMMAND)), None);
    assert_eq!(
        given(press(Key::Z, Key::Y, Modifiers::COMMAND)),
        Some(Action::Undo)
    );
    let redo = Modifiers::COMMAND | Modifiers::SHIFT;
    assert_eq!(given(press(Key::Z, Key::Z, redo)), Some(Action::Redo));
    // Shift and 1 is `!` on many layouts, and the first key of the row is `&` on a French one, which
    // egui does not know and so gives by its place.
    let shifted = press(Key::Exclamationmark, Key::Num1, Modifiers::SHIFT);
    assert_eq!(given(shifted), Some(Action::IntegratorWhitted));
    assert_eq!(
        given(press(Key::Num1, Key::Num1, none)),
        Some(Action::ViewFront)
    );
    assert_eq!(
        given(press(Key::Quote, Key::Num4, Modifiers::SHIFT)),
        Some(Action::IntegratorIds)
    );
    // A letter that is bound to nothing is not another one that has its place elsewhere.
    assert_eq!(bindings.action_for(&trigger("J")), None);
    assert_eq!(given(press(Key::J, Key::H, none)), None);
    // The window system has words of its own for these.
    assert_eq!(given(Event::Copy), Some(Action::CopyCamera));
    assert_eq!(
        given(Event::Paste("x".to_owned())),
        Some(Action::PasteCamera)
    );
    assert_eq!(given(Event::Text("f".to_owned())), None);
    let released = Event::Key {
        key: Key::F,
        physical_key: None,
        pressed: false,
        repeat: false,
        modifiers: none,
    };
    assert_eq!(given(released), None);
    let input = happening(vec![
        press(Key::P, Key::P, none),
        press(Key::Space, Key::Space, none),
    ]);
    assert_eq!(
        bindings.pressed(&input),
        [Action::PauseRender, Action::PlayPause]
    );
}

#[test]
fn a_key_that_is_kept_down_repeats_steps_but_no_switches() {
    let bindings = Bindings::default();
    let kept = |key| Event::Key {
        key,
        physical_key: None,
        pressed: true,
        repeat: true,
        modifiers: Modifiers::NONE,
    };
    assert_eq!(
        bindings.pressed_by(&kept(Key::ArrowLeft)),
        Some(Action::OrbitLeft)
    );
    assert_eq!(
        bindings.pressed_by(&kept(Key::Period)),
        Some(Action::StepForward)
    );
    assert_eq!(bindings.pressed_by(&kept(Key::Space)), None);
    assert_eq!(bindings.pressed_by(&kept(Key::H)), None);
}

#[test]
fn held_keys_fly_and_shift_is_faster() {
    let bindings = Bindings::default();
    let flight = |keys: &[Key], modifiers| bindings.flight(&holding(keys, modifiers));
    let ahead = Flight {
        forward: 1.0,
        pace: 1.0,
        ..Flight::default()
    };
    assert_eq!(flight(&[Key::W], Modifiers::NONE), ahead);
    assert_eq!(
        flight(&[Key::W], Modifiers::SHIFT),
        Flight { pace: 4.0, ..ahead }
    );
    let both = Flight {
        right: -1.0,
        up: 1.0,
        forward: 0.0,
        pace: 1.0,
    };
    let keys = [Key::W, Key::S, Key::A, Key::E];
    assert_eq!(flight(&keys, Modifiers::NONE), both);
    // Ctrl+S saves.
    let still = Flight {
        pace: 1.0,
        ..Flight::default()
    };
    assert_eq!(flight(&[Key::S], Modifiers::COMMAND), still);
}

#[test]
fn the_wheel_counts_in_steps_whatever_is_held() {
    let bindings = Bindings::default();
    let given = |input| bindings.wheel(&input);
    let line = MouseWheelUnit::Line;
    assert_eq!(
        given(scroll(line, 0.0, 2.0, Modifiers::NONE)),
        [(Action::Zoom, 2.0)]
    );
    assert_eq!(
        given(scroll(line, 0.0, -1.0, Modifiers::COMMAND)),
        [(Action::ZoomToCursor, -1.0)]
    );
    assert_eq!(
        given(scroll(line, 0.0, 1.0, Modifiers::ALT)),
        [(Action::PixelZoom, 1.0)]
    );
    let both = Modifiers::ALT | Modifiers::SHIFT;
    assert_eq!(given(scroll(line, 0.0, 1.0, both)), []);
    assert_eq!(
        given(scroll(MouseWheelUnit::Point, 0.0, 50.0, Modifiers::NONE)),
        [(Action::Zoom, 1.0)]
    );
    let mut sideways = Bindings::default();
    sideways
        .set(Action::Zoom, vec![trigger("Shift+Wheel")])
        .expect("a wheel");
    let turned = scroll(line, 3.0, 0.0, Modifiers::SHIFT);
    assert_eq!(sideways.wheel(&turned), [(Action::Zoom, 3.0)]);
    let spread = happening(vec![Event::Zoom(1.0 / 0.85)]);
    let [(action, steps)] = bindings.wheel(&spread)[..] else {
        panic!("one zoom");
    };
    assert!(
        action == Action::ZoomToCursor && (steps - 1.0).abs() < 1e-3,
        "{steps}"
    );
}

#[test]
fn conflicts_are_found_and_the_earlier_command_wins() {
    let mut bindings = Bindings::default();
    bindings
        .set(Action::Quit, vec![trigger("H")])
        .expect("a key");
    let conflict = Conflict {
        trigger: trigger("H"),
        actions: [Action::Help, Action::Quit],
    };
    assert_eq!(bindings.conflicts(), [conflict]);
    assert_eq!(bindings.action_for(&trigger("H")), Some(Action::Help));
    assert_eq!(
        bindings.taken_by(&trigger("H"), Action::Quit),
        [Action::Help]
    );
    bindings.reset(Action::Quit);
    // A key that is held is no key to press. With Shift it is: that makes a flight faster, but begins none.
    bindings
        .set(Action::Quit, vec![trigger("W")])
        .expect("a key");
    assert_eq!(bindings.conflicts().len(), 1);
    assert_eq!(
        bindings.taken_by(&trigger("W"), Action::Quit),
        [Action::FlyForward]
    );
    for text in ["Shift+W", "Ctrl+W", "Alt+W"] {
        bindings
            .set(Action::Quit, vec![trigger(text)])
            .expect("a key");
        assert_eq!(bindings.conflicts(), [], "{text}");
    }
}

#[test]
fn a_command_takes_only_what_suits_it() {
    let mut bindings = Bindings::default();
    let before = bindings.clone();
    for (action, text) in [
        (Action::Orbit, "O"),
        (Action::Orbit, "Click left"),
        (Action::FlyUp, "E"),
        (Action::Undo, "Hold Z"),
        (Action::Undo, "Wheel"),
        (Action::Orbit, "Wheel"),
        (Action::Pan, "Shift+Wheel"),
        (Action::LookAround, "Alt+Wheel"),
    ] {
        let why = bindings.set(action, vec![trigger(text)]).expect_err(text);
        assert!(why.contains(action.name()) && why.contains(text), "{why}");
        assert_eq!(bindings, before);
    }
    assert_eq!(Action::Orbit.manner(), Manner::Motion);
    bindings
        .set(Action::Undo, vec![trigger("Click middle")])
        .expect("a click");
    assert_eq!(
        bindings.click(PointerButton::Middle, Mods::NONE),
        Some(Action::FocusHere)
    );
    bindings
        .set(Action::FocusHere, Vec::new())
        .expect("nothing");
    assert_eq!(bindings.label(Action::FocusHere), "");
    assert_eq!(
        bindings.click(PointerButton::Middle, Mods::NONE),
        Some(Action::Undo)
    );
}

#[test]
fn changes_outlast_another_preset_and_a_file() {
    let mut bindings = Bindings::default();
    bindings
        .set(Action::Undo, vec![trigger("Alt+Backspace")])
        .expect("a key");
    bindings.set(Action::Quit, Vec::new()).expect("nothing");
    bindings.set_preset(Preset::Maya);
    assert_eq!(bindings.label(Action::Quit), "");
    assert_eq!(
        bindings.drag(PointerButton::Primary, Modifiers::ALT),
        Some(Action::Orbit)
    );
    let changes = bindings.changes();
    assert_eq!(changes.len(), 2);
    assert_eq!(changes["undo"], ["Alt+Backspace"]);
    let mut notes = Vec::new();
    assert_eq!(
        Bindings::from_changes(Preset::Maya, &changes, &mut notes),
        bindings
    );
    assert!(notes.is_empty());
    bindings.reset_all();
    assert_eq!(bindings, Bindings::new(Preset::Maya));
    // Setting what the preset has is no change.
    bindings
        .set(Action::FrameAll, vec![trigger("A")])
        .expect("a key");
    assert!(!bindings.is_changed(Action::FrameAll));

    let list = |text: &str| vec![text.to_owned()];
    let odd = BTreeMap::from([
        ("undo".to_owned(), list("Ctrl+U")),
        ("jump".to_owned(), list("J")),
        ("quit".to_owned(), list("Strg+Q")),
        ("orbit".to_owned(), list("O")),
    ]);
    let mut notes = Vec::new();
    let bindings = Bindings::from_changes(Preset::Glimray, &odd, &mut notes);
    assert_eq!(notes.len(), 3, "{notes:?}");
    assert_eq!(
        bindings.changes(),
        BTreeMap::from([("undo".to_owned(), list("Ctrl+U"))])
    );
}

#[test]
fn the_manuals_table_has_every_command_once() {
    let table = markdown_table();
    let mut lines = table.lines();
    assert_eq!(
        lines.next(),
        Some("| | command | Glimray | Blender | Maya |")
    );
    assert_eq!(lines.next(), Some("|---|---|---|---|---|"));
    let rows: Vec<Vec<&str>> = lines
        .map(|line| line.split('|').map(str::trim).collect())
        .collect();
    assert_eq!(rows.len(), Action::ALL.len());
    for (row, action) in rows.iter().zip(Action::ALL) {
        assert_eq!(row.len(), 7, "{row:?}");
        assert_eq!(row[2], action.description());
    }
    let orbit = &rows[0];
    assert_eq!(
        orbit[1..6],
        [
            "**Camera**",
            "Orbit around the pivot",
            "left drag",
            "middle drag",
            "Alt+left drag"
        ]
    );
    assert_eq!(
        rows.iter().filter(|row| row[1].starts_with("**")).count(),
        Category::ALL.len()
    );
}
