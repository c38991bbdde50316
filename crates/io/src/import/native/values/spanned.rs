//! Values with their places in a scene file.

use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::{Deserialize, Serialize, Serializer};
use std::borrow::Cow;
use std::ops::{Deref, Range};

/// A value, and its bytes in the file. Values that are to be written have an empty range.
#[derive(Clone, Debug, Deserialize)]
#[serde(transparent)]
pub(crate) struct Spanned<T> {
    value: toml::Spanned<T>,
}

impl<T> Spanned<T> {
    /// The bytes in the file.
    pub fn span(&self) -> Range<usize> {
        self.value.span()
    }

    /// The value.
    pub fn get_ref(&self) -> &T {
        self.value.get_ref()
    }

    /// A value at a place.
    pub fn new(span: Range<usize>, value: T) -> Self {
        let value = toml::Spanned::new(span, value);
        Self { value }
    }
}

impl<T> From<T> for Spanned<T> {
    fn from(value: T) -> Self {
        Self::new(0..0, value)
    }
}

impl<T> Deref for Spanned<T> {
    type Target = T;

    fn deref(&self) -> &T {
        self.value.get_ref()
    }
}

impl<T: Serialize> Serialize for Spanned<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        T::serialize(self, serializer)
    }
}

impl<T: JsonSchema> JsonSchema for Spanned<T> {
    fn inline_schema() -> bool {
        T::inline_schema()
    }

    fn schema_name() -> Cow<'static, str> {
        T::schema_name()
    }

    fn schema_id() -> Cow<'static, str> {
        T::schema_id()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        T::json_schema(generator)
    }
}
