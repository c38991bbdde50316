//! Undo takes back every edit: a random walk over all that edits, by keys, menus, fields, and drags in the picture.

use super::{ADDITIONS, choose, press, undo_count};
use crate::edit::{drag, file, open, scene};
use crate::harness::Window;
use crate::support::PATIENCE;
use crate::support::random::Random;
use crate::{lighting, textures};
use eframe::egui::{Key, Modifiers, Role, vec2};
use egui_kittest::Node;
use egui_kittest::kittest::{NodeT, Queryable, by};
use glimray::export;
use glimray::render::Integrator;
use glimray::scene::{LightKind, Material, ObjectRef, Scene};
use glimray_viewer::model::bindings::{Action, Preset};
use glimray_viewer::model::handles::Eye;
use glimray_viewer::model::handles::lamp::Lamp;
use glimray_viewer::model::objects::{self, Id};
use glimray_viewer::model::outline::Outline;
use std::collections::BTreeSet;
use std::ops::Range;
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// The additions that are surfaces, and those that are lamps of which a handle changes the size.
const SURFACES: Range<usize> = 0..10;
const LAMPS: Range<usize> = 12..16;
/// Length of the direction of a lamp in the picture, in points.
const REACH: f32 = 130.0;

/// Whether something of a scene is of a kind.
type Kind = fn(&Scene, Id) -> bool;

/// Makes an edit.
type Edit = fn(&mut Walk);

struct Walk {
    window: Window,
    random: Random,
    /// The folder of pictures.
    folder: TempDir,
}

/// The edits of the walk by name, and how many times it makes each.
const EDITS: [(&str, usize, Edit); 22] = [
    ("add", 3, |walk| walk.add(0..ADDITIONS.len())),
    ("duplicate", 3, |walk| {
        walk.select(|_, _| true);
        press(&mut walk.window, Modifiers::SHIFT, Key::D);
        walk.finish();
    }),
    ("delete", 2, |walk| {
        walk.select(is_object);
        press(&mut walk.window, Modifiers::NONE, Key::Delete);
    }),
    ("hide", 2, |walk| {
        walk.select(is_object);
        press(&mut walk.window, Modifiers::NONE, Key::H);
    }),
    ("hide others", 1, |walk| {
        walk.select(is_object);
        let id = walk.window.session().selection;
        walk.window.session().hide_others(id.expect("a selection"));
    }),
    ("show all", 1, |walk| walk.window.session().show_all()),
    ("transform", 3, |walk| {
        walk.select(is_object);
        let tool = [Key::G, Key::R, Key::S][walk.random.below(3)];
        press(&mut walk.window, Modifiers::NONE, tool);
        walk.finish();
    }),
    ("number", 4, |walk| {
        walk.select(|_, _| true);
        walk.number(|_| true);
    }),
    ("number of lamps", 3, |walk| {
        walk.select(is_lamp);
        walk.number(|_| true);
    }),
    ("number of surfaces", 4, |walk| {
        walk.select(is_surface);
        walk.number(|_| true);
    }),
    ("choice", 5, |walk| {
        walk.select(is_surface);
        walk.choice(|_| true);
    }),
    ("toggle", 3, |walk| {
        walk.select(is_surface);
        walk.click(Role::CheckBox, |label| label.starts_with("Two-sided"));
    }),
    ("preset", 3, |walk| {
        walk.select(is_surface);
        walk.choice(|label| label == "Preset");
    }),
    ("open a texture", 4, |walk| {
        walk.select(is_surface);
        walk.texture("Open ");
    }),
    ("replace a texture", 2, |walk| {
        walk.select(has_texture);
        walk.texture("Replace ");
    }),
    ("remove a texture", 2, |walk| {
        walk.select(has_texture);
        walk.texture("Remove ");
    }),
    ("place a texture", 4, Walk::place_texture),
    ("drag a handle of a lamp", 5, Walk::drag_a_lamp),
    ("turn the environment", 3, |walk| {
        walk.select_ids(Vec::new());
        let [x, y] = [0, 1].map(|_| walk.random.between(-60.0, 60.0) as f32);
        lighting::turn(&mut walk.window, vec2(x, y));
    }),
    ("number of the scene", 3, |walk| {
        walk.select_ids(Vec::new());
        walk.number(|_| true);
    }),
    ("choice of the scene", 2, |walk| {
        walk.select_ids(Vec::new());
        walk.choice(|_| true);
    }),
    ("revert", 1, |walk| {
        walk.window.session().clicked.push(Action::Revert);
    }),
];

fn is_object(_: &Scene, id: Id) -> bool {
    matches!(id, Id::Object(_))
}

fn is_lamp(_: &Scene, id: Id) -> bool {
    matches!(id, Id::Object(ObjectRef::Light(_)))
}

fn has_handles(scene: &Scene, id: Id) -> bool {
    match id {
        Id::Object(ObjectRef::Light(index)) => {
            !matches!(scene.lights[index].kind, LightKind::Point { .. })
        }
        _ => false,
    }
}

fn is_surface(scene: &Scene, id: Id) -> bool {
    is_object(scene, id) && !is_lamp(scene, id)
}

fn has_texture(scene: &Scene, id: Id) -> bool {
    match id {
        Id::Material(index) => scene.materials[index].texture_indices().next().is_some(),
        _ => false,
    }
}

impl Walk {
    /// The scene as it is saved.
    fn saved(&self) -> export::Export {
        let scene = scene(&self.window);
        export::native(&scene, "walk", &|_, _| false).expect("an export")
    }

    fn select_ids(&mut self, ids: Vec<Id>) {
        self.window.session().select(ids);
        self.window.harness.run_steps(2);
    }

    /// Selects one or several things of a kind at random, if there are any.
    fn select(&mut self, is_it: Kind) {
        let scene = scene(&self.window);
        let entries = Outline::of(&scene).entries;
        let ids = entries.iter().filter_map(|entry| entry.id);
        let ids: Vec<Id> = ids.filter(|id| is_it(&scene, *id)).collect();
        let count = (1 + self.random.below(3)).min(ids.len());
        let mut chosen: Vec<Id> = Vec::new();
        for _ in 0..count {
            let id = ids[self.random.below(ids.len())];
            if !chosen.contains(&id) {
                chosen.push(id);
            }
        }
        self.select_ids(chosen);
    }

    /// Adds one of these.
    fn add(&mut self, which: Range<usize>) {
        let index = which.start + self.random.below(which.len());
        choose(&mut self.window, "Add", ADDITIONS[index]);
        self.finish();
    }

    /// Ends a movement, if one has begun: cameras and materials are not moved.
    fn finish(&mut self) {
        let axis = [Key::X, Key::Y, Key::Z][self.random.below(3)];
        let digit = [Key::Num1, Key::Num2, Key::Num3][self.random.below(3)];
        if self.window.session().editing.modal.is_some() {
            for key in [axis, digit, Key::Enter] {
                press(&mut self.window, Modifiers::NONE, key);
            }
        }
    }

    /// One of the properties at random, which are left of the picture.
    fn field(&mut self, role: Role, is_it: impl Fn(&str) -> bool) -> Option<Node<'_>> {
        let left = (self.window.session().viewport).map_or(0.0, |it| it.rect.left());
        let is_field = |node: &Node| {
            let own = node.accesskit_node();
            !own.is_disabled()
                && node.rect().right() <= left
                && is_it(&own.label().unwrap_or_default())
        };
        let nodes = (self.window.harness).query_all(by().role(role));
        let mut fields: Vec<_> = nodes.filter(is_field).collect();
        match fields.len() {
            0 => None,
            count => Some(fields.swap_remove(self.random.below(count))),
        }
    }

    /// Changes a number of the properties, if there is one.
    fn number(&mut self, is_it: impl Fn(&str) -> bool) {
        let value = self.random.between(0.1, 2.0);
        if let Some(field) = self.field(Role::SpinButton, is_it) {
            field.set_value_accesskit(value);
        }
    }

    /// Clicks one of the properties, if there is one.
    fn click(&mut self, role: Role, is_it: impl Fn(&str) -> bool) -> bool {
        let field = self.field(role, is_it);
        let is_there = field.is_some();
        if let Some(field) = field {
            field.click_accesskit();
        }
        self.window.harness.run_steps(4);
        is_there
    }

    /// Chooses another option of the properties, if there is a choice.
    fn choice(&mut self, is_it: impl Fn(&str) -> bool) {
        let buttons = |walk: &Self| -> BTreeSet<String> {
            let nodes = (walk.window.harness).query_all(by().role(Role::Button));
            nodes
                .map(|it| format!("{:?}", it.accesskit_node().id()))
                .collect()
        };
        let before = buttons(self);
        if self.click(Role::ComboBox, is_it) {
            let nodes = (self.window.harness).query_all(by().role(Role::Button));
            let is_new = |it: &Node| !before.contains(&format!("{:?}", it.accesskit_node().id()));
            let options: Vec<_> = nodes.filter(is_new).collect();
            options[self.random.below(options.len())].click_accesskit();
            // Such a click leaves the list open.
            self.window.harness.run_steps(2);
            press(&mut self.window, Modifiers::NONE, Key::Escape);
        }
    }

    /// Presses a button of a texture. File dialogs answer with one of two pictures.
    fn texture(&mut self, button: &str) {
        let (name, right) = [
            ("green.png", [0, 255, 0, 255]),
            ("blue.png", [0, 0, 255, 255]),
        ][self.random.below(2)];
        let path = textures::picture(&self.folder.path().join(name), right);
        textures::answer(&self.window, &path);
        self.unfold_textures();
        let before = undo_count(&self.window);
        let is_pressed = self.click(Role::Button, |label| {
            label.starts_with(button) && (label.contains('×') || label.contains(" map"))
        });
        // A thread reads the picture.
        let start = Instant::now();
        while is_pressed && undo_count(&self.window) == before {
            assert!(start.elapsed() < PATIENCE, "no picture");
            self.window.harness.step();
            std::thread::sleep(Duration::from_millis(2));
        }
    }

    fn unfold_textures(&mut self) {
        let title = |label: &str| label == "Textures";
        let heading = self.field(Role::DisclosureTriangle, title);
        let is_folded =
            heading.is_some_and(|it| it.accesskit_node().toggled() != Some(true.into()));
        if is_folded {
            self.click(Role::DisclosureTriangle, title);
        }
    }

    /// Shifts, repeats, turns or mirrors a picture on its surface.
    fn place_texture(&mut self) {
        self.select(has_texture);
        self.unfold_textures();
        let is_placement = |label: &str| {
            ["Offset", "Repeats", "Turn"]
                .iter()
                .any(|it| label.starts_with(it))
        };
        if self.field(Role::SpinButton, is_placement).is_none() {
            let is_fold = |label: &str| label.starts_with("Placement of ");
            self.click(Role::DisclosureTriangle, is_fold);
        }
        match self.random.below(3) {
            0 => self.choice(|label| label.starts_with("Wrap ")),
            _ => self.number(is_placement),
        }
    }

    /// Aims or resizes a lamp by one of its handles.
    fn drag_a_lamp(&mut self) {
        self.select(has_handles);
        let selection = self.window.session().selection;
        let Some(id @ Id::Object(ObjectRef::Light(index))) = selection else {
            return;
        };
        // Only one alone has handles, and they are seen from near it.
        self.window.session().frame(id);
        self.window.settle();
        let viewport = self.window.session().viewport.expect("a picture");
        let (scene, camera) = (scene(&self.window), self.window.camera());
        let kind = scene.frame(0.0).lights[index].kind;
        let pivot = (self.window.session().controller.as_ref())
            .expect("a camera")
            .pivot();
        let eye = Eye {
            camera: &camera,
            size: viewport.extent(),
        };
        let lamp = Lamp::new(kind, eye, viewport.length(vec2(REACH, 0.0)).x, pivot);
        let places = lamp.handles(eye, objects::freedom(&scene, id)).into_iter();
        let places = places.filter_map(|(_, at)| Some(viewport.point(eye.project(at)?)));
        let inside = viewport.rect.shrink(4.0);
        let places: Vec<_> = places.filter(|at| inside.contains(*at)).collect();
        if places.is_empty() {
            return;
        }
        let from = places[self.random.below(places.len())];
        let [x, y] = [0, 1].map(|_| self.random.between(-50.0, 50.0) as f32);
        drag(&mut self.window, from, from + vec2(x, y));
    }

    /// A thing that edits need and the scene lacks, and how to add it.
    fn lacks(&self) -> Option<(&'static str, Edit)> {
        let scene = scene(&self.window);
        let lamps = 0..scene.lights.len();
        let lamps = lamps.map(|index| Id::Object(ObjectRef::Light(index)));
        let textures = scene.materials.iter().flat_map(Material::texture_indices);
        if scene.shapes.len() + scene.instances.len() < 3 {
            Some(("add", |walk| walk.add(SURFACES)))
        } else if lamps.filter(|id| has_handles(&scene, *id)).count() < 2 {
            Some(("add", |walk| walk.add(LAMPS)))
        } else if textures.count() == 0 {
            Some(("open a texture", |walk| {
                walk.select(is_surface);
                walk.texture("Open ");
            }))
        } else {
            None
        }
    }
}

#[test]
fn a_random_walk_over_all_edits_is_taken_back_to_the_same_bytes() {
    let (folder, path) = file();
    let mut window = open(&path, "400x300");
    press(&mut window, Modifiers::COMMAND, Key::N);
    window.settle();
    window
        .session()
        .preferences
        .bindings
        .set_preset(Preset::Blender);
    // Steps need no light, whose kernels take long to compile.
    window.session().view.settings.integrator = Integrator::Normals;
    let random = Random::new(56);
    let mut walk = Walk {
        window,
        random,
        folder,
    };
    let mut todo: Vec<_> = (EDITS.iter())
        .flat_map(|(name, count, edit)| vec![(*name, *edit); *count])
        .collect();
    let mut states = vec![walk.saved()];
    let mut done: Vec<(&str, String)> = Vec::new();
    while !todo.is_empty() {
        let (name, edit) = match walk.lacks() {
            Some(needed) => needed,
            None => todo.swap_remove(walk.random.below(todo.len())),
        };
        edit(&mut walk);
        walk.window.harness.run_steps(6);
        let count = undo_count(&walk.window);
        let what = {
            let session = walk.window.session();
            let document = session.document.as_ref().expect("a document");
            document.undo_name().unwrap_or_default().to_owned()
        };
        let step = states.len();
        assert!(
            count <= step,
            "step {step} ({name}: {what}) is more than one"
        );
        match count == step {
            true => {
                states.push(walk.saved());
                done.push((name, what));
            }
            false => assert_eq!(Some(&walk.saved()), states.last(), "step {step} ({name})"),
        }
    }
    for (name, ..) in EDITS {
        assert!(
            done.iter().any(|it| it.0 == name),
            "no step: {name}, of {done:?}"
        );
    }
    for count in (0..done.len()).rev() {
        press(&mut walk.window, Modifiers::COMMAND, Key::Z);
        assert_eq!(
            walk.saved(),
            states[count],
            "{:?} is not undone",
            done[count]
        );
    }
    for count in 1..states.len() {
        press(
            &mut walk.window,
            Modifiers::COMMAND | Modifiers::SHIFT,
            Key::Z,
        );
        let again = &done[count - 1];
        assert_eq!(walk.saved(), states[count], "{again:?} is not done again");
    }
}
