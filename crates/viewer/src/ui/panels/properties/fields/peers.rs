//! The rows of what else is selected, so that an edit of a row changes all of them.

use crate::model::objects::{self, EditError};
use glam::{DVec2, DVec3, Vec3};
use glimray_scene::{ObjectRef, Scene};
use std::any::{Any, TypeId};
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// The part and the label of a row, and the type of its value.
pub type Key = (&'static str, &'static str, TypeId);

/// Whether the options of what is shown are on, by their labels.
pub type Options = BTreeMap<&'static str, bool>;

/// The rows of what else is selected: compared with each other, or collected to be edited.
pub struct Peers {
    /// The options of what is shown, which count for all.
    pub options: Options,
    /// The materials whose rows are among them, and those of what is shown.
    pub materials: BTreeSet<usize>,
    /// The materials of meshes.
    of_meshes: HashMap<usize, Vec<usize>>,
    rows: Rows,
}

enum Rows {
    Compared(Table),
    Collected(Key, Vec<Box<dyn Any>>),
}

/// Rows, and their places by their keys. Objects of a kind have rows in the same order: after a row, mostly the next is added.
#[derive(Default)]
struct Table {
    rows: Vec<(Key, Compared)>,
    places: HashMap<Key, usize>,
    next: usize,
}

impl Table {
    fn add<T: Parts>(&mut self, key: Key, value: T) {
        let next = self.rows.get(self.next).filter(|row| row.0 == key);
        let place = next.map(|_| self.next);
        let place = match place.or_else(|| self.places.get(&key).copied()) {
            Some(place) => {
                let row = &mut self.rows[place].1;
                row.count += 1;
                row.differs = row.differs_from(value);
                place
            }
            None => {
                let row = Compared {
                    count: 1,
                    first: Box::new(value),
                    differs: [false; 3],
                };
                self.places.insert(key, self.rows.len());
                self.rows.push((key, row));
                self.rows.len() - 1
            }
        };
        self.next = (place + 1) % self.rows.len();
    }
}

/// The values of a row.
pub struct Compared {
    /// Number of peers that have the row.
    pub count: usize,
    first: Box<dyn Any + Send + Sync>,
    /// The parts of the values that differ from those of the first.
    differs: [bool; 3],
}

impl Compared {
    /// The parts of the values of which one differs from this.
    pub fn differs_from<T: Parts>(&self, value: T) -> [bool; 3] {
        let first = self.first.downcast_ref::<T>();
        let differs = first.map_or([false; 3], |first| value.differs(*first));
        std::array::from_fn(|part| differs[part] || self.differs[part])
    }
}

impl Peers {
    /// Rows to be compared.
    pub fn to_compare(options: Options) -> Self {
        Self::new(options, Rows::Compared(Table::default()))
    }

    /// Rows of one kind, to be edited.
    pub fn to_edit(options: Options, key: Key) -> Self {
        Self::new(options, Rows::Collected(key, Vec::new()))
    }

    fn new(options: Options, rows: Rows) -> Self {
        Self {
            options,
            materials: BTreeSet::new(),
            of_meshes: HashMap::new(),
            rows,
        }
    }

    /// Adds a row with a value that `set` changes.
    pub fn add<T: Parts>(
        &mut self,
        key: Key,
        value: T,
        set: impl FnOnce(&mut Scene, T) -> Result<(), EditError> + 'static,
    ) {
        match &mut self.rows {
            Rows::Compared(table) => table.add(key, value),
            Rows::Collected(wanted, peers) if *wanted == key => {
                let set = Box::new(set);
                peers.push(Box::new(Peer { value, set }));
            }
            Rows::Collected(..) => {}
        }
    }

    /// The materials of an object, each once.
    pub fn materials_of(&mut self, scene: &Scene, object: ObjectRef) -> Vec<usize> {
        match object {
            ObjectRef::Instance(index) => {
                let known = self.of_meshes.entry(scene.instances[index].mesh);
                known
                    .or_insert_with(|| objects::materials_of(scene, object))
                    .clone()
            }
            _ => objects::materials_of(scene, object),
        }
    }

    /// The rows that were compared.
    pub fn compared(self) -> HashMap<Key, Compared> {
        match self.rows {
            Rows::Compared(table) => table.rows.into_iter().collect(),
            Rows::Collected(..) => HashMap::new(),
        }
    }

    /// The rows that were collected.
    fn collected<T: Parts>(self) -> impl Iterator<Item = Peer<T>> {
        let rows = match self.rows {
            Rows::Compared(_) => Vec::new(),
            Rows::Collected(_, rows) => rows,
        };
        let rows = rows.into_iter().filter_map(|row| row.downcast().ok());
        rows.map(|row| *row)
    }
}

/// The row of something else that is selected.
struct Peer<T> {
    /// The value there.
    value: T,
    set: Box<Set<T>>,
}

type Set<T> = dyn FnOnce(&mut Scene, T) -> Result<(), EditError>;

/// Changes the edited parts of the values of rows.
pub fn apply_to<T: Parts>(
    peers: Peers,
    edited: Edited<T>,
    scene: &mut Scene,
) -> Result<(), EditError> {
    (peers.collected::<T>()).try_for_each(|peer| (peer.set)(scene, peer.value.with(edited)))
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
pub trait Parts: Copy + Send + Sync + 'static {
    /// Which parts differ.
    fn differs(self, other: Self) -> [bool; 3];

    /// The value with the parts that were edited elsewhere.
    fn with(self, edited: Edited<Self>) -> Self;
}

/// A value without parts.
macro_rules! whole {
    ($type:ty $(, $generic:ident)?) => {
        impl$(<$generic: Copy + PartialEq + Send + Sync + 'static>)? Parts for $type {
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
