//! Undo takes back every edit: a random walk over all commands that edit, by keys, menus and fields.

use super::{ADDITIONS, choose, press, undo_count};
use crate::harness::Window;
use crate::support::random::Random;
use eframe::egui::{Key, Modifiers, Role};
use egui_kittest::kittest::{Queryable, by};
use glimray::export;
use glimray::scene::Scene;
use glimray_viewer::model::bindings::{Action, Preset};
use glimray_viewer::model::objects::Id;

const STEPS: usize = 60;

/// A scene as it is saved.
fn saved(scene: &Scene) -> export::Export {
    export::native(scene, "walk", &|_, _| false).expect("an export")
}

fn now(window: &Window) -> export::Export {
    saved(window.session().scene().expect("a scene"))
}

/// Selects one or several things at random, as the outline does.
fn select(window: &mut Window, random: &mut Random) {
    let scene = super::scene(window);
    let objects = scene.shapes.len() + scene.instances.len() + scene.lights.len();
    let outline = glimray_viewer::model::outline::Outline::of(&scene);
    let ids: Vec<Id> = outline
        .entries
        .iter()
        .filter_map(|entry| entry.id)
        .collect();
    let count = 1 + random.below(3).min(objects);
    let chosen = (0..count).map(|_| ids[random.below(ids.len())]);
    let mut chosen: Vec<Id> = chosen.collect();
    chosen.dedup();
    window.session().select(chosen);
    window.harness.run_steps(2);
}

/// Changes a number of the properties, if there is one.
fn change_a_field(window: &mut Window, random: &mut Random) {
    let is_number = |node: &egui_kittest::kittest::AccessKitNode<'_>| {
        node.role() == Role::SpinButton && !node.is_disabled()
    };
    let fields: Vec<_> = window
        .harness
        .query_all(by().predicate(is_number))
        .collect();
    if fields.is_empty() {
        return;
    }
    let field = &fields[random.below(fields.len())];
    field.set_value_accesskit(random.between(0.1, 2.0));
}

/// Ends a movement, if one has begun: cameras and materials are not moved.
fn finish(window: &mut Window, [axis, digit]: [Key; 2]) {
    if window.session().editing.modal.is_some() {
        for key in [axis, digit, Key::Enter] {
            press(window, Modifiers::NONE, key);
        }
    }
}

fn edit(window: &mut Window, random: &mut Random) -> String {
    let what = random.below(16);
    select(window, random);
    let axis = [Key::X, Key::Y, Key::Z][random.below(3)];
    let digit = [Key::Num1, Key::Num2, Key::Num3][random.below(3)];
    let tool = [Key::G, Key::R, Key::S][random.below(3)];
    match what {
        0..=3 => {
            choose(window, "Add", ADDITIONS[random.below(ADDITIONS.len())]);
            finish(window, [axis, digit]);
        }
        4..=5 => {
            press(window, Modifiers::SHIFT, Key::D);
            finish(window, [axis, digit]);
        }
        6 => press(window, Modifiers::NONE, Key::Delete),
        7 => press(window, Modifiers::NONE, Key::H),
        8..=9 => {
            press(window, Modifiers::NONE, tool);
            finish(window, [axis, digit]);
        }
        10..=12 => change_a_field(window, random),
        13 => {
            let id = window.session().selection;
            if let Some(id) = id {
                window.session().hide_others(id);
            }
        }
        14 => window.session().show_all(),
        _ => {
            window.session().clicked.push(Action::Revert);
        }
    }
    window.settle();
    format!("{what} {axis:?} {digit:?} {tool:?}")
}

#[test]
fn a_random_walk_over_all_edits_is_taken_back_to_the_same_bytes() {
    let mut random = Random::new(56);
    let (_folder, mut window) = super::new_scene();
    window
        .session()
        .preferences
        .bindings
        .set_preset(Preset::Blender);
    let mut states = vec![now(&window)];
    let mut done = Vec::new();
    for step in 0..STEPS {
        let what = edit(&mut window, &mut random);
        let count = undo_count(&window);
        assert!(
            count <= states.len(),
            "step {step} ({what}) is more than one"
        );
        match count == states.len() {
            true => {
                states.push(now(&window));
                done.push(what);
            }
            false => assert_eq!(Some(&now(&window)), states.last(), "step {step} ({what})"),
        }
    }
    assert!(done.len() > STEPS / 2, "most edits did nothing: {done:?}");
    for count in (0..done.len()).rev() {
        press(&mut window, Modifiers::COMMAND, Key::Z);
        assert_eq!(now(&window), states[count], "{} is not undone", done[count]);
    }
    for count in 1..states.len() {
        press(&mut window, Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
        assert_eq!(
            now(&window),
            states[count],
            "{} is not done again",
            done[count - 1]
        );
    }
}
