//! Keeps threads from submitting work while another one configures the surface of a window. wgpu waits until the queue is empty
//! and then fails if it is not, so on slow devices a thread that goes on submitting makes it fail.

use std::sync::{Condvar, Mutex, PoisonError};
use std::thread::{self, ThreadId};
use std::time::Duration;

/// The longest that a submission waits. A holder that is stuck does not stop the work for good.
const LONGEST: Duration = Duration::from_secs(60);

/// The gate that all submissions of a device pass.
#[derive(Default)]
pub struct Gate {
    /// The thread that holds the gate; its own submissions pass.
    holder: Mutex<Option<ThreadId>>,
    released: Condvar,
}

impl Gate {
    /// Lets only the current thread submit. A submission that has begun is over when this returns.
    pub fn hold(&self) {
        let mut holder = self.holder.lock().unwrap_or_else(PoisonError::into_inner);
        *holder = Some(thread::current().id());
    }

    /// Lets all threads submit.
    pub fn release(&self) {
        let mut holder = self.holder.lock().unwrap_or_else(PoisonError::into_inner);
        if holder.take().is_some() {
            self.released.notify_all();
        }
    }

    /// Submits once the gate is open for the current thread.
    pub fn pass<T>(&self, submit: impl FnOnce() -> T) -> T {
        let own = thread::current().id();
        let holder = self.holder.lock().unwrap_or_else(PoisonError::into_inner);
        let is_held = |holder: &mut Option<ThreadId>| holder.is_some_and(|other| other != own);
        let waited = (self.released).wait_timeout_while(holder, LONGEST, is_held);
        let _holder = waited.unwrap_or_else(PoisonError::into_inner);
        submit()
    }
}

#[cfg(test)]
mod tests {
    use super::Gate;
    use std::sync::atomic::{AtomicBool, Ordering};
    use std::sync::mpsc::channel;
    use std::thread;

    #[test]
    fn only_the_holder_passes_until_it_lets_go() {
        let (gate, has_passed) = (Gate::default(), AtomicBool::new(false));
        let (sender, receiver) = channel();
        thread::scope(|scope| {
            gate.hold();
            scope.spawn(|| {
                sender.send(()).expect("a receiver");
                gate.pass(|| has_passed.store(true, Ordering::SeqCst));
            });
            receiver.recv().expect("a thread");
            for _ in 0..10_000 {
                gate.pass(|| assert!(!has_passed.load(Ordering::SeqCst)));
                thread::yield_now();
            }
            gate.release();
        });
        assert!(has_passed.into_inner());
    }
}
