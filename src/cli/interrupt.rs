//! Ctrl-C, SIGTERM, and the signal of a file that grows too long.
//!
//! A thread waits for the first two. Where nothing has to be kept, it ends the program at once. While a
//! picture is rendered ([`Interrupt::defer`]) the work is given a few seconds to notice between two
//! steps and end by itself; it may be stuck in a pipe that nobody reads, or in the driver. Then, or at
//! the second signal, the thread ends the program. No part of a file is left either way.

use crate::app::console;
use crate::app::error::AppError;
use crate::output;
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::{flag, low_level};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::channel;
use std::sync::{Arc, OnceLock};
use std::time::{Duration, Instant};

/// The signals that ask for the end and what the program then returns.
const SIGNALS: [(i32, u8); 2] = [(SIGINT, 130), (SIGTERM, 143)];

/// How often the thread looks for a signal.
const PAUSE: Duration = Duration::from_millis(20);

/// How long the work may go on after a signal.
const GRACE: Duration = Duration::from_secs(3);

/// How long the last words may take: the standard error may be a pipe that nobody reads.
const LAST_WORDS: Duration = Duration::from_millis(200);

/// Of the thread, which needs next to nothing.
const STACK_BYTES: usize = 128 << 10;

/// Knows whether a signal has asked for the end. All of them are the same one.
#[derive(Clone)]
pub struct Interrupt(Arc<State>);

#[derive(Default)]
struct State {
    /// Set by the handlers: the exit code that a signal asks for; 0 is none.
    signal: Arc<AtomicUsize>,
    /// The same once the thread has decided that the work may end by itself.
    exit_code: AtomicUsize,
    /// Whether the work notices by itself.
    is_deferred: AtomicBool,
}

impl Interrupt {
    /// Installs the handlers and starts the thread, unless that is done.
    ///
    /// # Errors
    /// The system refuses one of them.
    pub fn install() -> Result<Self, AppError> {
        static INSTALLED: OnceLock<Interrupt> = OnceLock::new();
        if let Some(installed) = INSTALLED.get() {
            return Ok(installed.clone());
        }
        let interrupt = INSTALLED.get_or_init(|| Self(Arc::default()));
        interrupt
            .start()
            .map_err(|error| AppError::Internal(format!("signal handlers: {error}")))?;
        Ok(interrupt.clone())
    }

    fn start(&self) -> std::io::Result<()> {
        let state = self.0.clone();
        let thread = std::thread::Builder::new().name("signals".into());
        thread
            .stack_size(STACK_BYTES)
            .spawn(move || state.listen())?;
        for (signal, code) in SIGNALS {
            flag::register_usize(signal, self.0.signal.clone(), code.into())?;
        }
        Ok(())
    }

    /// Until the result is dropped, the work has some time to end by itself after the first signal.
    pub fn defer(&self) -> Deferred<'_> {
        self.0.is_deferred.store(true, Ordering::SeqCst);
        Deferred(self)
    }

    /// To be called between two steps.
    ///
    /// # Errors
    /// [`AppError::Interrupted`] when a signal has asked for the end.
    pub fn check(&self) -> Result<(), AppError> {
        match u8::try_from(self.0.exit_code.load(Ordering::SeqCst)) {
            Ok(0) => Ok(()),
            Ok(exit_code) => Err(AppError::Interrupted { exit_code }),
            Err(_) => Err(AppError::Internal("unknown signal".into())),
        }
    }
}

/// The work ends by itself until this is dropped.
pub struct Deferred<'a>(&'a Interrupt);

impl Drop for Deferred<'_> {
    fn drop(&mut self) {
        self.0.0.is_deferred.store(false, Ordering::SeqCst);
    }
}

impl State {
    /// The thread's work.
    fn listen(&self) {
        let first = self.next(None).unwrap_or_default();
        if !self.is_deferred.load(Ordering::SeqCst) {
            end(first, false);
        }
        self.exit_code.store(first, Ordering::SeqCst);
        let second = self.next(Some(Instant::now() + GRACE));
        end(second.unwrap_or(first), true);
    }

    /// The exit code that the next signal asks for, unless there is none until `deadline`.
    fn next(&self, deadline: Option<Instant>) -> Option<usize> {
        loop {
            let code = self.signal.swap(0, Ordering::SeqCst);
            if code != 0 {
                return Some(code);
            }
            if deadline.is_some_and(|deadline| Instant::now() >= deadline) {
                return None;
            }
            std::thread::sleep(PAUSE);
        }
    }
}

/// Ends the program without a look at what else is going on in it.
fn end(exit_code: usize, speaks: bool) -> ! {
    output::clear_away();
    if speaks {
        let (sender, receiver) = channel();
        let _ = std::thread::Builder::new().spawn(move || {
            console::error(
                "interrupted: the program was ended before its work could stop. No part of a file is \
                 left.",
                exit_code as u8,
            );
            let _ = sender.send(());
        });
        let _ = receiver.recv_timeout(LAST_WORDS);
    }
    low_level::exit(exit_code as i32)
}

/// Makes a file that grows beyond the limit on file sizes (`ulimit -f`) an error of the one who writes
/// it; else the signal ends the program, and its part of the file stays.
#[cfg(unix)]
pub fn survive_file_size_limit() {
    // Where there is no handler, the program is no worse off than before.
    let _ = flag::register(signal_hook::consts::SIGXFSZ, Arc::default());
}

/// Other systems have no such signal.
#[cfg(not(unix))]
pub fn survive_file_size_limit() {}
