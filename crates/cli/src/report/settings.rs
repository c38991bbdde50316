//! The settings in a report, from the table of settings.

use glimray_app::settings::{SETTINGS, Setting};
use glimray_app::value_forms::Control;
use glimray_render::RenderSettings;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Serialize, Serializer};
use serde_json::{Map, Value, json};
use std::borrow::Cow;
use std::str::FromStr;

/// The settings of a picture under the names of their members; null if they are not known, or without effect on the picture.
#[derive(Debug, Default)]
pub struct SettingsReport(pub Option<RenderSettings>);

fn reported() -> impl Iterator<Item = &'static Setting> {
    SETTINGS.iter().filter(|setting| setting.is_reported)
}

impl SettingsReport {
    fn value(&self, setting: &Setting) -> Value {
        let settings = self.0.as_ref();
        let settings = settings.filter(|settings| setting.applies(settings));
        let text = settings.map(|settings| (setting.text)(settings));
        match (text, (setting.control)()) {
            (None, _) => Value::Null,
            (Some(text), Control::Switch(_)) => text.is_some().into(),
            (Some(text), Control::Names(_) | Control::Text) => text.into(),
            (Some(text), Control::Count(..)) => number::<u64>(text),
            (Some(text), Control::Real(..) | Control::Limit(..)) => number::<f64>(text),
        }
    }
}

fn number<T: FromStr + Into<Value>>(text: Option<String>) -> Value {
    let number = text.and_then(|text| text.parse::<T>().ok());
    number.map_or(Value::Null, Into::into)
}

impl Serialize for SettingsReport {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(reported().map(|setting| (setting.name, self.value(setting))))
    }
}

impl JsonSchema for SettingsReport {
    fn schema_name() -> Cow<'static, str> {
        "SettingsReport".into()
    }

    fn inline_schema() -> bool {
        true
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let property = |setting: &Setting| {
            let kind = match (setting.control)() {
                Control::Switch(_) => "boolean",
                Control::Count(..) => "integer",
                Control::Real(..) | Control::Limit(..) => "number",
                Control::Names(_) | Control::Text => "string",
            };
            json!({ "description": setting.tip(), "type": [kind, "null"] })
        };
        let properties: Map<_, _> = reported()
            .map(|setting| (setting.name.to_owned(), property(setting)))
            .collect();
        let names: Vec<_> = reported().map(|setting| setting.name).collect();
        json_schema!({ "type": "object", "properties": properties, "required": names })
    }
}
