//! The render thread: it follows the newest [`RenderRequest`]s, adds samples one time slice at a time, and
//! publishes pictures for the window.
//!
//! The thread and the window never block each other: requests replace earlier ones, and the window draws
//! what was published last.

use crate::worker::comparison::{Compared, ShownDifference, StillRequest};
use crate::worker::error_map::ErrorMap;
use crate::worker::progressive_image::{
    FrameRenderer, ImageError, PictureSlot, ProgressiveImage, Shown,
};
use crate::worker::request::{PreparedScene, RenderRequest};
use crate::worker::stage::{Activity, ReportStage, Stage};
use glimray_render::gpu::{Gpu, GpuError};
use glimray_render::{RenderError, Screen};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// The current requests of the window.
#[derive(Clone, Default)]
pub struct RenderRequests {
    /// By [`PictureSlot`]; `None` for unused slots.
    pub pictures: [Option<RenderRequest>; 3],
    /// The scene of the requests if it was packed beforehand.
    pub prepared: Option<PreparedScene>,
    /// The still of a comparison, in place of [`PictureSlot::Beside`].
    pub still: Option<StillRequest>,
    /// Whether the second picture is the main one without denoising.
    pub raw: bool,
    /// A small picture of a material, rendered once the other pictures have a sample.
    pub ball: Option<RenderRequest>,
    /// The difference of both pictures; `None` if it is not shown.
    pub difference: Option<ErrorMap>,
    /// Whether something moves, so that a preview is preferred to a full-resolution picture.
    pub coarse: bool,
    /// Whether rendering is paused.
    pub paused: bool,
}

impl RenderRequests {
    /// Whether both contain the same requests.
    pub fn is_same(&self, other: &Self) -> bool {
        (self.coarse, self.paused) == (other.coarse, other.paused) && self.shows_same(other)
    }

    /// Whether both have the same packed scene, or none.
    pub fn shares_prepared(&self, other: &Self) -> bool {
        let address = |it: &Self| it.prepared.as_ref().map(|it| Arc::as_ptr(&it.packed));
        address(self) == address(other)
    }

    /// Whether both request the same pictures.
    fn shows_same(&self, other: &Self) -> bool {
        self.pictures == other.pictures
            && self.still == other.still
            && (self.difference, self.raw) == (other.difference, other.raw)
    }
}

/// A question that needs a renderer, answered on the thread.
pub type Question<A> = Box<dyn FnOnce(&mut FrameRenderer) -> A + Send>;

/// An error of the thread.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Fault {
    /// The device is lost; all GPU resources must be created again.
    Lost,
    /// The scene or settings cannot be rendered; the last picture stays.
    Refused(String),
}

struct State<A> {
    requests: RenderRequests,
    questions: Vec<Question<A>>,
    answers: Vec<A>,
    shown: [Option<Shown>; 3],
    still: Option<Screen>,
    difference: Option<ShownDifference>,
    ball: Option<Screen>,
    fault: Option<Fault>,
    activity: Option<Activity>,
    is_settled: bool,
    is_closing: bool,
    /// Generation of the current requests.
    generation: u64,
    /// The last generation with a published picture.
    seen: u64,
    /// Whether the window waits for it and needs no other wake-up.
    is_awaited: bool,
}

struct Shared<A> {
    state: Mutex<State<A>>,
    /// Signals the thread that there is work.
    news: Condvar,
    /// Signals the window that there is a picture, or no reason to wait.
    picture_shown: Condvar,
}

impl<A> Shared<A> {
    fn lock(&self) -> MutexGuard<'_, State<A>> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Publishes the stage of the main picture. Returns whether another one has begun.
    fn report(&self, stage: Stage) -> bool {
        let mut state = self.lock();
        let kind = std::mem::discriminant::<Stage>;
        let before = state.activity.take();
        let is_other = before.as_ref().map(|it| kind(&it.stage)) != Some(kind(&stage));
        let since = before.map_or_else(Instant::now, |before| before.since);
        state.activity = Some(Activity { stage, since });
        is_other
    }
}

/// The window's handle of the thread, which ends when it is dropped. `A` is the type of answers.
pub struct RenderThread<A: Send + 'static> {
    shared: Arc<Shared<A>>,
    thread: Option<JoinHandle<()>>,
    gpu: Gpu,
}

impl<A: Send + 'static> RenderThread<A> {
    /// Starts the thread. `wake` is called when something new can be drawn.
    ///
    /// # Errors
    /// The system starts no thread.
    pub fn new(gpu: Gpu, wake: impl Fn() + Send + Sync + 'static) -> std::io::Result<Self> {
        let shared = Arc::new(Shared {
            state: Mutex::new(State {
                requests: RenderRequests::default(),
                questions: Vec::new(),
                answers: Vec::new(),
                shown: [const { None }; 3],
                still: None,
                difference: None,
                ball: None,
                fault: None,
                activity: None,
                is_settled: true,
                is_closing: false,
                generation: 0,
                seen: 0,
                is_awaited: false,
            }),
            news: Condvar::new(),
            picture_shown: Condvar::new(),
        });
        let theirs = shared.clone();
        let wake = Arc::new(wake);
        let (state, wakes) = (shared.clone(), wake.clone());
        let report: ReportStage = Arc::new(move |stage| {
            if state.report(stage) {
                wakes();
            }
        });
        let own = gpu.clone();
        let thread = std::thread::Builder::new()
            .name("render".into())
            .spawn(move || {
                RenderWorker {
                    images: PictureSlot::ALL.map(|place| {
                        let report = match place {
                            PictureSlot::Main => report.clone(),
                            PictureSlot::Beside | PictureSlot::Outside => Arc::new(|_| ()),
                        };
                        ProgressiveImage::new(gpu.clone(), place, report)
                    }),
                    ball: ProgressiveImage::new(gpu.clone(), PictureSlot::Beside, Arc::new(|_| ())),
                    unfit_ball: None,
                    compared: Compared::new(gpu),
                    refused: None,
                }
                .work(&theirs, &*wake);
            })?;
        Ok(Self {
            shared,
            thread: Some(thread),
            gpu: own,
        })
    }

    /// Replaces the requests.
    pub fn submit(&self, requests: RenderRequests) {
        let mut state = self.shared.lock();
        state.requests = requests;
        state.is_settled = false;
        state.generation += 1;
        drop(state);
        self.shared.news.notify_one();
    }

    /// Waits until the last requests have a published picture, so that the next frame of the window shows
    /// it. Returns whether it is available in time, or there is nothing to wait for.
    pub fn wait_for_look(&self, patience: Duration) -> bool {
        let goes_on = |state: &mut State<A>| {
            state.is_awaited =
                state.seen < state.generation && !state.is_settled && state.fault.is_none();
            state.is_awaited
        };
        let (picture_shown, state) = (&self.shared.picture_shown, self.shared.lock());
        let waited = picture_shown.wait_timeout_while(state, patience, goes_on);
        waited.is_ok_and(|(mut state, _)| !std::mem::take(&mut state.is_awaited))
    }

    /// Sends a question to the main picture's renderer; it waits until there is one.
    pub fn ask(&self, question: impl FnOnce(&mut FrameRenderer) -> A + Send + 'static) {
        let mut state = self.shared.lock();
        state.questions.push(Box::new(question));
        state.is_settled = false;
        state.generation += 1;
        drop(state);
        self.shared.news.notify_one();
    }

    /// The answers since the last call.
    pub fn answers(&self) -> Vec<A> {
        std::mem::take(&mut self.shared.lock().answers)
    }

    /// The published picture of a slot.
    pub fn shown(&self, place: PictureSlot) -> Option<Shown> {
        self.shared.lock().shown[place as usize].clone()
    }

    /// The stage of the main picture while it has no sample of a new scene yet, or waits for shaders.
    pub fn activity(&self) -> Option<Activity> {
        self.shared.lock().activity.clone()
    }

    /// The still of a comparison.
    pub fn still(&self) -> Option<Screen> {
        self.shared.lock().still.clone()
    }

    /// The difference of both pictures of a comparison.
    pub fn difference(&self) -> Option<ShownDifference> {
        self.shared.lock().difference.clone()
    }

    /// The small picture of a material so far.
    pub fn ball(&self) -> Option<Screen> {
        self.shared.lock().ball.clone()
    }

    /// The error of the current requests.
    pub fn fault(&self) -> Option<Fault> {
        self.shared.lock().fault.clone()
    }

    /// Whether nothing is left to do: all pictures are finished or paused, and every question is answered.
    pub fn is_settled(&self) -> bool {
        self.shared.lock().is_settled
    }
}

impl<A: Send + 'static> Drop for RenderThread<A> {
    fn drop(&mut self) {
        self.shared.lock().is_closing = true;
        self.shared.news.notify_one();
        // The thread is not to wait for the one that waits for it.
        self.gpu.release_submissions();
        if let Some(thread) = self.thread.take() {
            // A thread that panicked publishes nothing more.
            let _ = thread.join();
        }
    }
}

/// The state of the thread itself.
struct RenderWorker {
    /// In the order of [`PictureSlot::ALL`].
    images: [ProgressiveImage; 3],
    compared: Compared,
    ball: ProgressiveImage,
    /// A ball that cannot be rendered.
    unfit_ball: Option<RenderRequest>,
    /// Requests that failed, to avoid retrying them.
    refused: Option<RenderRequests>,
}

impl RenderWorker {
    fn work<A: Send + 'static>(&mut self, shared: &Shared<A>, wake: impl Fn()) {
        let mut known = 0;
        loop {
            let (requests, questions) = {
                let mut state = shared.lock();
                // Questions that cannot be answered yet wait for the next requests too.
                while !state.is_closing && state.is_settled && state.generation == known {
                    state = (shared.news.wait(state)).unwrap_or_else(PoisonError::into_inner);
                }
                if state.is_closing {
                    return;
                }
                known = state.generation;
                (state.requests.clone(), std::mem::take(&mut state.questions))
            };
            let frames_shown = self.frames_shown();
            let was_refused = self.has_refused(&requests);
            let (outcome, unanswered, answers) = self.round(&requests, questions);
            let is_picture = frames_shown != self.frames_shown();
            let is_other_news = outcome != Ok(true) || !answers.is_empty();
            let mut state = shared.lock();
            if outcome.is_err() || !self.images[2].is_opening() {
                state.activity = None;
            }
            state.answers.extend(answers);
            let has_news = state.generation != known;
            let wakes = is_other_news || is_picture && !state.is_awaited;
            if is_picture || is_other_news {
                state.seen = known;
            }
            state.questions.splice(0..0, unanswered);
            for (image, place) in self.images.iter().zip(PictureSlot::ALL) {
                state.shown[place as usize] = image.shown();
            }
            if requests.raw {
                state.shown[PictureSlot::Beside as usize] = self.images[2].shown_raw();
            }
            state.still = self.compared.still();
            state.difference = self.compared.difference();
            let ball = self.ball.shown();
            state.ball = ball.and_then(|shown| shown.screen.or(shown.under));
            match outcome {
                Ok(is_busy) => {
                    state.fault = (self.refused.is_some().then(|| state.fault.clone())).flatten();
                    let waits = !state.questions.is_empty() && self.images[2].is_ready();
                    state.is_settled = !is_busy && !has_news && !waits;
                }
                Err(fault) => {
                    // After an error, the previous picture continues.
                    state.is_settled = !has_news && (fault == Fault::Lost || was_refused);
                    if fault != Fault::Lost {
                        self.refused = Some(requests);
                    }
                    state.fault = Some(fault);
                }
            }
            drop(state);
            shared.picture_shown.notify_all();
            if wakes {
                wake();
            }
        }
    }

    fn has_refused(&self, requests: &RenderRequests) -> bool {
        (self.refused.as_ref()).is_some_and(|refused| {
            refused.shows_same(requests) && refused.shares_prepared(requests)
        })
    }

    fn frames_shown(&self) -> u64 {
        let images = self.images.iter().chain([&self.ball]);
        let rendered = images.map(ProgressiveImage::frames_shown);
        rendered.sum::<u64>() + self.compared.frames_shown()
    }

    /// Applies the requests; one that fails does not affect the others.
    fn set_requests(&mut self, requests: &RenderRequests) -> Result<(), ImageError> {
        let mut outcome = Ok(());
        for (image, place) in self.images.iter_mut().zip(PictureSlot::ALL) {
            let request = requests.pictures[place as usize].as_ref();
            let prepared = requests.prepared.as_ref();
            outcome = outcome.and(image.set_request(request, requests.coarse, prepared));
        }
        self.images[2].show_raw(requests.raw);
        outcome.and(
            self.compared
                .set_request(requests.still.as_ref())
                .map_err(Into::into),
        )
    }

    /// Applies the requests and does the next piece of work. Returns whether there is more.
    #[allow(
        clippy::type_complexity,
        reason = "three lists that only this file sees"
    )]
    fn round<A>(
        &mut self,
        requests: &RenderRequests,
        questions: Vec<Question<A>>,
    ) -> (Result<bool, Fault>, Vec<Question<A>>, Vec<A>) {
        if !self.has_refused(requests) {
            self.refused = None;
            if let Err(error) = self.set_requests(requests) {
                return (Err(error.into()), questions, Vec::new());
            }
        }
        let mut answers = Vec::new();
        let mut unanswered = Vec::new();
        let [outside, _, main] = &mut self.images;
        for question in questions {
            match main.frame() {
                Some(frame) => answers.push(question(&mut FrameRenderer {
                    outside: outside.frame().map(|it| (it.renderer, it.request)),
                    ..frame
                })),
                None => unanswered.push(question),
            }
        }
        // Questions refer to the full-resolution picture: a paused one continues until it has started.
        let is_asked = !unanswered.is_empty();
        let is_held =
            |image: &ProgressiveImage| requests.paused && !(is_asked && image.is_awaited());
        let has_work = |image: &ProgressiveImage| match is_held(image) {
            true => !image.is_shown(),
            false => !image.is_done(),
        };
        // The ball takes little time, but pictures without a sample come before it.
        let is_late = |image: &ProgressiveImage| has_work(image) && !image.has_sample();
        let draws_ball = self.owes_ball(requests) && !self.images.iter().any(is_late);
        if draws_ball && let Err(fault) = self.draw_ball(requests) {
            return (Err(fault), unanswered, answers);
        }
        // The picture with the least progress comes first, so that both sides of a comparison advance.
        let waiting = self.images.iter_mut().filter(|image| has_work(image));
        let waiting = waiting.filter(|_| !draws_ball);
        if let Some(image) = waiting.min_by(|a, b| a.rank().total_cmp(&b.rank())) {
            let is_held = is_held(image);
            if let Err(error) = image.step(is_held) {
                return (Err(error.into()), unanswered, answers);
            }
        }
        let changes = self.images.iter().any(has_work);
        let is_busy = changes || self.owes_ball(requests);
        let [_, beside, main] = &mut self.images;
        let outcome =
            (self.compared).compare(requests.difference, [beside, main], requests.raw, changes);
        if let Err(error) = outcome {
            return (Err(ImageError::from(error).into()), unanswered, answers);
        }
        (Ok(is_busy), unanswered, answers)
    }
}

impl RenderWorker {
    /// Whether the ball is to be rendered: not while something moves, for which the thread must be free.
    fn owes_ball(&self, requests: &RenderRequests) -> bool {
        let is_fit = requests.ball.is_none() || requests.ball != self.unfit_ball;
        let is_drawn = self.ball.shows(requests.ball.as_ref()) && self.ball.is_done();
        !requests.coarse && is_fit && !is_drawn
    }

    /// Does the next piece of work for the ball. One that cannot be rendered is left out.
    fn draw_ball(&mut self, requests: &RenderRequests) -> Result<(), Fault> {
        let ball = requests.ball.as_ref();
        let outcome =
            (self.ball.set_request(ball, false, None)).and_then(|()| self.ball.step(false));
        match outcome.map_err(Fault::from) {
            Err(Fault::Refused(_)) => {
                self.unfit_ball = requests.ball.clone();
                self.ball
                    .set_request(None, false, None)
                    .map_err(Fault::from)
            }
            other => other,
        }
    }
}

impl From<ImageError> for Fault {
    fn from(error: ImageError) -> Self {
        match error {
            ImageError::Render(RenderError::Gpu(GpuError::Lost)) => Self::Lost,
            other => Self::Refused(other.to_string()),
        }
    }
}
