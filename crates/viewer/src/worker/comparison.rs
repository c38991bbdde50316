//! The second picture of a comparison where it is not rendered, and the difference of both pictures.

use crate::worker::progressive_image::{ProgressiveImage, Shown};
use glimray_render::gpu::Gpu;
use glimray_render::{RenderError, Screen, Tone};
use glimray_scene::image::{Difference, Image, Placed, ScreenImage};
use std::sync::Arc;

/// A picture that is compared with the rendered one.
#[derive(Clone, Debug)]
pub struct StillRequest {
    /// Linear radiance, or display values. Compared by address.
    pub picture: Arc<Image>,
    /// How radiance is developed; `None` for display values.
    pub tone: Option<Tone>,
}

impl PartialEq for StillRequest {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.picture, &other.picture) && self.tone == other.tone
    }
}

/// The difference of both pictures as the window can draw it.
#[derive(Clone, Debug)]
pub struct ShownDifference {
    /// The difference, multiplied by the gain.
    pub screen: Screen,
    /// The part of the picture that it covers: x, y, width and height in pixels of the whole picture.
    pub region: [u32; 4],
    /// Whether it is that of a preview.
    pub is_coarse: bool,
    /// Root mean square difference of the displayed colours, without the gain, in 0..=1.
    pub rmse: f64,
    /// Mean absolute difference of the displayed colours, without the gain, in 0..=1.
    pub mean: f64,
}

/// A still as the window draws it.
struct Still {
    image: ScreenImage,
    screen: Screen,
}

/// The inputs of a difference.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Subject {
    gain: f32,
    /// Presentations of both rendered pictures, and number of stills so far.
    states: [u64; 3],
    region: [u32; 4],
    size: (u32, u32),
}

/// The still and the difference that are shown.
pub struct Compared {
    gpu: Gpu,
    request: Option<StillRequest>,
    still: Option<Still>,
    stills: u64,
    subject: Option<Subject>,
    difference: Option<ShownDifference>,
    frames_shown: u64,
}

impl Compared {
    /// An empty one.
    pub fn new(gpu: Gpu) -> Self {
        Self {
            gpu,
            request: None,
            still: None,
            stills: 0,
            subject: None,
            difference: None,
            frames_shown: 0,
        }
    }

    /// The screen of the still.
    pub fn still(&self) -> Option<Screen> {
        self.still.as_ref().map(|still| still.screen.clone())
    }

    /// The current difference.
    pub fn difference(&self) -> Option<ShownDifference> {
        self.difference.clone()
    }

    /// Number of pictures that this has published.
    pub fn frames_shown(&self) -> u64 {
        self.frames_shown
    }

    /// Develops the requested still, unless it is there already.
    ///
    /// # Errors
    /// The device failed.
    pub fn set_request(&mut self, request: Option<&StillRequest>) -> Result<(), RenderError> {
        if self.request.as_ref() == request {
            return Ok(());
        }
        self.still = None;
        self.request = None;
        if let Some(request) = request {
            let image = match &request.tone {
                Some(tone) => ScreenImage::from(&tone.develop(&self.gpu, &request.picture)?),
                None => ScreenImage::from(&*request.picture),
            };
            let screen = Screen::of(&self.gpu, &image)?;
            self.still = Some(Still { image, screen });
            self.request = Some(request.clone());
        }
        self.stills += 1;
        self.frames_shown += 1;
        Ok(())
    }

    /// Updates the difference of the main picture and the second one, which is the still if there is one, or else given with
    /// the number of its presentations. `gain` is `None` if no difference is wanted.
    ///
    /// # Errors
    /// The device failed.
    pub fn compare(
        &mut self,
        gain: Option<f32>,
        main: &ProgressiveImage,
        (beside, beside_shown): (Option<Shown>, u64),
    ) -> Result<(), RenderError> {
        let Some((gain, shown)) = gain.zip(main.shown()) else {
            self.subject = None;
            self.difference = None;
            return Ok(());
        };
        let subject = Subject {
            gain,
            states: [main.frames_shown(), beside_shown, self.stills],
            region: shown.region,
            size: shown.size,
        };
        if self.subject == Some(subject) {
            return Ok(());
        }
        self.difference = self.measured(gain, &shown, beside)?;
        self.frames_shown += u64::from(self.difference.is_some());
        self.subject = Some(subject);
        Ok(())
    }

    fn measured(
        &self,
        gain: f32,
        shown: &Shown,
        beside: Option<Shown>,
    ) -> Result<Option<ShownDifference>, RenderError> {
        let Some(first) = self.read(shown)? else {
            return Ok(None);
        };
        let first = Placed {
            image: &first,
            edges: edges(shown.region, shown.size),
        };
        let other = match (&self.still, beside) {
            (None, Some(shown)) => self.read(&shown)?.map(|image| (image, shown)),
            _ => None,
        };
        let second = match (&self.still, &other) {
            (Some(still), _) => Placed {
                image: &still.image,
                edges: still_edges(still.screen.size(), shown.size),
            },
            (None, Some((image, shown))) => Placed {
                image,
                edges: edges(shown.region, shown.size),
            },
            (None, None) => return Ok(None),
        };
        let Difference { image, rmse, mean } = Difference::new(first, second, gain);
        Ok(Some(ShownDifference {
            screen: Screen::of(&self.gpu, &image)?,
            region: shown.region,
            is_coarse: shown.screen.is_none(),
            rmse,
            mean,
        }))
    }

    /// Reads the visible picture.
    fn read(&self, shown: &Shown) -> Result<Option<ScreenImage>, RenderError> {
        let screen = shown.screen.as_ref().or(shown.under.as_ref());
        screen.map(|screen| screen.read(&self.gpu)).transpose()
    }
}

/// A region in pixels as fractions of the whole picture: left, top, right, bottom.
fn edges([x, y, width, height]: [u32; 4], size: (u32, u32)) -> [f64; 4] {
    let [wide, high] = [size.0, size.1].map(f64::from);
    let [left, top, right, bottom] = [x, y, x + width, y + height].map(f64::from);
    [left / wide, top / high, right / wide, bottom / high]
}

/// The edges of a still in a picture of another size: as high, in the middle, with its own proportions, because
/// a camera's field of view is vertical.
fn still_edges(still: (u32, u32), size: (u32, u32)) -> [f64; 4] {
    let product = |a: u32, b: u32| f64::from(a) * f64::from(b);
    let half = product(still.0, size.1) / product(still.1, size.0) / 2.0;
    [0.5 - half, 0.0, 0.5 + half, 1.0]
}
