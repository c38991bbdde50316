//! A material that is dragged onto an object.

use crate::model::objects::Id;
use glimray_scene::ObjectRef;

/// The lines of the outline, or the material of a preview, that are being dragged.
pub struct Dragged(pub Vec<Id>);

impl Dragged {
    /// The index of the material, if it is one.
    pub fn material(&self) -> Option<usize> {
        match self.0[..] {
            [Id::Material(index)] => Some(index),
            _ => None,
        }
    }
}

/// A material in the hand, and what it is over.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Dropping {
    /// The index of the material.
    pub material: usize,
    /// The object that it would be dropped on.
    pub over: Option<ObjectRef>,
    /// That object in this frame, as far as it is drawn.
    pub next: Option<ObjectRef>,
    /// The pixel of the picture about which the renderer was asked, and its object once it has answered.
    pub(crate) asked: Option<([u32; 2], Option<Option<ObjectRef>>)>,
}

impl Dropping {
    /// A material over nothing yet.
    pub fn new(material: usize) -> Self {
        Self {
            material,
            over: None,
            next: None,
            asked: None,
        }
    }
}
