//! Everything that can be clicked, dragged or typed into has a name that is read aloud.

use crate::harness::Window;
use eframe::egui::{Key, Role};
use egui_kittest::kittest::{NodeT, Queryable, by};
use glimray::scene::ObjectRef;
use glimray_viewer::actions::comparing;
use glimray_viewer::actions::inspector;
use glimray_viewer::actions::saving;
use glimray_viewer::model::objects::Id;
use glimray_viewer::model::tool::Tool;
use glimray_viewer::model::view_settings::{ErrorMap, Sharing};
use glimray_viewer::state::dialogs::Dialog;
use glimray_viewer::state::files::Intent;

/// Roles of interactive controls.
pub const CONTROLS: [Role; 18] = [
    Role::Button,
    Role::CheckBox,
    Role::ColorWell,
    Role::ComboBox,
    Role::DisclosureTriangle,
    Role::Link,
    Role::ListBoxOption,
    Role::MenuItem,
    Role::MenuItemCheckBox,
    Role::MenuItemRadio,
    Role::MultilineTextInput,
    Role::RadioButton,
    Role::SearchInput,
    Role::Slider,
    Role::SpinButton,
    Role::Switch,
    Role::Tab,
    Role::TextInput,
];

fn open(scene: &str) -> Window {
    let path = format!("assets/scenes/{scene}");
    let mut window = Window::open(&[&path, "--size", "64x36", "--samples", "1"]);
    window.settle();
    window
}

/// Asks for the name of everything in the window.
#[track_caller]
fn check(window: &mut Window, what: &str) {
    window.settle();
    let is_control =
        |node: &egui_kittest::kittest::AccessKitNode<'_>| CONTROLS.contains(&node.role());
    let mut count = 0;
    for node in window.harness.query_all(by().predicate(is_control)) {
        let node = node.accesskit_node();
        let name = node.label().unwrap_or_default();
        assert!(
            !name.trim().is_empty(),
            "{what}: a {:?} at {:?} has no name",
            node.role(),
            node.bounding_box()
        );
        count += 1;
    }
    assert!(count > 20, "{what}: {count} controls");
}

#[test]
fn what_is_in_the_panels_has_a_name() {
    let mut window = open("orbits.toml");
    check(&mut window, "nothing selected");
    let ids = [
        Id::Object(ObjectRef::Shape(0)),
        Id::Object(ObjectRef::Light(0)),
        Id::Object(ObjectRef::Light(1)),
        Id::Object(ObjectRef::Light(2)),
        Id::Node(0),
        Id::Camera(0),
        Id::Material(0),
    ];
    for id in ids {
        window.session().selection = Some(id);
        check(&mut window, &format!("{id:?}"));
    }
    window.session().begin_rename();
    check(&mut window, "a name is typed");
    window.session().editing.renaming = None;
    window.session().selection = Some(ids[0]);
    for &tool in Tool::ALL {
        window.session().tool = tool;
        check(&mut window, &format!("{tool:?}"));
    }
    let look = |window: &Window| {
        let look = &mut window.session().view;
        look.region = Some([0.25, 0.25, 0.75, 0.75]);
        look.tone.exposure_ev += 1.0;
        look.settings.max_depth += 1;
    };
    look(&window);
    for sharing in [
        Sharing::Wipe(0.5),
        Sharing::SideBySide,
        Sharing::Difference(ErrorMap::absolute(4.0)),
    ] {
        window.session().view.compare(sharing);
        check(&mut window, &format!("{sharing:?}"));
    }
    comparing::keep_snapshot(&mut window.session());
    window.settle();
    window.session().view.comparison = None;
    window
        .session()
        .view
        .compare(Sharing::Difference(ErrorMap::absolute(4.0)));
    check(&mut window, "a snapshot");
}

#[test]
fn what_is_in_the_inspector_has_a_name() {
    let mut window = open("glass_and_mirrors.toml");
    window.harness.key_press(Key::I);
    window.settle();
    inspector::inspect(&mut window.session(), [31, 18]);
    window.settle();
    window.session().inspector.select((0, 0));
    check(&mut window, "rays");
}

#[test]
fn what_is_in_sheets_and_questions_has_a_name() {
    let mut window = open("sphere.scene");
    for dialog in [
        Dialog::Shortcuts,
        Dialog::Preferences,
        Dialog::Hint,
        Dialog::Messages,
        Dialog::Cameras,
    ] {
        window.harness.key_press(Key::K);
        window.settle();
        window.session().dialogs.open(dialog);
        check(&mut window, &format!("{dialog:?}"));
        window.session().dialogs.close(dialog);
    }
    window.session().files.undecided = Some(Intent::Close);
    check(&mut window, "unsaved changes");
    window.session().files.undecided = None;
    window.session().files.typed = Some("x".to_owned());
    check(&mut window, "a path");
    window.session().files.typed = None;
    window.settle();
    window.harness.key_press(Key::F12);
    window.settle();
    for ending in ["png", "jpg"] {
        if let Some(dialog) = &mut window.session().files.saving {
            dialog.path = format!("picture.{ending}");
        }
        check(&mut window, ending);
    }
    window.session().files.saving = None;
    saving::ask(&mut window.session());
    check(&mut window, "a scene");
}

#[test]
fn what_is_in_menus_has_a_name() {
    let mut window = open("sphere.scene");
    for menu in ["File", "Edit", "View", "Render", "Window", "Help"] {
        // Panels may be called the same; the bar is above them.
        let found = window.harness.get_all_by_label(menu).next();
        found.expect("a menu").click();
        check(&mut window, menu);
        window.harness.key_press(Key::Escape);
        window.harness.run_steps(3);
    }
}
