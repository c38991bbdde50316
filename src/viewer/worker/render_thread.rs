//! The thread that renders while the window goes on: it follows the newest [`RenderRequest`]s, adds samples a
//! time slice at a time, and puts what there is on screens that the window shows.
//!
//! Nothing here waits for the window, and the window waits for nothing here: orders replace one another,
//! and the window takes what was published last.

use crate::gpu::{Gpu, GpuError};
use crate::render::RenderError;
use crate::viewer::worker::progressive_image::{
    FrameRenderer, ImageError, PictureSlot, ProgressiveImage, Shown,
};
use crate::viewer::worker::request::RenderRequest;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

/// What the window wants at the moment.
#[derive(Clone, Default)]
pub struct RenderRequests {
    /// By [`PictureSlot`]; `None` where nothing is shown.
    pub pictures: [Option<RenderRequest>; 3],
    /// Whether something moves, so that a coarse picture now is worth more than a fine one later.
    pub coarse: bool,
    /// Whether nothing more is to be added.
    pub paused: bool,
}

impl RenderRequests {
    /// Whether both want the same.
    pub fn is_same(&self, other: &Self) -> bool {
        (self.coarse, self.paused) == (other.coarse, other.paused)
            && self.pictures == other.pictures
    }
}

/// A question that needs a renderer, and the answer to it.
pub type Question<A> = Box<dyn FnOnce(&mut FrameRenderer) -> A + Send>;

/// What went wrong.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Fault {
    /// The device is gone; all that was on it must be made again on another.
    Lost,
    /// This scene or these settings cannot be rendered; the last picture stays.
    Refused(String),
}

struct State<A> {
    orders: RenderRequests,
    questions: Vec<Question<A>>,
    answers: Vec<A>,
    shown: [Option<Shown>; 3],
    fault: Option<Fault>,
    is_settled: bool,
    is_closing: bool,
    /// How often something was wanted.
    wishes: u64,
    /// The last wish of which there is something to see.
    seen: u64,
    /// Whether the window waits for that, and needs no other frame for it.
    is_awaited: bool,
}

struct Shared<A> {
    state: Mutex<State<A>>,
    /// For the thread: there is something to do.
    news: Condvar,
    /// For the window: there is something to see, or nothing to wait for.
    looks: Condvar,
}

impl<A> Shared<A> {
    fn lock(&self) -> MutexGuard<'_, State<A>> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The window's end of the thread, which ends with it. Questions are answered by values of `A`.
pub struct RenderThread<A: Send + 'static> {
    shared: Arc<Shared<A>>,
    thread: Option<JoinHandle<()>>,
}

impl<A: Send + 'static> RenderThread<A> {
    /// Starts the thread. `wake` is called when there is something new to see.
    pub fn new(gpu: Gpu, wake: impl Fn() + Send + 'static) -> std::io::Result<Self> {
        let shared = Arc::new(Shared {
            state: Mutex::new(State {
                orders: RenderRequests::default(),
                questions: Vec::new(),
                answers: Vec::new(),
                shown: [const { None }; 3],
                fault: None,
                is_settled: true,
                is_closing: false,
                wishes: 0,
                seen: 0,
                is_awaited: false,
            }),
            news: Condvar::new(),
            looks: Condvar::new(),
        });
        let theirs = shared.clone();
        let thread = std::thread::Builder::new()
            .name("render".into())
            .spawn(move || {
                Painter {
                    canvases: PictureSlot::ALL
                        .map(|place| ProgressiveImage::new(gpu.clone(), place)),
                    refused: None,
                }
                .work(&theirs, wake);
            })?;
        Ok(Self {
            shared,
            thread: Some(thread),
        })
    }

    /// Replaces what is wanted.
    pub fn order(&self, orders: RenderRequests) {
        let mut state = self.shared.lock();
        state.orders = orders;
        state.is_settled = false;
        state.wishes += 1;
        drop(state);
        self.shared.news.notify_one();
    }

    /// Waits until there is something to see of what was ordered last, so that it is in the next frame of
    /// the window and not in the one after. Whether that came in time, or there is nothing to wait for.
    pub fn wait_for_look(&self, patience: Duration) -> bool {
        let goes_on = |state: &mut State<A>| {
            state.is_awaited =
                state.seen < state.wishes && !state.is_settled && state.fault.is_none();
            state.is_awaited
        };
        let (looks, state) = (&self.shared.looks, self.shared.lock());
        let waited = looks.wait_timeout_while(state, patience, goes_on);
        waited.is_ok_and(|(mut state, _)| !std::mem::take(&mut state.is_awaited))
    }

    /// Asks something of the main picture's renderer; not before there is one.
    pub fn ask(&self, question: impl FnOnce(&mut FrameRenderer) -> A + Send + 'static) {
        let mut state = self.shared.lock();
        state.questions.push(Box::new(question));
        state.is_settled = false;
        state.wishes += 1;
        drop(state);
        self.shared.news.notify_one();
    }

    /// What was answered since the last call.
    pub fn answers(&self) -> Vec<A> {
        std::mem::take(&mut self.shared.lock().answers)
    }

    /// What there is to see at a place.
    pub fn shown(&self, place: PictureSlot) -> Option<Shown> {
        self.shared.lock().shown[place as usize].clone()
    }

    /// What went wrong with what is wanted now.
    pub fn fault(&self) -> Option<Fault> {
        self.shared.lock().fault.clone()
    }

    /// Whether nothing is left to do: all pictures have their samples or wait, every question has its
    /// answer.
    pub fn is_settled(&self) -> bool {
        self.shared.lock().is_settled
    }
}

impl<A: Send + 'static> Drop for RenderThread<A> {
    fn drop(&mut self) {
        self.shared.lock().is_closing = true;
        self.shared.news.notify_one();
        if let Some(thread) = self.thread.take() {
            // A thread that panicked has nothing more to say.
            let _ = thread.join();
        }
    }
}

/// The thread's own.
struct Painter {
    /// In the order of [`PictureSlot::ALL`].
    canvases: [ProgressiveImage; 3],
    /// The orders that cannot be followed, so as not to try them again and again.
    refused: Option<[Option<RenderRequest>; 3]>,
}

impl Painter {
    fn work<A: Send + 'static>(&mut self, shared: &Shared<A>, wake: impl Fn()) {
        let mut known = 0;
        loop {
            let (orders, questions) = {
                let mut state = shared.lock();
                // Questions that cannot be answered yet wait for the next wish too.
                while !state.is_closing && state.is_settled && state.wishes == known {
                    state = (shared.news.wait(state)).unwrap_or_else(PoisonError::into_inner);
                }
                if state.is_closing {
                    return;
                }
                known = state.wishes;
                (state.orders.clone(), std::mem::take(&mut state.questions))
            };
            let looks = self.looks();
            let was_refused = self.has_refused(&orders);
            let (outcome, unanswered, answers) = self.round(&orders, questions);
            let is_picture = looks != self.looks();
            let is_other_news = outcome != Ok(true) || !answers.is_empty();
            let mut state = shared.lock();
            state.answers.extend(answers);
            let has_news = state.wishes != known;
            let wakes = is_other_news || is_picture && !state.is_awaited;
            if is_picture || is_other_news {
                state.seen = known;
            }
            state.questions.splice(0..0, unanswered);
            for (canvas, place) in self.canvases.iter().zip(PictureSlot::ALL) {
                state.shown[place as usize] = canvas.shown();
            }
            match outcome {
                Ok(is_busy) => {
                    state.fault = (self.refused.is_some().then(|| state.fault.clone())).flatten();
                    let waits = !state.questions.is_empty() && self.canvases[2].is_ready();
                    state.is_settled = !is_busy && !has_news && !waits;
                }
                Err(fault) => {
                    // After a refusal what there was before goes on.
                    state.is_settled = !has_news && (fault == Fault::Lost || was_refused);
                    if fault != Fault::Lost {
                        self.refused = Some(orders.pictures);
                    }
                    state.fault = Some(fault);
                }
            }
            drop(state);
            shared.looks.notify_all();
            if wakes {
                wake();
            }
        }
    }

    fn has_refused(&self, orders: &RenderRequests) -> bool {
        self.refused.as_ref() == Some(&orders.pictures)
    }

    fn looks(&self) -> u64 {
        self.canvases.iter().map(ProgressiveImage::looks).sum()
    }

    /// Takes up the orders; those that can be followed are, whatever becomes of the others.
    fn follow(&mut self, orders: &RenderRequests) -> Result<(), ImageError> {
        let mut outcome = Ok(());
        for (canvas, place) in self.canvases.iter_mut().zip(PictureSlot::ALL) {
            let order = orders.pictures[place as usize].as_ref();
            outcome = outcome.and(canvas.follow(order, orders.coarse));
        }
        outcome
    }

    /// Follows the orders and does the next piece of work. Whether there is more.
    #[allow(
        clippy::type_complexity,
        reason = "three lists that only this file sees"
    )]
    fn round<A>(
        &mut self,
        orders: &RenderRequests,
        questions: Vec<Question<A>>,
    ) -> (Result<bool, Fault>, Vec<Question<A>>, Vec<A>) {
        let mut is_busy = false;
        if !self.has_refused(orders) {
            self.refused = None;
            if let Err(error) = self.follow(orders) {
                return (Err(error.into()), questions, Vec::new());
            }
        }
        let mut answers = Vec::new();
        let mut unanswered = Vec::new();
        let [outside, _, main] = &mut self.canvases;
        for question in questions {
            match main.studio() {
                Some(studio) => answers.push(question(&mut FrameRenderer {
                    outside: outside.studio().map(|it| (it.renderer, it.order)),
                    ..studio
                })),
                None => unanswered.push(question),
            }
        }
        // Questions are about the picture in full: a paused one goes on until it has begun.
        let is_asked = !unanswered.is_empty();
        let is_held =
            |canvas: &ProgressiveImage| orders.paused && !(is_asked && canvas.is_awaited());
        let has_work = |canvas: &ProgressiveImage| match is_held(canvas) {
            true => !canvas.is_shown(),
            false => !canvas.is_done(),
        };
        // What is behind comes first: of two pictures side by side neither waits for the other.
        let waiting = self.canvases.iter_mut().filter(|canvas| has_work(canvas));
        if let Some(canvas) = waiting.min_by(|a, b| a.rank().total_cmp(&b.rank())) {
            let is_held = is_held(canvas);
            if let Err(error) = canvas.step(is_held) {
                return (Err(error.into()), unanswered, answers);
            }
            is_busy = self.canvases.iter().any(has_work);
        }
        (Ok(is_busy), unanswered, answers)
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
