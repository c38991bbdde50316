//! The rows of what else is selected, so that an edit of a row changes all of them.

use crate::model::objects::EditError;
use glam::{DVec2, DVec3, Vec3};
use glimray_scene::Scene;
use std::any::Any;
use std::collections::{BTreeSet, HashMap};

/// The part and the label of a row.
type Key = (&'static str, String);

/// Rows by their labels.
#[derive(Default)]
pub struct Peers {
    rows: HashMap<Key, Vec<Box<dyn Any>>>,
    /// The materials whose rows are among them, and those of what is shown.
    pub materials: BTreeSet<usize>,
}

impl Peers {
    /// Adds a row.
    pub fn add<T: Parts>(&mut self, key: Key, peer: Peer<T>) {
        self.rows.entry(key).or_default().push(Box::new(peer));
    }

    /// Takes the rows with this label and values of this type.
    pub fn take<T: Parts>(&mut self, key: &Key) -> Vec<Peer<T>> {
        let rows = self.rows.remove(key).unwrap_or_default();
        let rows = rows.into_iter().filter_map(|row| row.downcast().ok());
        rows.map(|row| *row).collect()
    }
}

/// The row of something else that is selected.
pub struct Peer<T> {
    /// The value there.
    pub value: T,
    set: Box<Set<T>>,
}

type Set<T> = dyn FnOnce(&mut Scene, T) -> Result<(), EditError>;

impl<T> Peer<T> {
    /// A row with a value that `set` changes.
    pub fn new(
        value: T,
        set: impl FnOnce(&mut Scene, T) -> Result<(), EditError> + 'static,
    ) -> Self {
        Self {
            value,
            set: Box::new(set),
        }
    }
}

/// Changes the edited parts of the values of rows.
pub fn apply_to<T: Parts>(
    peers: Vec<Peer<T>>,
    edited: Edited<T>,
    scene: &mut Scene,
) -> Result<(), EditError> {
    (peers.into_iter()).try_for_each(|peer| (peer.set)(scene, peer.value.with(edited)))
}

/// An edited value, and which of its parts the hand has changed.
#[derive(Clone, Copy)]
pub struct Edited<T> {
    /// All of the value.
    pub value: T,
    /// One for each number of it; all of them if it is not divided.
    pub parts: [bool; 3],
}

impl<T> Edited<T> {
    /// A value that was changed as a whole.
    pub fn whole(value: T) -> Self {
        Self {
            value,
            parts: [true; 3],
        }
    }
}

/// A value of up to three parts, which are compared and changed one by one.
pub trait Parts: Copy + 'static {
    /// Which parts differ.
    fn differs(self, other: Self) -> [bool; 3];

    /// The value with the parts that were edited elsewhere.
    fn with(self, edited: Edited<Self>) -> Self;
}

/// A value without parts.
macro_rules! whole {
    ($type:ty $(, $generic:ident)?) => {
        impl$(<$generic: Copy + PartialEq + 'static>)? Parts for $type {
            fn differs(self, other: Self) -> [bool; 3] {
                [self != other; 3]
            }

            fn with(self, edited: Edited<Self>) -> Self {
                edited.value
            }
        }
    };
}

macro_rules! vector {
    ($type:ty, $count:literal) => {
        impl Parts for $type {
            fn differs(self, other: Self) -> [bool; 3] {
                std::array::from_fn(|part| part < $count && self[part] != other[part])
            }

            fn with(mut self, edited: Edited<Self>) -> Self {
                for part in (0..$count).filter(|part| edited.parts[*part]) {
                    self[part] = edited.value[part];
                }
                self
            }
        }
    };
}

/// The option of a choice.
#[derive(Clone, Copy, PartialEq)]
pub struct Chosen<T>(pub T);

whole!(f64);
whole!(bool);
whole!(Chosen<T>, T);
vector!(DVec2, 2);
vector!(DVec3, 3);
vector!(Vec3, 3);
