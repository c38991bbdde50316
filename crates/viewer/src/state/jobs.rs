//! Jobs: files that are being rendered or written, and those that were.

use crate::state::target::Target;
use crate::worker::film::FilmRequest;
use crate::worker::free_name;
use crate::worker::job::JobControl;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};

/// The number of finished jobs that are listed.
const KEPT: usize = 50;

/// The result of a job: the file that was written, `None` if it was cancelled, or an error.
pub type JobOutcome = Result<Option<Written>, String>;

/// A file that was written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Written {
    /// The file.
    pub path: PathBuf,
    /// The message about it.
    pub message: String,
}

/// Identifies a job.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct JobId(u64);

/// A job.
#[derive(Debug)]
pub struct Job {
    /// Identifies it.
    pub id: JobId,
    /// The file that it writes. No other job may write it meanwhile.
    pub path: PathBuf,
    /// Whether something is rendered for the file alone, which takes a while.
    pub renders: bool,
    /// How far it is.
    pub state: JobState,
    /// The progress, and the way to cancel the job.
    pub control: JobControl,
    receiver: Option<Receiver<JobOutcome>>,
    /// The film that it renders; `None` for a picture, and once the film is written, as it holds a whole scene.
    film: Option<Arc<FilmRequest>>,
}

/// How far a job is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum JobState {
    /// Waits for the picture in the window to be finished.
    Waiting(Target),
    /// Renders or writes.
    Running,
    /// The file is written.
    Done,
    /// There is no file, for this reason.
    Failed(String),
    /// The user has ended it.
    Cancelled,
}

/// The means of a new job.
pub struct JobBegun {
    /// Identifies the job.
    pub id: JobId,
    /// For the outcome. A job whose sender is dropped has failed.
    pub sender: Sender<JobOutcome>,
    /// For its progress.
    pub control: JobControl,
}

/// All jobs, the oldest first.
#[derive(Debug, Default)]
pub struct Jobs {
    list: Vec<Job>,
    count: u64,
}

impl Job {
    /// Whether it will still write its file.
    pub fn is_active(&self) -> bool {
        matches!(self.state, JobState::Waiting(_) | JobState::Running)
    }

    /// Whether it takes a while: it renders, or waits for the picture.
    pub fn lasts(&self) -> bool {
        match self.state {
            JobState::Waiting(_) => true,
            JobState::Running => self.renders,
            JobState::Done | JobState::Failed(_) | JobState::Cancelled => false,
        }
    }

    /// Whether it is a film that has ended too early, and can go on.
    pub fn can_resume(&self) -> bool {
        self.film.is_some() && matches!(self.state, JobState::Cancelled | JobState::Failed(_))
    }

    /// The name of its file, without the folder.
    pub fn name(&self) -> String {
        free_name::short(&self.path)
    }
}

impl Jobs {
    /// All of them, the oldest first.
    pub fn all(&self) -> &[Job] {
        &self.list
    }

    /// The jobs that will still write their files, the oldest first.
    pub fn active(&self) -> impl Iterator<Item = &Job> {
        self.list.iter().filter(|job| job.is_active())
    }

    /// The jobs that take a while.
    pub fn lasting(&self) -> impl Iterator<Item = &Job> {
        self.list.iter().filter(|job| job.lasts())
    }

    /// Whether a job works, so that its outcome is to be awaited.
    pub fn is_busy(&self) -> bool {
        self.list.iter().any(|job| job.state == JobState::Running)
    }

    /// Whether a job will write this file.
    pub fn is_reserved(&self, path: &Path) -> bool {
        self.active().any(|job| job.path == path)
    }

    /// Adds a job that works at once. `renders` is [`Job::renders`].
    pub fn begin(&mut self, path: PathBuf, renders: bool) -> JobBegun {
        let id = self.add(path, renders, JobState::Running);
        self.run(id)
    }

    /// Adds a job for a film, which works at once.
    pub fn begin_film(&mut self, film: Arc<FilmRequest>) -> JobBegun {
        let id = self.add(film.path().to_owned(), true, JobState::Running);
        if let Some(job) = self.get_mut(id) {
            job.film = Some(film);
        }
        self.run(id)
    }

    /// The film of a job, if it can go on.
    pub fn film(&self, id: JobId) -> Option<&Arc<FilmRequest>> {
        let job = self.list.iter().find(|job| job.id == id)?;
        job.film.as_ref().filter(|_| job.can_resume())
    }

    /// Adds a job that waits for the picture in the window. One of the same file gives way to it.
    pub fn wait(&mut self, target: Target) {
        let is_same =
            |job: &Job| matches!(&job.state, JobState::Waiting(other) if other.path == target.path);
        self.list.retain(|job| !is_same(job));
        self.add(target.path.clone(), false, JobState::Waiting(target));
    }

    /// Lets a job work that waited, or that goes on.
    pub fn run(&mut self, id: JobId) -> JobBegun {
        let (sender, receiver) = channel();
        let mut control = JobControl::default();
        if let Some(job) = self.get_mut(id) {
            if !job.is_active() {
                job.control = JobControl::default();
            }
            job.state = JobState::Running;
            job.receiver = Some(receiver);
            control = job.control.clone();
        }
        JobBegun {
            id,
            sender,
            control,
        }
    }

    /// Lets a job that works wait again.
    pub fn wait_again(&mut self, id: JobId, target: Target) {
        if let Some(job) = self.get_mut(id) {
            job.receiver = None;
            job.state = match job.control.is_cancelled() {
                true => JobState::Cancelled,
                false => JobState::Waiting(target),
            };
        }
    }

    /// The next job that waits for the picture, with its target.
    pub fn waiting(&self) -> Option<(JobId, &Target)> {
        self.list.iter().find_map(|job| match &job.state {
            JobState::Waiting(target) => Some((job.id, target)),
            _ => None,
        })
    }

    /// Cancels a job that waits or works. One that works ends when it notices.
    pub fn cancel(&mut self, id: JobId) {
        if let Some(job) = self.get_mut(id) {
            job.control.cancel();
            // A render that the render thread has not begun yet may never begin.
            let is_idle = job.renders && !job.control.progress().has_begun();
            if is_idle || matches!(job.state, JobState::Waiting(_)) {
                job.state = JobState::Cancelled;
                job.receiver = None;
            }
        }
    }

    /// Cancels all that take a while.
    pub fn cancel_lasting(&mut self) {
        let ids: Vec<_> = self.lasting().map(|job| job.id).collect();
        ids.into_iter().for_each(|id| self.cancel(id));
    }

    /// Ends a job without a file.
    pub fn fail(&mut self, id: JobId, why: String) {
        if let Some(job) = self.get_mut(id) {
            job.receiver = None;
            job.state = JobState::Failed(why);
        }
    }

    /// Removes those that have ended from the list.
    pub fn clear(&mut self) {
        self.list.retain(Job::is_active);
    }

    /// Takes the outcomes since the last call, and tells each: a file that was written, or an error.
    pub fn update(&mut self, mut tell: impl FnMut(Result<Written, String>)) {
        for job in &mut self.list {
            let Some(receiver) = &job.receiver else {
                continue;
            };
            job.state = match receiver.try_recv() {
                Err(TryRecvError::Empty) => continue,
                Ok(Ok(Some(written))) => {
                    job.path.clone_from(&written.path);
                    job.film = None;
                    tell(Ok(written));
                    JobState::Done
                }
                Ok(Ok(None)) => JobState::Cancelled,
                Ok(Err(why)) => {
                    tell(Err(why.clone()));
                    JobState::Failed(why)
                }
                // The device was lost, or the scene was replaced before the render thread could answer.
                Err(TryRecvError::Disconnected) => {
                    let why = format!(
                        "{} was not written: its rendering was interrupted. Save it again.",
                        job.path.display()
                    );
                    tell(Err(why.clone()));
                    JobState::Failed(why)
                }
            };
            job.receiver = None;
        }
        let ended = self.list.iter().filter(|job| !job.is_active()).count();
        let mut surplus = ended.saturating_sub(KEPT);
        self.list.retain(|job| {
            let is_surplus = surplus > 0 && !job.is_active();
            surplus -= usize::from(is_surplus);
            !is_surplus
        });
    }

    fn add(&mut self, path: PathBuf, renders: bool, state: JobState) -> JobId {
        let id = JobId(self.count);
        self.count += 1;
        self.list.push(Job {
            id,
            path,
            renders,
            state,
            control: JobControl::default(),
            receiver: None,
            film: None,
        });
        id
    }

    fn get_mut(&mut self, id: JobId) -> Option<&mut Job> {
        self.list.iter_mut().find(|job| job.id == id)
    }
}
