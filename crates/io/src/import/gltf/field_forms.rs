//! How the properties of a JSON format are listed in a table: what each may hold, and whether it has an effect.

/// The properties of a kind of objects in the JSON.
#[derive(Debug)]
pub struct Object {
    /// Whether it lists extensions, of which others than these may be there.
    pub is_extensions: bool,
    /// By name.
    pub fields: &'static [(&'static str, Form, Use)],
}

/// The values that a property may hold.
#[derive(Clone, Copy, Debug)]
pub enum Form {
    /// A whole number from 0: an index, a count or a code.
    Whole,
    /// A list of them.
    Wholes,
    /// A number.
    Number,
    /// A list of this many numbers.
    Numbers(usize),
    /// Any number of numbers.
    List,
    /// A string.
    Text,
    /// A list of strings.
    Texts,
    /// One of these strings.
    Word(&'static [&'static str]),
    /// True or false.
    Flag,
    /// An object.
    One(&'static Object),
    /// A list of objects.
    Many(&'static Object),
    /// Indices of accessors by the name of a vertex attribute.
    Attributes,
    /// A list of such objects.
    ManyAttributes,
    /// Anything.
    Any,
}

/// Whether a property has an effect.
#[derive(Clone, Copy, Debug)]
pub enum Use {
    /// The property is read.
    Read,
    /// The property says nothing about the picture.
    Idle,
    /// The property is not used, for this reason.
    Unused(&'static str),
}

/// Objects, whose name in brackets means that they list extensions. Properties without a remark are read.
macro_rules! objects {
    ($($(#[$cfg:meta])* $kind:ident $name:ident { $($(#[$own:meta])* $key:ident: $form:expr $(, $used:expr)?;)* })*) => {
        $(
            $(#[$cfg])*
            pub(in crate::import::gltf) static $name: Object = Object {
                is_extensions: objects!(@is $kind),
                fields: &[$($(#[$own])* (stringify!($key), $form, objects!(@used $($used)?)),)*],
            };
        )*
    };
    (@is object) => { false };
    (@is extensions) => { true };
    (@used) => { Read };
    (@used $used:expr) => { $used };
}

pub(in crate::import::gltf) use objects;
