//! The backdrop, which paths from the camera see where there is nothing.

use super::ColorVisitor;
use glimray_scene::Backdrop;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{self, Deserialize, Deserializer, SeqAccess, Visitor};
use serde::ser::{Serialize, Serializer};
use std::borrow::Cow;
use std::fmt;

/// `"transparent"`, or a colour.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BackdropValue(pub Backdrop);

impl<'de> Deserialize<'de> for BackdropValue {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(BackdropVisitor).map(Self)
    }
}

impl Serialize for BackdropValue {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match &self.0 {
            // The background is a backdrop that no key gives.
            Backdrop::Background => serializer.serialize_none(),
            Backdrop::Color(color) => super::color(color).serialize(serializer),
            Backdrop::Transparent => serializer.serialize_str("transparent"),
        }
    }
}

impl JsonSchema for BackdropValue {
    fn schema_name() -> Cow<'static, str> {
        "BackdropValue".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let color = generator.subschema_for::<super::Color>();
        json_schema!({ "anyOf": [{ "const": "transparent" }, color] })
    }
}

struct BackdropVisitor;

impl<'de> Visitor<'de> for BackdropVisitor {
    type Value = Backdrop;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("\"transparent\" or a colour: [r, g, b] or \"#rrggbb\"")
    }

    fn visit_str<E: de::Error>(self, text: &str) -> Result<Backdrop, E> {
        match text {
            "transparent" => Ok(Backdrop::Transparent),
            color => ColorVisitor.visit_str(color).map(Backdrop::Color),
        }
    }

    fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<Backdrop, A::Error> {
        ColorVisitor.visit_seq(seq).map(Backdrop::Color)
    }
}
