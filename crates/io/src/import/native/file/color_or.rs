//! Values that are a colour or something else.

/// A colour, or a table instead of it, or a name.
macro_rules! color_or {
    ($(#[$doc:meta])* $name:ident($table:ty$(, $word:ty)?), $expected:literal) => {
        $(#[$doc])*
        #[derive(Clone, Debug, JsonSchema)]
        #[schemars(untagged)]
        pub(in crate::import::native) enum $name {
            Color(Color),
            Table(Box<$table>),
            $(Name($word),)?
        }

        impl<'de> Deserialize<'de> for $name {
            // By hand: serde's untagged enums lose the position of an error.
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                struct ColorOrTable;
                impl<'de> Visitor<'de> for ColorOrTable {
                    type Value = $name;
                    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                        f.write_str($expected)
                    }
                    fn visit_str<E: de::Error>(self, text: &str) -> Result<$name, E> {
                        $(
                            let word = de::value::StrDeserializer::<E>::new(text);
                            if let Ok(word) = <$word>::deserialize(word) {
                                return Ok($name::Name(word));
                            }
                        )?
                        Color::deserialize(de::value::StrDeserializer::new(text)).map($name::Color)
                    }
                    fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<$name, A::Error> {
                        let seq = de::value::SeqAccessDeserializer::new(seq);
                        Color::deserialize(seq).map($name::Color)
                    }
                    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<$name, A::Error> {
                        let map = de::value::MapAccessDeserializer::new(map);
                        <$table>::deserialize(map).map(|table| $name::Table(Box::new(table)))
                    }
                }
                deserializer.deserialize_any(ColorOrTable)
            }
        }
    };
}

pub(in crate::import::native) use color_or;
