//! Ctrl-C, SIGTERM, and the signal for exceeding the file size limit.
//!
//! A thread waits for the first two. It normally ends the program at once. While a picture is rendered
//! ([`Interrupt::defer`]), the work has a few seconds to notice the signal between two steps and stop by
//! itself. If it is stuck in the driver or in a pipe that nobody reads, or at a second signal, the thread
//! ends the program. Writing a checkpoint ([`Interrupt::saving`]) may take longer. Either way no partial file
//! is left.
//!
//! Signals belong to the host of a command, where there is one, and the work asks it.

use glimray_app::console;
use glimray_app::error::AppError;
use glimray_app::host;
use glimray_io::output;
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::{flag, low_level};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::channel;
use std::sync::{Arc, OnceLock};
use std::time::{Duration, Instant};

/// Signals that request termination, and their exit codes.
const SIGNALS: [(i32, u8); 2] = [(SIGINT, 130), (SIGTERM, 143)];

/// Interval at which the thread polls for a signal.
const PAUSE: Duration = Duration::from_millis(20);

/// Time for the work to stop by itself after a signal.
const GRACE: Duration = Duration::from_secs(3);

/// Time after a signal in which a checkpoint may be written. With [`GRACE`] it is below the 30 seconds after which
/// batch engines kill (Slurm's `KillWait`).
const SAVING: Duration = Duration::from_secs(22);

/// Time limit for the last message: standard error may be a pipe that nobody reads.
const MESSAGE_LIMIT: Duration = Duration::from_millis(200);

/// Stack size of the thread.
const STACK_BYTES: usize = 128 << 10;

/// Tells whether a signal has requested termination. All instances share one state.
#[derive(Clone)]
pub struct Interrupt(Arc<State>);

#[derive(Default)]
struct State {
    /// Set by the handlers: the exit code for the signal; 0 means no signal.
    signal: Arc<AtomicUsize>,
    /// The exit code, once the thread has let the work stop by itself.
    exit_code: AtomicUsize,
    /// Whether the work checks for signals and stops by itself.
    is_deferred: AtomicBool,
    /// Whether a checkpoint is being written.
    is_saving: AtomicBool,
}

impl Interrupt {
    /// Installs the handlers and starts the thread, once per process.
    ///
    /// # Errors
    /// The system refuses a handler or the thread.
    pub fn install() -> Result<Self, AppError> {
        static INSTALLED: OnceLock<Interrupt> = OnceLock::new();
        if host::current().is_some() {
            return Ok(Self(Arc::default()));
        }
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

    /// Until the result is dropped, the work may stop by itself after the first signal.
    pub fn defer(&self) -> Deferred<'_> {
        Deferred::new(&self.0.is_deferred)
    }

    /// Until the result is dropped, deferred work may take longer to stop after the first signal.
    pub fn saving(&self) -> Deferred<'_> {
        Deferred::new(&self.0.is_saving)
    }

    /// Checks for a signal. To be called between two steps.
    ///
    /// # Errors
    /// [`AppError::Interrupted`] if a signal or the host has requested termination.
    pub fn check(&self) -> Result<(), AppError> {
        if host::current().is_some_and(|host| host.is_stopped()) {
            return Err(AppError::Interrupted {
                exit_code: SIGNALS[0].1,
            });
        }
        match u8::try_from(self.0.exit_code.load(Ordering::SeqCst)) {
            Ok(0) => Ok(()),
            Ok(exit_code) => Err(AppError::Interrupted { exit_code }),
            Err(_) => Err(AppError::Internal("unknown signal".into())),
        }
    }
}

/// Sets a flag until it is dropped.
pub struct Deferred<'a>(&'a AtomicBool);

impl<'a> Deferred<'a> {
    fn new(flag: &'a AtomicBool) -> Self {
        flag.store(true, Ordering::SeqCst);
        Self(flag)
    }
}

impl Drop for Deferred<'_> {
    fn drop(&mut self) {
        self.0.store(false, Ordering::SeqCst);
    }
}

impl State {
    /// The thread's main function.
    fn listen(&self) {
        let first = self.next(None).unwrap_or_default();
        if !self.is_deferred.load(Ordering::SeqCst) {
            end(first, false);
        }
        self.exit_code.store(first, Ordering::SeqCst);
        let second = self.next(Some(Instant::now()));
        end(second.unwrap_or(first), true);
    }

    /// Waits for the next signal and returns its exit code; `None` if none arrives in the time that the work has
    /// after the first one, which arrived at `first`.
    fn next(&self, first: Option<Instant>) -> Option<usize> {
        let mut deadline = first.map(|first| first + GRACE);
        loop {
            let code = self.signal.swap(0, Ordering::SeqCst);
            if code != 0 {
                return Some(code);
            }
            let is_saving = self.is_saving.load(Ordering::SeqCst);
            if is_saving && first.is_some_and(|first| first.elapsed() < SAVING) {
                deadline = Some(Instant::now() + GRACE);
            }
            if deadline.is_some_and(|deadline| Instant::now() >= deadline) {
                return None;
            }
            std::thread::sleep(PAUSE);
        }
    }
}

/// Ends the program at once, whatever its other threads are doing.
fn end(exit_code: usize, prints_error: bool) -> ! {
    output::remove_unfinished_files();
    if prints_error {
        let (sender, receiver) = channel();
        let _ = std::thread::Builder::new().spawn(move || {
            console::error(
                "interrupted: the program was ended before its work could stop. No partial file is left.",
                exit_code as u8,
            );
            let _ = sender.send(());
        });
        let _ = receiver.recv_timeout(MESSAGE_LIMIT);
    }
    low_level::exit(exit_code as i32)
}

/// Makes exceeding the file size limit (`ulimit -f`) a write error. Without a handler the signal would end
/// the program and leave a partial file.
#[cfg(unix)]
pub fn survive_file_size_limit() {
    // If it cannot be installed, the default behaviour remains.
    let _ = flag::register(signal_hook::consts::SIGXFSZ, Arc::default());
}

/// Other systems have no such signal.
#[cfg(not(unix))]
pub fn survive_file_size_limit() {}
