//! Triggers: keys, mouse buttons and the wheel, with their text form.

use eframe::egui::{Event, Key, Modifiers, PointerButton};
use std::fmt;
use std::str::FromStr;

/// Modifier keys. `command` is Ctrl, or ⌘ on a Mac.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Mods {
    /// Ctrl, or ⌘.
    pub command: bool,
    /// Shift.
    pub shift: bool,
    /// Alt, or ⌥.
    pub alt: bool,
}

impl Mods {
    /// No modifiers.
    pub const NONE: Self = Self {
        command: false,
        shift: false,
        alt: false,
    };

    /// Whether all of these are held; others may be held too.
    pub fn include(self, others: Self) -> bool {
        (self.command || !others.command)
            && (self.shift || !others.shift)
            && (self.alt || !others.alt)
    }
}

impl From<Modifiers> for Mods {
    fn from(held: Modifiers) -> Self {
        Self {
            command: held.command || held.ctrl,
            shift: held.shift,
            alt: held.alt,
        }
    }
}

/// A key, mouse or wheel input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Trigger {
    /// A key is pressed with exactly these modifiers.
    Key(Mods, Key),
    /// A key is held, with or without Shift.
    Hold(Key),
    /// Modifiers are held.
    HoldMods(Mods),
    /// A button is pressed, dragged and released.
    Drag(Mods, PointerButton),
    /// A button is clicked.
    Click(Mods, PointerButton),
    /// A button is double-clicked.
    DoubleClick(Mods, PointerButton),
    /// The wheel is turned, or two fingers scroll.
    Wheel(Mods),
}

impl Trigger {
    /// The key presses that `event` stands for: by the keyboard layout and by the physical key where they
    /// differ. On many layouts Shift+1 is `!`.
    pub(super) fn pressed(event: &Event) -> Option<[Option<Self>; 2]> {
        let command = Mods {
            command: true,
            ..Mods::NONE
        };
        // The window system sends these events instead of three of the shortcuts.
        let clipboard = |key| Some([Some(Self::Key(command, key)), None]);
        match event {
            Event::Copy => clipboard(Key::C),
            Event::Cut => clipboard(Key::X),
            Event::Paste(_) => clipboard(Key::V),
            &Event::Key {
                key,
                physical_key,
                pressed: true,
                modifiers,
                ..
            } => {
                let mods = Mods::from(modifiers);
                Some([
                    Some(Self::Key(mods, key)),
                    physical_key.map(|key| Self::Key(mods, key)),
                ])
            }
            _ => None,
        }
    }

    /// Whether two triggers are ambiguous.
    pub(super) fn collides(&self, other: &Self) -> bool {
        let key = |trigger: &Self, held: &Self| match (trigger, held) {
            // Shift makes a flight faster once it has begun. A key that is pressed with it begins none.
            (Self::Key(mods, pressed), Self::Hold(key)) => {
                pressed == key && !mods.command && !mods.alt && !mods.shift
            }
            _ => false,
        };
        self == other || key(self, other) || key(other, self)
    }

    /// Text for the window, such as `Ctrl+Shift+Z`; `mac` uses symbols such as ⌘⇧Z.
    pub fn label(&self, mac: bool) -> String {
        let with = |mods: Mods, what: String| {
            let mods = if mac {
                mac_mods(mods)
            } else {
                plain_mods(mods)
            };
            mods + &what
        };
        match *self {
            Self::Key(mods, key) => with(mods, key_label(key)),
            Self::Hold(key) => format!("hold {}", key_label(key)),
            Self::HoldMods(mods) => {
                let label = with(mods, String::new());
                format!("hold {}", label.trim_end_matches('+'))
            }
            Self::Drag(mods, button) => with(mods, format!("{} drag", button_name(button))),
            Self::Click(mods, button) => with(mods, format!("{} click", button_name(button))),
            Self::DoubleClick(mods, button) => {
                with(mods, format!("{} double click", button_name(button)))
            }
            Self::Wheel(mods) => with(mods, "wheel".to_owned()),
        }
    }
}

fn plain_mods(mods: Mods) -> String {
    let mut text = String::new();
    for (held, name) in [
        (mods.command, "Ctrl+"),
        (mods.shift, "Shift+"),
        (mods.alt, "Alt+"),
    ] {
        if held {
            text.push_str(name);
        }
    }
    text
}

fn mac_mods(mods: Mods) -> String {
    let mut text = String::new();
    for (held, sign) in [(mods.alt, '⌥'), (mods.shift, '⇧'), (mods.command, '⌘')] {
        if held {
            text.push(sign);
        }
    }
    text
}

fn key_label(key: Key) -> String {
    match key {
        Key::ArrowLeft => "←".to_owned(),
        Key::ArrowRight => "→".to_owned(),
        Key::ArrowUp => "↑".to_owned(),
        Key::ArrowDown => "↓".to_owned(),
        Key::PageUp => "Page Up".to_owned(),
        Key::PageDown => "Page Down".to_owned(),
        Key::Minus => "-".to_owned(),
        key => key.symbol_or_name().to_owned(),
    }
}

const BUTTONS: [(PointerButton, &str); 5] = [
    (PointerButton::Primary, "left"),
    (PointerButton::Secondary, "right"),
    (PointerButton::Middle, "middle"),
    (PointerButton::Extra1, "fourth"),
    (PointerButton::Extra2, "fifth"),
];

fn button_name(button: PointerButton) -> &'static str {
    let mut buttons = BUTTONS.iter();
    buttons
        .find(|(known, _)| *known == button)
        .map_or("left", |(_, name)| name)
}

/// Text for settings files, the same on every system: `Ctrl+Shift+Z`, `Hold W`, `Drag left`, `Ctrl+Wheel`,
/// `DoubleClick left`.
impl fmt::Display for Trigger {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match *self {
            Self::Key(mods, key) => write!(f, "{}{}", plain_mods(mods), key.name()),
            Self::Hold(key) => write!(f, "Hold {}", key.name()),
            Self::HoldMods(mods) => {
                write!(f, "Hold {}", plain_mods(mods).trim_end_matches('+'))
            }
            Self::Drag(mods, button) => {
                write!(f, "{}Drag {}", plain_mods(mods), button_name(button))
            }
            Self::Click(mods, button) => {
                write!(f, "{}Click {}", plain_mods(mods), button_name(button))
            }
            Self::DoubleClick(mods, button) => {
                write!(f, "{}DoubleClick {}", plain_mods(mods), button_name(button))
            }
            Self::Wheel(mods) => write!(f, "{}Wheel", plain_mods(mods)),
        }
    }
}

impl FromStr for Trigger {
    type Err = String;

    /// Parses the output of [`fmt::Display`], ignoring case.
    fn from_str(text: &str) -> Result<Self, String> {
        let refuse = |what: &str| {
            Err(format!(
                "`{}` is no key or button: {what}. Write it as in Ctrl+Shift+Z, Hold W, Drag left, \
                 Shift+Wheel or DoubleClick left",
                text.trim()
            ))
        };
        let (first, rest) = match text.trim().split_once(' ') {
            Some((first, rest)) => (first, Some(rest.trim())),
            None => (text.trim(), None),
        };
        if first.eq_ignore_ascii_case("hold") {
            let held = rest.unwrap_or_default();
            let (mods, last) = split_mods(held);
            return match (modifier(last), key(last)) {
                (Some(one), _) => Ok(Self::HoldMods(both(mods, one))),
                (None, Some(key)) if mods == Mods::NONE => Ok(Self::Hold(key)),
                _ => refuse("only a single key or modifiers can be held"),
            };
        }
        let (mods, last) = split_mods(first);
        let button = || {
            let mut buttons = BUTTONS.iter();
            let name = rest.unwrap_or_default();
            buttons.find(|(_, known)| known.eq_ignore_ascii_case(name))
        };
        match (last.to_ascii_lowercase().as_str(), button(), rest) {
            ("drag", Some((button, _)), _) => Ok(Self::Drag(mods, *button)),
            ("click", Some((button, _)), _) => Ok(Self::Click(mods, *button)),
            ("doubleclick", Some((button, _)), _) => Ok(Self::DoubleClick(mods, *button)),
            ("drag" | "click" | "doubleclick", None, _) => {
                refuse("buttons are left, right, middle, fourth and fifth")
            }
            ("wheel", _, None) => Ok(Self::Wheel(mods)),
            (_, _, None) => match key(last) {
                Some(key) => Ok(Self::Key(mods, key)),
                None => refuse("unknown key"),
            },
            _ => refuse("too many words"),
        }
    }
}

/// Splits the modifiers before the last `+` from the rest.
fn split_mods(text: &str) -> (Mods, &str) {
    let mut mods = Mods::NONE;
    let mut rest = text;
    while let Some((name, after)) = rest.split_once('+') {
        let (Some(one), false) = (modifier(name), after.is_empty()) else {
            break;
        };
        mods = both(mods, one);
        rest = after;
    }
    (mods, rest)
}

fn modifier(name: &str) -> Option<Mods> {
    let mut mods = Mods::NONE;
    match name.to_ascii_lowercase().as_str() {
        "ctrl" | "cmd" | "command" => mods.command = true,
        "shift" => mods.shift = true,
        "alt" | "option" => mods.alt = true,
        _ => return None,
    }
    Some(mods)
}

fn both(a: Mods, b: Mods) -> Mods {
    Mods {
        command: a.command || b.command,
        shift: a.shift || b.shift,
        alt: a.alt || b.alt,
    }
}

fn key(name: &str) -> Option<Key> {
    let mut keys = Key::ALL.iter().copied();
    Key::from_name(name).or_else(|| keys.find(|key| key.name().eq_ignore_ascii_case(name)))
}
