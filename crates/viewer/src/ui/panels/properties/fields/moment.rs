//! A scene at a time.

use crate::model::objects::{self, EditError, Freedom, Id};
use glam::DAffine3;
use glimray_scene::{Frame, Scene, Target};
use std::cell::{OnceCell, RefCell};
use std::collections::HashSet;
use std::rc::Rc;

/// A scene at a time: what rows of many objects ask for is found once.
pub struct Moment<'a> {
    scene: &'a Scene,
    time: f64,
    frame: OnceCell<Frame>,
    driven: OnceCell<HashSet<Target>>,
    edited: Rc<RefCell<Option<Frame>>>,
}

impl<'a> Moment<'a> {
    pub fn new(scene: &'a Scene, time: f64) -> Self {
        Self {
            scene,
            time,
            frame: OnceCell::new(),
            driven: OnceCell::new(),
            edited: Rc::default(),
        }
    }

    /// The transform of an object; see [`objects::place`].
    pub fn place(&self, id: Id) -> Option<DAffine3> {
        let frame = self.frame.get_or_init(|| self.scene.frame(self.time));
        objects::place_in(self.scene, frame, id)
    }

    /// Whether a track animates a property.
    pub fn drives(&self, target: Target) -> bool {
        let find = || {
            (self
                .scene
                .tracks
                .iter()
                .flat_map(|it| it.targets.iter().copied()))
            .collect()
        };
        self.driven.get_or_init(find).contains(&target)
    }

    /// How an object can be transformed.
    pub fn freedom(&self, id: Id) -> Freedom {
        objects::freedom_if(self.scene, id, |target| self.drives(target))
    }

    /// Sets the transforms of objects in one change; see [`objects::set_place`].
    pub fn set_place(
        &self,
        id: Id,
    ) -> impl FnOnce(&mut Scene, DAffine3) -> Result<(), EditError> + Clone + use<> {
        let (time, edited) = (self.time, self.edited.clone());
        move |scene, wanted| {
            let mut kept = edited.borrow_mut();
            let frame = kept.get_or_insert_with(|| scene.frame(time));
            let done = objects::set_place_in(scene, frame, id, wanted);
            // A node carries others.
            if matches!(id, Id::Node(_)) {
                *kept = None;
            }
            done
        }
    }
}
