//! A walk through the scene: keys move the camera, the mouse looks.

use crate::model::camera::CameraHistory;

/// A walk that goes on.
#[derive(Clone, Debug)]
pub struct Walk {
    /// The movements of the camera before it; their last view is that from which the walk began.
    pub(crate) before: CameraHistory,
    /// Factor on the speed of a flight.
    pub(crate) pace: f64,
}

impl Walk {
    /// The slowest and the fastest pace.
    pub const PACES: [f64; 2] = [0.01, 100.0];
}
