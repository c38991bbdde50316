//! Undo and redo of camera movements, one step per gesture.

use super::CameraController;
use glimray_scene::Camera;

/// Maximum number of steps.
const MOST: usize = 200;

/// A view that undo returns to.
#[derive(Clone, Debug, PartialEq)]
enum View {
    /// The scene's own camera, which may have changed since.
    Home,
    /// A camera in world space, and the distance of its pivot if that is not `look_at`.
    At(Box<Camera>, Option<f64>),
}

/// The views before and after the current one. A gesture is a drag, a turn of the wheel or a flight until the camera rests, or
/// a command.
#[derive(Clone, Debug, Default)]
pub struct CameraHistory {
    past: Vec<View>,
    future: Vec<View>,
    known: Option<View>,
    /// Whether changes belong to the last step.
    is_open: bool,
}

impl CameraHistory {
    /// Notes where the camera is going. `rests` says that no gesture goes on.
    pub fn note(&mut self, controller: &CameraController, rests: bool) {
        let view = controller.view();
        if self.known.as_ref() != Some(&view) {
            let before = self.known.replace(view);
            self.past.extend(before.filter(|_| !self.is_open));
            let surplus = self.past.len().saturating_sub(MOST);
            self.past.drain(..surplus);
            self.future.clear();
            self.is_open = true;
        }
        if rests {
            self.end_gesture();
        }
    }

    /// Begins another step with the next change.
    pub fn end_gesture(&mut self) {
        self.is_open = false;
    }

    /// Moves back by a gesture, animated. Returns whether there was one.
    pub fn undo(&mut self, controller: &mut CameraController) -> bool {
        self.note(controller, true);
        let view = self.past.pop();
        let left = view.is_some().then(|| controller.view());
        self.future.extend(left);
        self.go(controller, view)
    }

    /// Repeats the gesture that was undone last, animated. Returns whether there was one.
    pub fn redo(&mut self, controller: &mut CameraController) -> bool {
        self.note(controller, true);
        let view = self.future.pop();
        let left = view.is_some().then(|| controller.view());
        self.past.extend(left);
        self.go(controller, view)
    }

    /// Returns at once to the view that was the last one when `before` was cloned from this, and forgets those after it.
    pub fn return_to(&mut self, before: Self, controller: &mut CameraController) {
        let view = before.known.clone();
        self.go(controller, view);
        controller.arrive();
        *self = before;
    }

    fn go(&mut self, controller: &mut CameraController, view: Option<View>) -> bool {
        match &view {
            None => return false,
            Some(View::Home) => controller.go_home(),
            Some(View::At(camera, reach)) => controller.visit(camera, *reach),
        }
        self.known = Some(controller.view());
        true
    }
}

impl CameraController {
    /// The view after all motion has ended.
    fn view(&self) -> View {
        if self.is_at(&self.home, &self.goal) {
            return View::Home;
        }
        let visited = self.visited.as_ref();
        let reach = visited
            .filter(|known| self.is_at(known, &self.goal))
            .and_then(|known| known.reach);
        View::At(Box::new(self.destination()), reach)
    }
}
