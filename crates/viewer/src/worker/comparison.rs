//! The second picture of a comparison where it is not rendered, and the difference of both pictures.

use crate::worker::error_map::{self, ErrorMap, Measure, linear};
use crate::worker::progressive_image::{ProgressiveImage, Shown};
use glimray_render::gpu::Gpu;
use glimray_render::{RenderError, Screen, Tone};
use glimray_scene::image::{Difference, Errors, Image, Placed, ScreenImage};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Minimum interval between error maps that pass through the host, while the pictures change; at least 4× the time of the last.
const PAUSE: Duration = Duration::from_millis(500);
const PAUSES: u32 = 4;

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
    /// The measure of the difference.
    pub measure: Measure,
    /// The part of the picture that it covers: x, y, width and height in pixels of the whole picture.
    pub region: [u32; 4],
    /// Whether it is that of a preview.
    pub is_coarse: bool,
    /// Root mean square of the error, without the gain. A difference of displayed colours is in 0..=1.
    pub rmse: f64,
    /// Mean of the error, without the gain.
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
    map: ErrorMap,
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
    /// When the last error map was ready, and how long it took.
    last: Option<(Instant, Duration)>,
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
            last: None,
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

    /// Updates the difference of the main picture and the second one, which is the still if there is one, or else the other of
    /// `pictures`: the main one comes last, and `raw` makes the second the main one without denoising. `map` is `None` if no
    /// difference is wanted. While the pictures change, costly maps are not computed for each of their presentations.
    ///
    /// # Errors
    /// The device failed.
    pub fn compare(
        &mut self,
        map: Option<ErrorMap>,
        [beside, main]: [&mut ProgressiveImage; 2],
        raw: bool,
        changes: bool,
    ) -> Result<(), RenderError> {
        let Some((map, shown)) = map.zip(main.shown()) else {
            self.subject = None;
            self.difference = None;
            return Ok(());
        };
        let second = if raw { &*main } else { &*beside };
        let subject = Subject {
            map,
            states: [main.frames_shown(), second.frames_shown(), self.stills],
            region: shown.region,
            size: shown.size,
        };
        let is_coarse = shown.screen.is_none();
        let waits = map.measure != Measure::Absolute
            && (changes || is_coarse)
            && (self.last).is_some_and(|(end, took)| end.elapsed() < PAUSE.max(PAUSES * took));
        let is_other_map = self.subject.is_none_or(|before| before.map != map);
        if self.subject == Some(subject) || waits && !is_other_map {
            return Ok(());
        }
        let started = Instant::now();
        let found = match map.measure.is_of_linear_values() {
            true => self.linear_difference(map, [beside, main], raw)?,
            false => {
                let beside = if raw {
                    main.shown_raw()
                } else {
                    beside.shown()
                };
                self.displayed_difference(map, &shown, beside)?
            }
        };
        // The last one stays until both pictures have samples again.
        if found.is_none() && changes && !is_other_map {
            return Ok(());
        }
        self.difference = found;
        self.last = Some((Instant::now(), started.elapsed()));
        self.frames_shown += u64::from(self.difference.is_some());
        self.subject = Some(subject);
        Ok(())
    }

    /// The difference of the pictures as they are displayed.
    fn displayed_difference(
        &self,
        map: ErrorMap,
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
        if map.measure == Measure::Flip {
            let errors = error_map::flip(first, second);
            let found = errors.map(|errors| self.painted(map, &errors, shown));
            return found.transpose();
        }
        let Difference { image, rmse, mean } = Difference::new(first, second, map.gain);
        self.of_image(map, &image, shown, [rmse, mean]).map(Some)
    }

    /// The relative error of the pictures before exposure and tone curve.
    fn linear_difference(
        &self,
        map: ErrorMap,
        [beside, main]: [&mut ProgressiveImage; 2],
        raw: bool,
    ) -> Result<Option<ShownDifference>, RenderError> {
        let Some((first, shown)) = main.linear(false)?.zip(main.shown()) else {
            return Ok(None);
        };
        let (second, edges_of_second) = match (&self.request, raw) {
            (Some(still), _) => {
                let image = match still.tone {
                    Some(_) => still.picture.clone(),
                    None => Arc::new(linear(&still.picture)),
                };
                let edges = still_edges((image.width, image.height), shown.size);
                (Some(image), edges)
            }
            (None, true) => (
                main.linear(true)?.map(Arc::new),
                edges(shown.region, shown.size),
            ),
            (None, false) => {
                let other = beside.shown();
                let edges = other.map_or([0.0, 0.0, 1.0, 1.0], |it| edges(it.region, it.size));
                (beside.linear(false)?.map(Arc::new), edges)
            }
        };
        let Some(second) = second else {
            return Ok(None);
        };
        let first = Placed {
            image: &first,
            edges: edges(shown.region, shown.size),
        };
        let second = Placed {
            image: &*second,
            edges: edges_of_second,
        };
        let errors = map.relative(first, second);
        self.painted(map, &errors, &shown).map(Some)
    }

    fn painted(
        &self,
        map: ErrorMap,
        errors: &Errors,
        shown: &Shown,
    ) -> Result<ShownDifference, RenderError> {
        let figures = [errors.rms(), errors.mean()];
        self.of_image(map, &map.painted(errors), shown, figures)
    }

    fn of_image(
        &self,
        map: ErrorMap,
        image: &ScreenImage,
        shown: &Shown,
        [rmse, mean]: [f64; 2],
    ) -> Result<ShownDifference, RenderError> {
        Ok(ShownDifference {
            screen: Screen::of(&self.gpu, image)?,
            measure: map.measure,
            region: shown.region,
            is_coarse: shown.screen.is_none(),
            rmse,
            mean,
        })
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
