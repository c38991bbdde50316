//! Ctrl-C and SIGTERM. While there is nothing to tidy up they end the program at once; while a
//! picture is rendered the first one is noticed between two steps, and the second ends it at once.
//! Nothing partial is left on the disk either way.

use super::exit::AppError;
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// The signals that ask for the end and what the program then returns.
const SIGNALS: [(i32, u8); 2] = [(SIGINT, 130), (SIGTERM, 143)];

/// Knows whether a signal has asked for the end.
pub struct Interrupt {
    /// Whether the next signal ends the program inside its handler.
    at_once: Arc<AtomicBool>,
    /// The exit code that a signal asked for; 0 is none.
    exit_code: Arc<AtomicUsize>,
}

impl Interrupt {
    /// Installs the handlers.
    ///
    /// # Errors
    /// The system refuses to install them.
    pub fn install() -> Result<Self, AppError> {
        let interrupt = Self {
            at_once: Arc::new(AtomicBool::new(true)),
            exit_code: Arc::default(),
        };
        interrupt
            .register()
            .map_err(|error| AppError::Internal(format!("signal handlers: {error}")))?;
        Ok(interrupt)
    }

    /// Handlers of one signal run in this order: the first only acts on what an earlier signal
    /// has set.
    fn register(&self) -> std::io::Result<()> {
        for (signal, code) in SIGNALS {
            flag::register_conditional_shutdown(signal, code.into(), self.at_once.clone())?;
            flag::register_usize(signal, self.exit_code.clone(), code.into())?;
            flag::register(signal, self.at_once.clone())?;
        }
        Ok(())
    }

    /// Until the result is dropped, the first signal is only remembered.
    pub fn defer(&self) -> Deferred<'_> {
        self.at_once.store(false, Ordering::SeqCst);
        Deferred(self)
    }

    /// To be called between two steps.
    ///
    /// # Errors
    /// [`AppError::Interrupted`] when a signal has asked for the end.
    pub fn check(&self) -> Result<(), AppError> {
        match u8::try_from(self.exit_code.load(Ordering::SeqCst)) {
            Ok(0) => Ok(()),
            Ok(exit_code) => Err(AppError::Interrupted { exit_code }),
            Err(_) => Err(AppError::Internal("unknown signal".into())),
        }
    }
}

/// Signals wait until this is dropped.
pub struct Deferred<'a>(&'a Interrupt);

impl Drop for Deferred<'_> {
    fn drop(&mut self) {
        self.0.at_once.store(true, Ordering::SeqCst);
    }
}
