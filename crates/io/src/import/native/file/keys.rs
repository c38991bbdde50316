//! The keys of an animation. Their value type depends on the property, so their values are checked later
//! than those of other tables.

use super::Spanned;
use crate::import::native::values::{Number, Time, Written};
use glam::{DQuat, DVec3};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::value::{self, MapAccessDeserializer, SeqDeserializer};
use serde::de::{self, Deserializer, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Serialize, Serializer, forward_to_deserialize_any};
use std::borrow::Cow;
use std::fmt;

/// A value at a time: [time, value], or a table.
#[derive(Debug)]
pub(crate) struct Key(pub KeyTable);

/// A value at a time.
#[derive(Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct KeyTable {
    /// Seconds.
    pub time: Spanned<Time>,
    /// The value of the property at that time.
    pub value: Spanned<KeyValue>,
    /// With hermite: the rate of change per second when arriving at the key; default 0.
    pub in_tangent: Option<Spanned<KeyValue>>,
    /// With hermite: the rate of change per second when leaving the key; default 0.
    pub out_tangent: Option<Spanned<KeyValue>>,
}

impl<'de> Deserialize<'de> for Key {
    // By hand: serde's untagged enums lose the position of an error.
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct PairOrTable;
        impl<'de> Visitor<'de> for PairOrTable {
            type Value = Key;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("a key: [time, value] or { time, value }")
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Key, A::Error> {
                let odd = || de::Error::custom("a key is a time and a value: [time, value]");
                let key = KeyTable {
                    time: seq.next_element()?.ok_or_else(odd)?,
                    value: seq.next_element()?.ok_or_else(odd)?,
                    in_tangent: None,
                    out_tangent: None,
                };
                match seq.next_element::<KeyValue>()? {
                    None => Ok(Key(key)),
                    Some(_) => Err(odd()),
                }
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Key, A::Error> {
                KeyTable::deserialize(MapAccessDeserializer::new(map)).map(Key)
            }
        }
        deserializer.deserialize_any(PairOrTable)
    }
}

impl Serialize for Key {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let key = &self.0;
        match (&key.in_tangent, &key.out_tangent) {
            (None, None) => (&key.time, &key.value).serialize(serializer),
            _ => key.serialize(serializer),
        }
    }
}

impl JsonSchema for Key {
    fn schema_name() -> Cow<'static, str> {
        "Key".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let time = generator.subschema_for::<Time>();
        let value = generator.subschema_for::<KeyValue>();
        let table = generator.subschema_for::<KeyTable>();
        json_schema!({
            "description": "A value at a time: [time, value], or a table.",
            "oneOf": [
                { "type": "array", "prefixItems": [time, value], "minItems": 2, "maxItems": 2 },
                table
            ]
        })
    }
}

/// The value of a key: a number, true or false, a list of three or four numbers, or a colour as
/// "#rrggbb".
#[derive(Clone, Debug)]
pub(crate) enum KeyValue {
    Number(f64),
    Switch(bool),
    Text(String),
    List([f64; 4], usize),
}

impl<'de> Deserialize<'de> for KeyValue {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct AnyOfThem;
        impl<'de> Visitor<'de> for AnyOfThem {
            type Value = KeyValue;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("a number, true or false, a list of numbers, or a colour")
            }
            fn visit_bool<E: de::Error>(self, value: bool) -> Result<KeyValue, E> {
                Ok(KeyValue::Switch(value))
            }
            fn visit_i64<E: de::Error>(self, value: i64) -> Result<KeyValue, E> {
                self.visit_f64(value as f64)
            }
            fn visit_f64<E: de::Error>(self, value: f64) -> Result<KeyValue, E> {
                let number = Number::deserialize(value::F64Deserializer::new(value))?;
                Ok(KeyValue::Number(number.0))
            }
            fn visit_str<E: de::Error>(self, text: &str) -> Result<KeyValue, E> {
                Ok(KeyValue::Text(text.to_owned()))
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<KeyValue, A::Error> {
                let (mut list, mut count) = ([0.0; 4], 0);
                while let Some(Number(number)) = seq.next_element()? {
                    let Some(slot) = list.get_mut(count) else {
                        let why = "a value has four numbers at most";
                        return Err(de::Error::custom(why));
                    };
                    *slot = number;
                    count += 1;
                }
                Ok(KeyValue::List(list, count))
            }
        }
        deserializer.deserialize_any(AnyOfThem)
    }
}

impl Serialize for KeyValue {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let value = match self {
            Self::Number(number) => number.written(),
            Self::Switch(switch) => (*switch).into(),
            Self::Text(text) => text.as_str().into(),
            Self::List(list, count) => list[..*count].written(),
        };
        value.serialize(serializer)
    }
}

impl From<DVec3> for KeyValue {
    fn from(value: DVec3) -> Self {
        Self::List(value.extend(0.0).to_array(), 3)
    }
}

impl From<DQuat> for KeyValue {
    fn from(value: DQuat) -> Self {
        Self::List(value.to_array(), 4)
    }
}

impl JsonSchema for KeyValue {
    fn schema_name() -> Cow<'static, str> {
        "KeyValue".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "Depending on the property: a number, true or false, three or four numbers, or a colour as \"#rrggbb\".",
            "oneOf": [
                { "type": "number" },
                { "type": "boolean" },
                { "type": "array", "items": { "type": "number" }, "minItems": 3, "maxItems": 4 },
                { "type": "string", "pattern": "^#[0-9A-Fa-f]{6}$" }
            ]
        })
    }
}

/// Passes its value on, to be read as the type of a property.
impl<'de> Deserializer<'de> for &KeyValue {
    type Error = value::Error;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, value::Error> {
        match self {
            KeyValue::Number(number) => visitor.visit_f64(*number),
            KeyValue::Switch(switch) => visitor.visit_bool(*switch),
            KeyValue::Text(text) => visitor.visit_str(text),
            KeyValue::List(list, count) => {
                visitor.visit_seq(SeqDeserializer::new(list[..*count].iter().copied()))
            }
        }
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf option
        unit unit_struct newtype_struct seq tuple tuple_struct map struct enum identifier ignored_any
    }
}
