//! Leases: which process renders a part. A lease is a file that only one process can create; it is renewed while the
//! process lives, and expires if it is not, after a time that it names. No locks are needed, so it works on network file
//! systems.
//!
//! Whoever finds that lease N has expired creates lease N + 1, which again only one process can do. Leases save work; they
//! are not needed for correct results: two processes that render a part write the same bytes, each at once.

use glimray_io::output::RemoveOnExit;
use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, File, OpenOptions};
use std::io::{self, ErrorKind, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Sender, channel};
use std::thread::JoinHandle;
use std::time::Duration;

/// Time after which a lease expires that is not renewed and does not say another one.
pub const LASTS: Duration = Duration::from_secs(60);

/// Longest time of a lease in seconds.
const MOST_SECONDS: f64 = 86400.0;

/// Attempts of taking a lease while others come and go.
const ATTEMPTS: usize = 8;

/// Renewals of a lease before it would expire.
const RENEWALS: f64 = 4.0;

/// A part that this process renders, until it is dropped.
pub struct Lease {
    path: PathBuf,
    stop: Sender<()>,
    renewal: Option<JoinHandle<()>>,
    _remove_on_exit: RemoveOnExit,
}

/// The outcome of trying to take a lease.
pub enum Claim {
    Taken(Lease),
    /// Another process has it, as `HOST, process PID`.
    Held(String),
}

/// The leases of a farm.
#[derive(Clone, Debug)]
pub struct Leases {
    folder: PathBuf,
    /// Time after which the leases of this process expire if they are not renewed.
    duration: Duration,
}

impl Leases {
    pub fn new(folder: PathBuf, duration: Duration) -> Self {
        Self { folder, duration }
    }

    /// Takes the lease of a part, whose number is `part`, unless another process has it.
    ///
    /// # Errors
    /// The folder cannot be read or written.
    pub fn claim(&self, part: &str) -> io::Result<Claim> {
        let mut holder = String::new();
        for _ in 0..ATTEMPTS {
            let current = self.current(part)?;
            let next = match current {
                None => 0,
                Some(number) => match self.held_by(part, number)? {
                    None => number + 1,
                    Some(found) => return Ok(Claim::Held(found)),
                },
            };
            let path = self.path(part, next);
            let create = || OpenOptions::new().write(true).create_new(true).open(&path);
            match RemoveOnExit::make(create, |_| path.clone()) {
                Ok((file, registered)) => {
                    return Lease::begin(file, path.clone(), registered, self.duration).map(
                        |lease| {
                            (0..next).for_each(|old| {
                                let _ = fs::remove_file(self.path(part, old));
                            });
                            Claim::Taken(lease)
                        },
                    );
                }
                Err(error) if error.kind() == ErrorKind::AlreadyExists => {
                    holder = "another process".into();
                }
                Err(error) => return Err(error),
            }
        }
        Ok(Claim::Held(holder))
    }

    /// The parts that processes render.
    pub fn held(&self) -> io::Result<BTreeSet<String>> {
        let mut current: BTreeMap<String, u32> = BTreeMap::new();
        for (part, number) in self.list()? {
            let highest = current.entry(part).or_default();
            *highest = number.max(*highest);
        }
        let mut held = BTreeSet::new();
        for (part, number) in current {
            if self.held_by(&part, number)?.is_some() {
                held.insert(part);
            }
        }
        Ok(held)
    }

    /// The highest number among the leases of a part.
    fn current(&self, part: &str) -> io::Result<Option<u32>> {
        let leases = self.list()?.into_iter();
        let own = leases.filter(|(owner, _)| owner == part);
        Ok(own.map(|(_, number)| number).max())
    }

    /// All leases, expired or not: their parts and numbers.
    fn list(&self) -> io::Result<Vec<(String, u32)>> {
        let mut leases = Vec::new();
        for entry in fs::read_dir(&self.folder)? {
            let name = entry?.file_name();
            let parts = name.to_str().and_then(|name| name.split_once('.'));
            if let Some((part, Ok(number))) = parts.map(|(part, number)| (part, number.parse())) {
                leases.push((part.to_owned(), number));
            }
        }
        Ok(leases)
    }

    /// Who holds a lease; `None` if it has expired or is gone.
    fn held_by(&self, part: &str, number: u32) -> io::Result<Option<String>> {
        // Opening a file makes a network file system look up its time again.
        let mut file = match File::open(self.path(part, number)) {
            Ok(file) => file,
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(error),
        };
        let renewed = file.metadata()?.modified()?;
        let mut text = String::new();
        // A new file is empty for a moment.
        let _ = (&mut file).take(1024).read_to_string(&mut text);
        let mut words = text.split_whitespace();
        let mut word = || words.next().unwrap_or_default();
        let (host, process, seconds, space) = (word(), word(), word(), word());
        if space == process_space() && is_dead(host, process) {
            return Ok(None);
        }
        // The clock of the file system, which all machines see alike.
        let now = tempfile::Builder::new()
            .prefix(".now-")
            .tempfile_in(&self.folder)
            .and_then(|mut file| {
                file.write_all(b"now")?;
                file.as_file().metadata()?.modified()
            })?;
        // A time in the future, from a clock that was wrong, must not hold the part for ever either.
        let age = now.duration_since(renewed);
        let age = age.unwrap_or_else(|future| future.duration());
        let holder = match host {
            "" => "another process".into(),
            host => format!("{host}, process {process}"),
        };
        Ok((age <= lasting(seconds)).then_some(holder))
    }

    fn path(&self, part: &str, number: u32) -> PathBuf {
        self.folder.join(format!("{part}.{number}"))
    }
}

impl Lease {
    fn begin(
        mut file: File,
        path: PathBuf,
        registered: RemoveOnExit,
        duration: Duration,
    ) -> io::Result<Self> {
        let seconds = duration.as_secs_f64();
        let (process, space) = (std::process::id(), process_space());
        let text = format!("{} {process} {seconds} {space}\n", host());
        file.write_all(text.as_bytes())?;
        drop(file);
        let (stop, stopped) = channel();
        let own = path.clone();
        let renewal = std::thread::Builder::new()
            .name("lease".into())
            .spawn(move || {
                while stopped
                    .recv_timeout(duration.div_f64(RENEWALS))
                    .is_err_and(is_timeout)
                {
                    // Not created again: whoever took it over may have removed it.
                    let renewed = OpenOptions::new().write(true).truncate(true).open(&own);
                    let _ = renewed.and_then(|mut file| file.write_all(text.as_bytes()));
                }
            })?;
        Ok(Self {
            path,
            stop,
            renewal: Some(renewal),
            _remove_on_exit: registered,
        })
    }
}

impl Drop for Lease {
    fn drop(&mut self) {
        let _ = self.stop.send(());
        if let Some(renewal) = self.renewal.take() {
            let _ = renewal.join();
        }
        let _ = fs::remove_file(&self.path);
    }
}

fn is_timeout(error: std::sync::mpsc::RecvTimeoutError) -> bool {
    error == std::sync::mpsc::RecvTimeoutError::Timeout
}

/// Lease duration in seconds; the default while the file is still empty.
fn lasting(seconds: &str) -> Duration {
    let seconds: f64 = seconds.parse().unwrap_or_default();
    match (1.0..=MOST_SECONDS).contains(&seconds) {
        true => Duration::from_secs_f64(seconds),
        false => LASTS,
    }
}

/// Whether a process of this machine has ended. Those of other machines cannot be seen.
fn is_dead(host: &str, process: &str) -> bool {
    let processes = Path::new("/proc");
    let is_number = process.parse::<u32>().is_ok();
    host == self::host()
        && is_number
        && processes.join("self").exists()
        && !processes.join(process).exists()
}

/// The name of what numbers this process, where several containers of a machine number their own; empty if unknown.
fn process_space() -> String {
    let link = fs::read_link("/proc/self/ns/pid").unwrap_or_default();
    link.to_string_lossy().replace(char::is_whitespace, "_")
}

/// The name of this machine, without spaces.
pub fn host() -> String {
    let name = fs::read_to_string("/proc/sys/kernel/hostname")
        .ok()
        .or_else(|| std::env::var("HOSTNAME").ok())
        .or_else(|| std::env::var("COMPUTERNAME").ok())
        .unwrap_or_default();
    match name.trim() {
        "" => "unknown".into(),
        name => name.replace(char::is_whitespace, "_"),
    }
}
