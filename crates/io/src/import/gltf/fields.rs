//! Checks the JSON of a model against the table of its properties (`field_table.rs`) before anything reads it. Values
//! of a wrong type are repaired or taken out. What is not known, and what is known but not used, is noted by name.

use super::extensions::{LONGEST_NAME, support};
use super::field_forms::{Form, Object, Use};
use super::field_table::ROOT;
use super::unused::{Tally, Unused};
use crate::import::notes::Notes;
use crate::import::source::quote_up_to;
use serde_json::{Map, Number, Value};
use std::fmt;

/// The longest name of a property that messages show whole.
const LONGEST: usize = 64;

/// Where a value is in the JSON.
#[derive(Clone, Copy)]
enum Place<'a> {
    Root,
    Key(&'a Place<'a>, &'a str),
    At(&'a Place<'a>, usize),
}

impl fmt::Display for Place<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Root => Ok(()),
            Self::Key(Self::Root, key) => f.write_str(&shown(key)),
            Self::Key(above, key) => write!(f, "{above}.{}", shown(key)),
            Self::At(above, index) => write!(f, "{above}[{index}]"),
        }
    }
}

impl Place<'_> {
    /// This place with `[]` for each index, so that all elements of a list share one.
    fn pattern(&self) -> String {
        match self {
            Self::Root => String::new(),
            Self::Key(Self::Root, key) => shown(key),
            Self::Key(above, key) => format!("{}.{}", above.pattern(), shown(key)),
            Self::At(above, _) => format!("{}[]", above.pattern()),
        }
    }
}

/// `key`, in backquotes unless it is a plain word.
fn shown(key: &str) -> String {
    let is_plain = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'_';
    match key.len() <= LONGEST && key.bytes().all(is_plain) {
        true => key.to_owned(),
        false => quote_up_to(LONGEST, key.as_bytes()),
    }
}

/// The findings of the check.
struct Check<'n> {
    unknown: Tally,
    unused: Unused,
    notes: &'n mut Notes,
}

/// The names of all properties of glTF 2.0 and its extensions that are known, such as `nodes[].translation`: `[]` is
/// any entry of a list. Vertex attributes are not among them.
pub fn gltf_properties() -> Vec<String> {
    fn add(object: &Object, place: &str, names: &mut Vec<String>) {
        for (name, form, _) in object.fields {
            let name = match place {
                "" => (*name).to_owned(),
                _ => format!("{place}.{name}"),
            };
            match form {
                Form::One(inner) if inner.is_extensions => add(inner, &name, names),
                Form::One(inner) => {
                    add(inner, &name, names);
                    names.push(name);
                }
                Form::Many(inner) => {
                    add(inner, &format!("{name}[]"), names);
                    names.push(name);
                }
                _ => names.push(name),
            }
        }
    }
    let mut names = Vec::new();
    add(&ROOT, "", &mut names);
    names
}

/// Repairs `json`, a model, so that it has the types of the specification, and notes what is repaired or unknown.
/// Returns what says nothing about the picture or is decided otherwise.
pub(super) fn check(json: &mut Value, notes: &mut Notes) -> Unused {
    let mut check = Check {
        unknown: Tally::default(),
        unused: Unused::default(),
        notes,
    };
    check.object(json, &ROOT, Place::Root);
    let sentence = |first: &str, _: &str| format!("{first} is not known and was ignored");
    let lines = check.unknown.into_lines(sentence, "known");
    check.notes.keep("unknown properties", lines);
    check.unused
}

impl Check<'_> {
    fn object(&mut self, value: &mut Value, object: &Object, place: Place) {
        let Value::Object(members) = value else {
            return;
        };
        members.retain(|key, value| {
            let here = Place::Key(&place, key);
            if key == "extras" {
                self.unused.idle("extras".to_owned());
                return false;
            }
            let known = object.fields.iter().find(|(name, ..)| name == key);
            let Some((_, form, used)) = known else {
                self.unknown(object, here, key);
                return false;
            };
            if value.is_null() {
                return false;
            }
            match used {
                Use::Read => return self.value(value, *form, here),
                Use::Idle => self.unused.idle(here.pattern()),
                Use::Unused(why) => self.unused.add(here.pattern(), || here.to_string(), why),
            }
            false
        });
    }

    fn unknown(&mut self, object: &Object, here: Place, key: &str) {
        if object.is_extensions && support(key).is_none() {
            let quoted = quote_up_to(LONGEST_NAME, key.as_bytes());
            self.notes.add("extensions without effect", || {
                format!("the extension {quoted} is not supported and was ignored")
            });
            return;
        }
        (self.unknown).add(here.pattern(), || here.to_string(), "");
    }

    /// Whether `value` has this form, perhaps after a repair; a note says what was wrong with it.
    fn value(&mut self, value: &mut Value, form: Form, here: Place) -> bool {
        let problem = match form {
            Form::Any => None,
            Form::One(object) if value.is_object() => {
                self.object(value, object, here);
                None
            }
            Form::Many(object) => self.each(value, here, |it, part, place| {
                let is_object = part.is_object();
                if !is_object {
                    *part = Value::Object(Map::new());
                }
                it.object(part, object, place);
                is_object
            }),
            Form::Attributes if value.is_object() => {
                self.attributes(value, here);
                None
            }
            Form::ManyAttributes => self.each(value, here, |it, part, place| {
                let is_object = part.is_object();
                if !is_object {
                    *part = Value::Object(Map::new());
                }
                it.attributes(part, place);
                is_object
            }),
            Form::Wholes => self.each(value, here, |_, part, _| {
                let is_whole = whole(part);
                if !is_whole {
                    // An index that leads nowhere keeps the others in their places.
                    *part = u32::MAX.into();
                }
                is_whole
            }),
            Form::Texts => self.each(value, here, |_, part, _| {
                let is_text = part.is_string();
                if !is_text {
                    *part = "".into();
                }
                is_text
            }),
            _ => repair(value, form),
        };
        let Some(problem) = problem else { return true };
        self.notes.add("values of a wrong type", || match &problem {
            Problem::Kept(what) => format!("{here} {what}"),
            Problem::Lost(what) => format!("{here} was ignored: it must be {what}"),
        });
        matches!(problem, Problem::Kept(_))
    }

    /// Calls `check` for each element of a list, which says whether it was right.
    fn each(
        &mut self,
        value: &mut Value,
        here: Place,
        check: impl Fn(&mut Self, &mut Value, Place) -> bool,
    ) -> Option<Problem> {
        let Value::Array(parts) = value else {
            return Some(Problem::Lost("a list".to_owned()));
        };
        for (index, part) in parts.iter_mut().enumerate() {
            let place = Place::At(&here, index);
            if !check(self, part, place) {
                let note = || format!("{place} has a wrong type and was ignored");
                self.notes.add("values of a wrong type", note);
            }
        }
        None
    }

    /// Vertex attributes, of which programs may have more than are used.
    fn attributes(&mut self, value: &mut Value, place: Place) {
        let Value::Object(members) = value else {
            return;
        };
        members.retain(|name, value| {
            let here = Place::Key(&place, name);
            let set = |prefix: &str| {
                let number = name.strip_prefix(prefix);
                number.is_some_and(|it| it.parse::<u32>().is_ok())
            };
            let is_read = matches!(&**name, "POSITION" | "NORMAL" | "TANGENT" | "COLOR_0")
                || matches!(&**name, "TRANSLATION" | "ROTATION" | "SCALE")
                || ["TEXCOORD_", "JOINTS_", "WEIGHTS_"].into_iter().any(set);
            if !is_read {
                let why = "no picture shows this attribute";
                self.unused.add(here.pattern(), || here.to_string(), why);
            }
            self.value(value, Form::Whole, here)
        });
    }
}

/// The fault of a value.
enum Problem {
    /// The value was repaired, in this way.
    Kept(String),
    /// The value cannot be used; this is expected.
    Lost(String),
}

/// Gives `value` a form that is no object or list of any length.
fn repair(value: &mut Value, form: Form) -> Option<Problem> {
    let lost = |what: &str| Some(Problem::Lost(what.to_owned()));
    match form {
        Form::Whole if whole(value) => None,
        Form::Whole => lost("a whole number from 0"),
        Form::Number if value.is_number() => None,
        Form::Number => lost("a number"),
        Form::Text if value.is_string() => None,
        Form::Text => lost("a string"),
        Form::Flag => match value.as_f64() {
            _ if value.is_boolean() => None,
            Some(number) if number == 0.0 || number == 1.0 => {
                *value = (number == 1.0).into();
                None
            }
            _ => lost("true or false"),
        },
        Form::List | Form::Numbers(_) => {
            let Value::Array(parts) = value else {
                return lost("a list of numbers");
            };
            let have = parts.len();
            match form {
                _ if !parts.iter().all(Value::is_number) => lost("a list of numbers"),
                Form::Numbers(count) if have > count => {
                    parts.truncate(count);
                    let what = format!("has {have} numbers: the first {count} are used");
                    Some(Problem::Kept(what))
                }
                Form::Numbers(count) if have < count => lost(&format!("{count} numbers")),
                _ => None,
            }
        }
        Form::Word(words) => {
            let word = value.as_str().unwrap_or_default();
            if words.contains(&word) {
                return None;
            }
            let alike = words.iter().find(|known| known.eq_ignore_ascii_case(word));
            match alike {
                Some(known) => {
                    *value = (*known).into();
                    None
                }
                None => lost(&format!("one of {}", words.join(", "))),
            }
        }
        _ => lost("an object"),
    }
}

/// Whether `value` is a whole number from 0; one with a decimal point loses it.
fn whole(value: &mut Value) -> bool {
    if value.is_u64() {
        return true;
    }
    // The largest that a double holds exactly.
    let number = value
        .as_f64()
        .filter(|n| n.fract() == 0.0 && (0.0..9e15).contains(n));
    if let Some(number) = number {
        *value = Value::Number(Number::from(number as u64));
    }
    number.is_some()
}
