//! The table of keyboard and mouse bindings. Lookups, the shortcuts dialog and the table in the manual are
//! made from it.

mod action;
mod preset;
mod trigger;

pub use action::{Action, Category, Manner};
pub use preset::Preset;
pub use trigger::{Mods, Trigger};

use crate::model::camera::Flight;
use eframe::egui::{Event, InputState, Key, MouseWheelUnit, PointerButton, Pos2};
use std::collections::BTreeMap;
use std::fmt::Write;

/// Converts lines or points of wheel and trackpad scrolling into wheel steps.
const STEPS_OF_LINE: f64 = 1.0;
const STEPS_OF_POINT: f64 = 1.0 / 50.0;
const STEPS_OF_PAGE: f64 = 5.0;

/// The steps by which an event turns the wheel: 0 for other events.
pub fn wheel_steps(event: &Event) -> f64 {
    let Event::MouseWheel { unit, delta, .. } = event else {
        return 0.0;
    };
    let steps = match unit {
        MouseWheelUnit::Line => STEPS_OF_LINE,
        MouseWheelUnit::Point => STEPS_OF_POINT,
        MouseWheelUnit::Page => STEPS_OF_PAGE,
    };
    // With Shift, some systems scroll horizontally.
    steps * f64::from(if delta.y == 0.0 { delta.x } else { delta.y })
}

/// A preset and the changes made to it.
#[derive(Clone, Debug, PartialEq)]
pub struct Bindings {
    preset: Preset,
    changed: BTreeMap<Action, Vec<Trigger>>,
    /// The preset with the changes applied.
    current: BTreeMap<Action, Vec<Trigger>>,
}

impl Default for Bindings {
    fn default() -> Self {
        Self::new(Preset::default())
    }
}

/// A drag in the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drag {
    /// The command, chosen when it started.
    pub action: Action,
    /// Where it started, on the screen.
    pub from: Pos2,
}

/// Two commands with the same trigger.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Conflict {
    /// The trigger of the first command.
    pub trigger: Trigger,
    /// Both commands, in the order of the table.
    pub actions: [Action; 2],
}

impl Bindings {
    /// The unchanged bindings of a preset.
    pub fn new(preset: Preset) -> Self {
        Self::with(preset, BTreeMap::new())
    }

    fn with(preset: Preset, changed: BTreeMap<Action, Vec<Trigger>>) -> Self {
        let mut current = preset.bindings();
        for (action, triggers) in &changed {
            current.insert(*action, triggers.clone());
        }
        Self {
            preset,
            changed,
            current,
        }
    }

    /// The preset that the bindings are based on.
    pub fn preset(&self) -> Preset {
        self.preset
    }

    /// Switches to another preset; changes are kept.
    pub fn set_preset(&mut self, preset: Preset) {
        *self = Self::with(preset, std::mem::take(&mut self.changed));
    }

    /// The triggers of a command, the primary one first; empty if it has none.
    pub fn triggers(&self, action: Action) -> &[Trigger] {
        self.current.get(&action).map_or(&[], Vec::as_slice)
    }

    /// Whether a command's triggers differ from the preset's.
    pub fn is_changed(&self, action: Action) -> bool {
        self.changed.contains_key(&action)
    }

    /// Replaces the triggers of a command; an empty list removes them.
    ///
    /// # Errors
    /// A trigger does not suit the command, such as a key for a drag. Nothing is changed then.
    pub fn set(&mut self, action: Action, triggers: Vec<Trigger>) -> Result<(), String> {
        if let Some(trigger) = triggers.iter().find(|trigger| !suits(action, trigger)) {
            return Err(format!(
                "cannot assign {trigger} to “{}”: it requires {}",
                action.name(),
                match action.manner() {
                    Manner::Press => "a key, a click or a double click",
                    Manner::Hold => "a key to hold",
                    Manner::Motion if zooms(action) => "a drag or the wheel",
                    Manner::Motion => "a drag",
                }
            ));
        }
        let mut preset = self.preset.bindings();
        if preset.remove(&action).unwrap_or_default() == triggers {
            self.changed.remove(&action);
        } else {
            self.changed.insert(action, triggers);
        }
        *self = Self::with(self.preset, std::mem::take(&mut self.changed));
        Ok(())
    }

    /// Restores the preset's triggers of a command.
    pub fn reset(&mut self, action: Action) {
        self.changed.remove(&action);
        *self = Self::with(self.preset, std::mem::take(&mut self.changed));
    }

    /// Restores the preset's triggers of all commands.
    pub fn reset_all(&mut self) {
        *self = Self::new(self.preset);
    }

    /// Pairs of commands with ambiguous triggers; the earlier one in the table wins.
    pub fn conflicts(&self) -> Vec<Conflict> {
        let mut found = Vec::new();
        for (i, &first) in Action::ALL.iter().enumerate() {
            for &second in &Action::ALL[i + 1..] {
                let collides = |trigger: &&Trigger| {
                    let others = self.triggers(second).iter();
                    others.clone().any(|other| trigger.collides(other))
                };
                let meet = first.is_of_handles() == second.is_of_handles();
                if let Some(trigger) = self.triggers(first).iter().find(collides).filter(|_| meet) {
                    found.push(Conflict {
                        trigger: *trigger,
                        actions: [first, second],
                    });
                }
            }
        }
        found
    }

    /// The other commands that have `trigger`, or one that is ambiguous with it.
    pub fn taken_by(&self, trigger: &Trigger, action: Action) -> Vec<Action> {
        let actions = Action::ALL.iter().copied();
        let takes = |other: &Action| self.triggers(*other).iter().any(|t| t.collides(trigger));
        actions
            .filter(|other| *other != action && other.is_of_handles() == action.is_of_handles())
            .filter(takes)
            .collect()
    }

    /// The command that `trigger` performs.
    pub fn action_for(&self, trigger: &Trigger) -> Option<Action> {
        let mut actions = Action::ALL.iter().copied();
        actions.find(|action| self.triggers(*action).contains(trigger))
    }

    /// The commands of the keys in this frame, in the order of their events. Call this only while no text is
    /// being edited.
    pub fn pressed(&self, input: &InputState) -> Vec<Action> {
        let events = input.events.iter();
        events.filter_map(|event| self.pressed_by(event)).collect()
    }

    /// The command of one event. Key repeat counts only for commands that can repeat.
    pub fn pressed_by(&self, event: &Event) -> Option<Action> {
        let [logical, physical] = Trigger::pressed(event)?;
        let action = logical
            .and_then(|trigger| self.action_for(&trigger))
            .or_else(|| {
                // Letters are where the layout says.
                let trigger = physical.filter(|trigger| !is_letter(trigger))?;
                self.action_for(&trigger)
            })?;
        let again = matches!(event, Event::Key { repeat: true, .. });
        (!again || repeats(action)).then_some(action)
    }

    /// The direction to fly in, from the keys that are held. Call this only while no text is being edited.
    pub fn flight(&self, input: &InputState) -> Flight {
        let held = |action| self.is_held(action, input);
        let axis = |more, less| f64::from(i8::from(held(more)) - i8::from(held(less)));
        Flight {
            right: axis(Action::FlyRight, Action::FlyLeft),
            up: axis(Action::FlyUp, Action::FlyDown),
            forward: axis(Action::FlyForward, Action::FlyBack),
            pace: if held(Action::FlyFaster) { 4.0 } else { 1.0 },
        }
    }

    /// Whether an event presses a key that flies.
    pub fn flies(&self, event: &Event) -> bool {
        let Event::Key { key, .. } = event else {
            return false;
        };
        let triggers = self.current.values().flatten();
        triggers
            .copied()
            .any(|trigger| trigger == Trigger::Hold(*key))
    }

    /// Whether a continuous command is active.
    pub fn is_held(&self, action: Action, input: &InputState) -> bool {
        let mods = Mods::from(input.modifiers);
        self.triggers(action).iter().any(|trigger| match *trigger {
            Trigger::Hold(key) => !mods.command && !mods.alt && input.key_down(key),
            Trigger::HoldMods(held) => mods.include(held),
            _ => false,
        })
    }

    /// The command of a drag that starts with this button and these modifiers. It stays the same until the
    /// drag ends.
    pub fn drag(&self, button: PointerButton, mods: impl Into<Mods>) -> Option<Action> {
        self.action_for(&Trigger::Drag(mods.into(), button))
    }

    /// The command of a click.
    pub fn click(&self, button: PointerButton, mods: impl Into<Mods>) -> Option<Action> {
        self.action_for(&Trigger::Click(mods.into(), button))
    }

    /// The command of a double click.
    pub fn double_click(&self, button: PointerButton, mods: impl Into<Mods>) -> Option<Action> {
        self.action_for(&Trigger::DoubleClick(mods.into(), button))
    }

    /// The commands of the wheel in this frame and their steps, positive upwards. They are read from the raw
    /// events, because egui handles the wheel with Ctrl and Shift itself. A pinch zooms to the cursor.
    pub fn wheel(&self, input: &InputState) -> Vec<(Action, f64)> {
        let events = input.events.iter();
        events.filter_map(|event| self.wheel_by(event)).collect()
    }

    fn wheel_by(&self, event: &Event) -> Option<(Action, f64)> {
        match event {
            Event::MouseWheel { modifiers, .. } => {
                let action = self.action_for(&Trigger::Wheel(Mods::from(*modifiers)))?;
                let steps = wheel_steps(event);
                (steps != 0.0).then_some((action, steps))
            }
            Event::Zoom(factor) if *factor > 0.0 => {
                // One step is a factor of 1 / 0.85.
                Some((Action::ZoomToCursor, f64::from(*factor).ln() / 0.1625))
            }
            _ => None,
        }
    }

    /// All triggers of a command as text, such as `Delete, Backspace`; empty if it has none.
    pub fn label(&self, action: Action) -> String {
        self.label_on(action, cfg!(target_os = "macos"))
    }

    /// The first trigger of a command as text, as menus show it; empty if it has none.
    pub fn shortcut(&self, action: Action) -> String {
        let first = self.triggers(action).first();
        first.map_or_else(String::new, |it| it.label(cfg!(target_os = "macos")))
    }

    /// A tooltip with the triggers of a command, such as `Delete the selection (Delete)`.
    pub fn tip(&self, text: &str, action: Action) -> String {
        match self.label(action) {
            keys if keys.is_empty() => text.to_owned(),
            keys => format!("{text} ({keys})"),
        }
    }

    fn label_on(&self, action: Action, mac: bool) -> String {
        let triggers = self.triggers(action).iter();
        let labels: Vec<_> = triggers.map(|trigger| trigger.label(mac)).collect();
        labels.join(", ")
    }

    /// The changed commands by name with their triggers, for a settings file.
    pub fn changes(&self) -> BTreeMap<String, Vec<String>> {
        let texts = |triggers: &Vec<Trigger>| triggers.iter().map(Trigger::to_string).collect();
        let changed = self.changed.iter();
        changed
            .map(|(action, triggers)| (action.name().to_owned(), texts(triggers)))
            .collect()
    }

    /// Reads changes from a settings file. Invalid ones are left out and reported in `notes`, one clause
    /// each.
    pub fn from_changes(
        preset: Preset,
        changes: &BTreeMap<String, Vec<String>>,
        notes: &mut Vec<String>,
    ) -> Self {
        let mut bindings = Self::new(preset);
        for (name, texts) in changes {
            let Some(action) = Action::from_name(name) else {
                notes.push(format!("unknown command `{name}`"));
                continue;
            };
            let triggers = texts.iter().map(|text| text.parse());
            let set = triggers
                .collect::<Result<Vec<_>, _>>()
                .and_then(|triggers| bindings.set(action, triggers));
            if let Err(why) = set {
                notes.push(format!("shortcut of `{name}`: {why}"));
            }
        }
        bindings
    }
}

/// All commands with their triggers in each preset, as a Markdown table.
pub fn markdown_table() -> String {
    let presets = Preset::ALL.map(Bindings::new);
    let mut text = String::from("| | command |");
    for preset in Preset::ALL {
        let _ = write!(text, " {} |", preset.title());
    }
    text.push_str("\n|---|---|");
    text.push_str(&"---|".repeat(presets.len()));
    text.push('\n');
    let mut last = None;
    for &action in Action::ALL {
        let category = action.category();
        let title = match last {
            Some(last) if last == category => String::new(),
            _ => format!("**{}**", category.title()),
        };
        last = Some(category);
        let _ = write!(text, "| {title} | {} |", action.description());
        for bindings in &presets {
            let _ = write!(text, " {} |", bindings.label_on(action, false));
        }
        text.push('\n');
    }
    text
}

fn suits(action: Action, trigger: &Trigger) -> bool {
    use Trigger::{Click, DoubleClick, Drag, Hold, HoldMods, Key, Wheel};
    match action.manner() {
        Manner::Press => matches!(trigger, Key(..) | Click(..) | DoubleClick(..)),
        Manner::Hold => matches!(trigger, Hold(_) | HoldMods(_)),
        Manner::Motion => {
            matches!(trigger, Drag(..)) || zooms(action) && matches!(trigger, Wheel(_))
        }
    }
}

/// Whether the wheel can trigger the action.
pub fn zooms(action: Action) -> bool {
    matches!(
        action,
        Action::Zoom | Action::ZoomToCursor | Action::PixelZoom
    )
}

fn is_letter(trigger: &Trigger) -> bool {
    matches!(trigger, Trigger::Key(_, key) if (Key::A..=Key::Z).contains(key))
}

/// Whether key repeat performs the command again.
fn repeats(action: Action) -> bool {
    use Action as A;
    matches!(
        action,
        A::OrbitLeft
            | A::OrbitRight
            | A::OrbitUp
            | A::OrbitDown
            | A::ZoomIn
            | A::ZoomOut
            | A::RollLeft
            | A::RollRight
            | A::ExposureUp
            | A::ExposureDown
            | A::StepForward
            | A::StepBack
            | A::Undo
            | A::Redo
            | A::LargerText
            | A::SmallerText
    )
}
