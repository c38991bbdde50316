//! Values that are one of several things.

/// Defines a value of several variants from its docs, its variants, a description for errors, and the variant that is
/// read from each kind of TOML value: a string `str`, a list `seq`, a `number` or a table `map`.
macro_rules! either {
    (
        $(#[$doc:meta])* $name:ident { $($variant:ident($type:ty)),* }, $expected:literal,
        $($kind:ident: $($to:ident)or+),*
    ) => {
        $(#[$doc])*
        #[derive(Clone, Debug, serde::Serialize, schemars::JsonSchema)]
        #[serde(untagged)]
        pub(crate) enum $name {
            $($variant($type),)*
        }

        impl<'de> serde::Deserialize<'de> for $name {
            // By hand: serde's untagged enums lose the position of an error.
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                struct Variants;
                impl<'de> serde::de::Visitor<'de> for Variants {
                    type Value = $name;
                    fn expecting(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
                        f.write_str($expected)
                    }
                    $(either!(@ $kind $name $($to)*);)*
                }
                deserializer.deserialize_any(Variants)
            }
        }
    };
    (@ str $name:ident $to:ident $($other:ident)?) => {
        fn visit_str<E: serde::de::Error>(self, text: &str) -> Result<$name, E> {
            let from = || serde::de::value::StrDeserializer::<E>::new(text);
            let first = serde::Deserialize::deserialize(from()).map($name::$to);
            $(let first = first.or_else(|error| {
                let second = serde::Deserialize::deserialize(from()).map($name::$other);
                second.map_err(|_: E| error)
            });)?
            first
        }
    };
    (@ number $name:ident $to:ident) => {
        fn visit_i64<E: serde::de::Error>(self, value: i64) -> Result<$name, E> {
            self.visit_f64(value as f64)
        }
        fn visit_f64<E: serde::de::Error>(self, value: f64) -> Result<$name, E> {
            let from = serde::de::value::F64Deserializer::new(value);
            serde::Deserialize::deserialize(from).map($name::$to)
        }
    };
    (@ seq $name:ident $to:ident) => {
        fn visit_seq<A: serde::de::SeqAccess<'de>>(self, list: A) -> Result<$name, A::Error> {
            let from = serde::de::value::SeqAccessDeserializer::new(list);
            serde::Deserialize::deserialize(from).map($name::$to)
        }
    };
    (@ map $name:ident $to:ident) => {
        fn visit_map<A: serde::de::MapAccess<'de>>(self, table: A) -> Result<$name, A::Error> {
            let from = serde::de::value::MapAccessDeserializer::new(table);
            serde::Deserialize::deserialize(from).map($name::$to)
        }
    };
}

pub(crate) use either;
