//! The scene that is being edited, with undo and redo.
//!
//! A step stores the previous scene. This is cheap because meshes and images are shared.

use crate::model::objects::Id;
use glimray_scene::{Camera, Instance, Light, Material, Mesh, Node, Scene, Shape, Texture, Track};
use std::mem::size_of;
use std::sync::Arc;

/// Maximum number of undo steps.
const MAX_STEPS: usize = 1000;

/// Approximate limit in bytes for all steps; the last step is always kept.
const MAX_BYTES: usize = 256 << 20;

/// Names of steps that replace the whole scene.
const REVERT: &str = "revert";
const RELOAD: &str = "reload";

/// A scene, its history, and whether it is saved.
#[derive(Clone, Debug)]
pub struct Document {
    scene: Arc<Scene>,
    saved: Arc<Scene>,
    done: Vec<Step>,
    undone: Vec<Step>,
    /// While the last step is still being dragged: [`Document::drag`] extends it.
    dragged: Option<Dragged>,
    /// The selection, so that undo can select it again.
    selected: Arc<[Id]>,
    max_bytes: usize,
}

/// The step that is being dragged.
#[derive(Clone, Debug)]
struct Dragged {
    /// The scene that every change of the drag starts from.
    start: Arc<Scene>,
    /// Whether the drag began the step. Otherwise it goes on with a step that has an effect of its own.
    is_own_step: bool,
}

/// An edit: the scene before it, or after it once it is undone.
#[derive(Clone, Debug)]
struct Step {
    name: String,
    scene: Arc<Scene>,
    selected: Arc<[Id]>,
    /// Approximate size in bytes.
    bytes: usize,
}

impl Document {
    /// A document for a scene as read from its file.
    pub fn new(scene: Scene) -> Self {
        let scene = Arc::new(scene);
        Self {
            saved: scene.clone(),
            scene,
            done: Vec::new(),
            undone: Vec::new(),
            dragged: None,
            selected: Arc::default(),
            max_bytes: MAX_BYTES,
        }
    }

    /// Sets the limit in bytes for all steps, approximately.
    pub fn with_memory(self, max_bytes: usize) -> Self {
        Self { max_bytes, ..self }
    }

    /// The current scene. Every change makes a new one, so [`Arc::ptr_eq`] detects changes.
    pub fn scene(&self) -> &Arc<Scene> {
        &self.scene
    }

    /// Changes the scene in one step. `name` describes it, such as "move sphere 3".
    pub fn edit<T>(&mut self, name: &str, change: impl FnOnce(&mut Scene) -> T) -> T {
        let (scene, result) = changed(&self.scene, change);
        self.release();
        self.push(name, scene);
        result
    }

    /// Changes the scene in one step, or leaves it unchanged.
    ///
    /// # Errors
    /// The error of `change`.
    pub fn try_edit<T, E>(
        &mut self,
        name: &str,
        change: impl FnOnce(&mut Scene) -> Result<T, E>,
    ) -> Result<T, E> {
        let (scene, result) = changed(&self.scene, change);
        if result.is_ok() {
            self.release();
            self.push(name, scene);
        }
        result
    }

    /// Changes the scene as part of one step while a handle is dragged or a key is held, until
    /// [`Document::release`]. `change` gets the scene from before the drag, so that it can apply the total
    /// motion.
    ///
    /// # Errors
    /// The error of `change`; the scene stays unchanged.
    pub fn drag<T, E>(
        &mut self,
        name: &str,
        change: impl FnOnce(&mut Scene) -> Result<T, E>,
    ) -> Result<T, E> {
        let start = match &self.dragged {
            Some(dragged) => &dragged.start,
            None => &self.scene,
        };
        let (scene, result) = changed(start, change);
        let result = result?;
        if self.dragged.is_some() {
            self.scene = Arc::new(scene);
        } else {
            let start = self.scene.clone();
            self.push(name, scene);
            self.dragged = Some(Dragged {
                start,
                is_own_step: true,
            });
        }
        Ok(result)
    }

    /// Lets a drag go on with the last step: what follows until [`Document::release`] belongs to it.
    pub fn go_on(&mut self) {
        self.dragged = Some(Dragged {
            start: self.scene.clone(),
            is_own_step: false,
        });
    }

    /// Ends a drag: the next change is a new step.
    pub fn release(&mut self) {
        self.dragged = None;
    }

    /// Reverts the current drag, and discards its step if it began with the drag.
    pub fn cancel(&mut self) {
        match self.dragged.take() {
            Some(dragged) if dragged.is_own_step => {
                self.done.pop();
                self.scene = dragged.start;
            }
            Some(dragged) => self.scene = dragged.start,
            None => {}
        }
    }

    /// Notes what is selected: a step keeps it with the scene.
    pub fn note_selection(&mut self, selected: &[Id]) {
        if *self.selected != *selected {
            self.selected = selected.into();
        }
    }

    /// The selection when the scene was last as it is now, after [`Document::undo`] or [`Document::redo`].
    pub fn selected(&self) -> &[Id] {
        &self.selected
    }

    /// Undoes the last step and returns its name; `None` if there is none.
    pub fn undo(&mut self) -> Option<String> {
        self.release();
        let step = self.done.pop()?;
        self.undone.push(Step {
            scene: std::mem::replace(&mut self.scene, step.scene),
            selected: std::mem::replace(&mut self.selected, step.selected),
            name: step.name.clone(),
            bytes: step.bytes,
        });
        Some(step.name)
    }

    /// Redoes the last undone step and returns its name; `None` if there is none.
    pub fn redo(&mut self) -> Option<String> {
        self.release();
        let step = self.undone.pop()?;
        self.done.push(Step {
            scene: std::mem::replace(&mut self.scene, step.scene),
            selected: std::mem::replace(&mut self.selected, step.selected),
            name: step.name.clone(),
            bytes: step.bytes,
        });
        Some(step.name)
    }

    /// The name of the step that [`Document::undo`] reverts.
    pub fn undo_name(&self) -> Option<&str> {
        self.done.last().map(|step| step.name.as_str())
    }

    /// The name of the step that [`Document::redo`] repeats.
    pub fn redo_name(&self) -> Option<&str> {
        self.undone.last().map(|step| step.name.as_str())
    }

    /// Whether a step of that name replaces the whole scene.
    pub fn replaces(name: &str) -> bool {
        [REVERT, RELOAD].contains(&name)
    }

    /// Number of steps that can be undone.
    pub fn undo_count(&self) -> usize {
        self.done.len()
    }

    /// Whether the scene has unsaved changes.
    pub fn is_changed(&self) -> bool {
        !Arc::ptr_eq(&self.scene, &self.saved)
    }

    /// Marks the current scene as saved.
    pub fn mark_saved(&mut self) {
        self.release();
        self.saved = self.scene.clone();
    }

    /// Reverts to the saved scene, in a step that can be undone.
    pub fn revert(&mut self) {
        if self.is_changed() {
            self.release();
            let saved = self.saved.clone();
            self.push_shared(REVERT, saved);
        }
    }

    /// Replaces the scene by a new version from its file, which is the saved state. Earlier steps can still
    /// be undone.
    pub fn reload(&mut self, scene: Scene) {
        self.release();
        let scene = Arc::new(scene);
        self.saved = scene.clone();
        self.push_shared(RELOAD, scene);
    }

    fn push(&mut self, name: &str, scene: Scene) {
        self.push_shared(name, Arc::new(scene));
    }

    fn push_shared(&mut self, name: &str, scene: Arc<Scene>) {
        let before = std::mem::replace(&mut self.scene, scene);
        self.undone.clear();
        self.done.push(Step {
            name: name.to_owned(),
            bytes: own_bytes(&before, &self.scene),
            scene: before,
            selected: self.selected.clone(),
        });
        let mut bytes: usize = self.done.iter().map(|step| step.bytes).sum();
        let mut dropped = 0;
        while self.done.len() - dropped > 1
            && (bytes > self.max_bytes || self.done.len() - dropped > MAX_STEPS)
        {
            bytes -= self.done[dropped].bytes;
            dropped += 1;
        }
        self.done.drain(..dropped);
    }
}

fn changed<T>(scene: &Scene, change: impl FnOnce(&mut Scene) -> T) -> (Scene, T) {
    let mut scene = scene.clone();
    let result = change(&mut scene);
    (scene, result)
}

/// Approximate bytes needed to keep `scene` in addition to `next`.
fn own_bytes(scene: &Scene, next: &Scene) -> usize {
    fn of<T>(list: &[T]) -> usize {
        size_of_val(list)
    }
    let mut bytes = size_of::<Scene>();
    bytes += of::<Instance>(&scene.instances) + of::<Shape>(&scene.shapes);
    bytes += of::<Material>(&scene.materials) + of::<Texture>(&scene.textures);
    bytes += of::<Light>(&scene.lights) + of::<Camera>(&scene.cameras);
    bytes += of::<Node>(&scene.nodes) + of::<Track>(&scene.tracks);
    let keys = scene.tracks.iter().map(|track| track.curve.times.len());
    bytes += keys.sum::<usize>() * 8 * size_of::<f64>();
    for (index, mesh) in scene.meshes.iter().enumerate() {
        let is_shared = (next.meshes.get(index)).is_some_and(|other| Arc::ptr_eq(mesh, other));
        if !is_shared {
            let Mesh {
                positions,
                normals,
                uvs,
                second_uvs,
                tangents,
                colors,
                materials,
                triangles,
                ..
            } = mesh.as_ref();
            bytes += of(positions)
                + of(normals)
                + of(uvs)
                + of(second_uvs)
                + of(tangents)
                + of(colors)
                + of(materials)
                + of(triangles);
        }
    }
    for (index, picture) in scene.pictures.iter().enumerate() {
        let is_shared = (next.pictures.get(index)).is_some_and(|other| Arc::ptr_eq(picture, other));
        if !is_shared {
            bytes += picture.texels.byte_len();
        }
    }
    bytes
}
