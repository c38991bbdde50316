//! Decides which existing frames are reused and which are rendered.

use crate::animate::Sequence;
use crate::interrupt::Interrupt;
use crate::report::Redone;
use glimray_app::error::AppError;
use glimray_app::inputs::Inputs;
use glimray_app::sequence::journal::{Journal, Origin, State};
use glimray_io::output;

/// Largest number of frame ranges in a message.
const MAX_LISTED: usize = 6;

/// The frames of a run in order, and the state of each one's file.
pub struct Plan(Vec<(u32, State)>);

impl Plan {
    /// Finds the state of every frame, and prints which are reused and which are rendered again. `origin`
    /// gives the origin from which a frame would be rendered.
    ///
    /// # Errors
    /// A file must not be replaced, a frame is missing with `--encode-only`, or a signal requested termination.
    pub fn new(
        sequence: &Sequence,
        origin: impl Fn(u32) -> Result<Origin, AppError>,
        journal: Option<&Journal>,
        interrupt: &Interrupt,
    ) -> Result<Self, AppError> {
        let numbers = sequence.timeline.numbers();
        let states = numbers.map(|number| {
            interrupt.check()?;
            let state = match (&sequence.target.frames, journal) {
                (Some(files), Some(journal)) => {
                    journal.state(&files.pattern, number, || origin(number))?
                }
                _ => State::Absent,
            };
            Ok((number, state))
        });
        let plan = Self(states.collect::<Result<_, AppError>>()?);
        plan.check(sequence)?;
        plan.print(sequence);
        Ok(plan)
    }

    /// Refuses to write or discard a frame that is one of the run's inputs, and to write a frame through a
    /// link.
    pub fn protect(&self, sequence: &Sequence, inputs: &Inputs) -> Result<(), AppError> {
        let Some(files) = &sequence.target.frames else {
            return Ok(());
        };
        for (number, state) in &self.0 {
            let path = files.pattern.path(*number);
            if *state != State::Done {
                output::check_no_link(&path)?;
            }
            if *state != State::Done || !sequence.target.keeps_frames {
                inputs.refuse_overwrite(&path, "frame", sequence.target.frames_flag())?;
            }
        }
        Ok(())
    }

    pub fn frames(&self) -> impl Iterator<Item = (u32, bool)> {
        (self.0.iter()).map(|(number, state)| (*number, *state == State::Done))
    }

    pub fn count(&self) -> usize {
        self.0.len()
    }

    /// Number of frames that need not be rendered.
    pub fn done_count(&self) -> usize {
        self.frames().filter(|(_, done)| *done).count()
    }

    /// Existing frames that cannot be reused, by reason.
    pub fn redone(&self) -> Vec<Redone> {
        let mut groups: Vec<Redone> = Vec::new();
        for (number, state) in &self.0 {
            let why = match state {
                State::Stale(why) => why,
                State::Foreign => "no known run wrote the file",
                State::Absent | State::Done => continue,
            };
            match groups.iter_mut().find(|group| group.why == why) {
                Some(group) => group.frames.push(*number),
                None => groups.push(Redone {
                    why,
                    frames: vec![*number],
                }),
            }
        }
        groups
    }

    fn check(&self, sequence: &Sequence) -> Result<(), AppError> {
        let Some(files) = &sequence.target.frames else {
            return Ok(());
        };
        let foreign = self.0.iter().find(|(_, state)| *state == State::Foreign);
        if let Some((number, _)) = foreign.filter(|_| sequence.flags.no_clobber) {
            return Err(AppError::Unwritable(format!(
                "cannot write frame {number} ({}): the file exists, and no known run of this \
                 animation wrote it. Choose another name, or omit --no-clobber.",
                files.pattern.path(*number).display()
            )));
        }
        if sequence.flags.encode_only && self.done_count() < self.count() {
            let mut why: Vec<_> = self.redone().iter().map(reason).collect();
            let absent = self.0.iter().filter(|(_, state)| *state == State::Absent);
            let absent: Vec<_> = absent.map(|(number, _)| *number).collect();
            if !absent.is_empty() {
                why.push(format!("{}: not rendered yet", list(&absent)));
            }
            return Err(AppError::Refused(format!(
                "cannot use the frames ({}): {}. Omit --encode-only to render them.",
                files.pattern.folder().display(),
                why.join("; ")
            )));
        }
        Ok(())
    }

    fn print(&self, sequence: &Sequence) {
        let console = sequence.job.console();
        let done = self.done_count();
        let count = self.count();
        if done > 0 && done < count {
            console.status(format_args!("{done} of {count} frames are already done"));
        }
        for group in self.redone() {
            console.status(format_args!("re-rendering {}", reason(&group)));
        }
    }
}

/// `frames 3, 5..9: the scene has changed`.
fn reason(group: &Redone) -> String {
    format!("{}: {}", list(&group.frames), group.why)
}

/// `frame 3` or `frames 3, 5..9`, for increasing numbers.
fn list(numbers: &[u32]) -> String {
    let mut runs: Vec<(u32, u32)> = Vec::new();
    for &number in numbers {
        match runs.last_mut() {
            Some((_, last)) if *last + 1 == number => *last = number,
            _ => runs.push((number, number)),
        }
    }
    let shown = runs.iter().take(MAX_LISTED).map(|(first, last)| {
        if first == last {
            first.to_string()
        } else {
            format!("{first}..{last}")
        }
    });
    let mut text = shown.collect::<Vec<_>>().join(", ");
    let hidden = runs.iter().skip(MAX_LISTED);
    let hidden: u32 = hidden.map(|(first, last)| last - first + 1).sum();
    if hidden > 0 {
        text += &format!(" and {hidden} more");
    }
    let plural = if numbers.len() == 1 { "" } else { "s" };
    format!("frame{plural} {text}")
}
