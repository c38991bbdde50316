//! Where kernels read the scene from: as the environment says, otherwise as was measured on this adapter before, otherwise
//! as a measurement says if the work is worth it, otherwise by the kind of the adapter. Measurements are kept in
//! `adapters.toml` in the cache folder ([`folders::cache`]).
//! That file only saves time: whatever is wrong with it or its folder is ignored.

use super::{error::AppError, folders};
use crate::clock::Instant;
use crate::gpu::Gpu;
use crate::output;
use crate::render::{ExecutionPolicy, Storage, StorageTimes};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::{env, fs};

/// The environment variable that chooses: `image`, `buffer`, `off` for the adapter's kind, or `auto`, the default.
pub const VARIABLE: &str = "GLIMRAY_FETCH";

/// The name of the file.
const FILE: &str = "adapters.toml";

/// Its first line.
const HEADER: &str =
    "# How glimray reads scenes on each adapter, as measured. This file may be deleted.\n\n";

/// Files longer than this are replaced.
const MAX_BYTES: u64 = 1 << 18;

/// Maximum number of adapters, drivers and versions in the file; the oldest is dropped.
const MAX_ENTRIES: usize = 50;

/// The number of rays from which on a measurement costs a small part of the time that they take, on software adapters and
/// on others.
const MIN_RAYS_ON_CPU: u64 = 200_000_000;
const MIN_RAYS: u64 = 4_000_000_000;

/// Why a storage was chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Reason {
    /// It is usual for adapters of this kind.
    DeviceType,
    /// The environment variable says so.
    Environment,
    /// It was measured before.
    Cache,
    /// It was measured just now.
    Measurement,
    /// The choice was the other one, for which the scene is too large on this adapter.
    Limits,
}

impl Reason {
    /// For people, after the storage.
    pub fn phrase(self) -> &'static str {
        match self {
            Self::DeviceType => "as usual on such adapters",
            Self::Environment => "as GLIMRAY_FETCH says",
            Self::Cache => "as measured before",
            Self::Measurement => "as measured now",
            Self::Limits => "as it is too large for the others",
        }
    }
}

/// A choice, and how it was made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tuning {
    /// The choice.
    pub storage: Storage,
    /// Why.
    pub reason: Reason,
    /// Seconds that measuring took in this run.
    pub seconds: f64,
    /// What was measured, now or before.
    pub times: Option<StorageTimes>,
}

impl Tuning {
    /// Why a renderer for which this was the choice reads from `storage`.
    pub fn reason_for(&self, storage: Storage) -> Reason {
        match storage == self.storage {
            true => self.reason,
            false => Reason::Limits,
        }
    }

    /// A sentence for people if the environment asked for another storage than a renderer reads from.
    pub fn refusal(&self, storage: Storage) -> Option<String> {
        let is_refused = self.reason == Reason::Environment && storage != self.storage;
        let (used, wished) = (name(storage), name(self.storage));
        is_refused.then(|| {
            format!(
                "the scene is read from {used}s, not from {wished}s as {VARIABLE} says: it is too large for the \
                 {wished}s of this adapter. `glimray doctor` prints its limits."
            )
        })
    }
}

/// The name of a storage in reports.
pub fn name(storage: Storage) -> &'static str {
    match storage {
        Storage::Image => "image",
        Storage::Buffer => "buffer",
    }
}

/// What the environment says.
#[derive(Clone, Copy)]
enum Wish {
    Auto,
    Off,
    Storage(Storage),
}

/// Checks the environment variable.
///
/// # Errors
/// It has an unknown value.
pub fn check() -> Result<(), AppError> {
    wish().map(drop)
}

/// The choice for an adapter without measuring.
///
/// # Errors
/// The environment variable has an unknown value.
pub fn known(gpu: &Gpu) -> Result<Tuning, AppError> {
    Ok(known_by(wish()?, gpu))
}

fn known_by(wish: Wish, gpu: &Gpu) -> Tuning {
    let usual = Tuning {
        storage: Storage::usual(gpu),
        reason: Reason::DeviceType,
        seconds: 0.0,
        times: None,
    };
    let entry = match wish {
        Wish::Auto => file().and_then(|file| Entry::find(&file, gpu)),
        Wish::Off | Wish::Storage(_) => None,
    };
    match (wish, entry) {
        (Wish::Storage(storage), _) => Tuning {
            storage,
            reason: Reason::Environment,
            ..usual
        },
        (_, Some(entry)) => Tuning {
            storage: entry.storage.into(),
            reason: Reason::Cache,
            times: Some(entry.times()),
            ..usual
        },
        _ => usual,
    }
}

/// The policy with the choice for an adapter, without measuring.
///
/// # Errors
/// As [`known`].
pub fn with_known(gpu: &Gpu, policy: ExecutionPolicy) -> Result<ExecutionPolicy, AppError> {
    Ok(ExecutionPolicy {
        storage: Some(known(gpu)?.storage),
        ..policy
    })
}

/// The choice for an adapter that is to trace about this many `rays`. It may be measured first.
///
/// # Errors
/// As [`known`]. If measuring fails or takes too long, the kind of the adapter decides.
pub fn tuned(gpu: &Gpu, rays: u64) -> Result<Tuning, AppError> {
    let wish = wish()?;
    let known = known_by(wish, gpu);
    let least = match gpu.is_cpu() {
        true => MIN_RAYS_ON_CPU,
        false => MIN_RAYS,
    };
    let may_measure = known.reason == Reason::DeviceType && matches!(wish, Wish::Auto);
    if !may_measure || rays < least {
        return Ok(known);
    }
    let started = Instant::now();
    let measured = StorageTimes::measure(gpu);
    let seconds = started.elapsed().as_secs_f64();
    let Ok(Some(times)) = measured else {
        return Ok(Tuning { seconds, ..known });
    };
    let storage = times.faster(known.storage);
    if let Some(file) = file() {
        Entry::new(gpu, storage, times).keep(&file);
    }
    Ok(Tuning {
        storage,
        reason: Reason::Measurement,
        seconds,
        times: Some(times),
    })
}

fn wish() -> Result<Wish, AppError> {
    let value = env::var_os(VARIABLE).unwrap_or_default();
    match value.to_str() {
        Some("" | "auto") => Ok(Wish::Auto),
        Some("off") => Ok(Wish::Off),
        Some("image") => Ok(Wish::Storage(Storage::Image)),
        Some("buffer") => Ok(Wish::Storage(Storage::Buffer)),
        _ => Err(AppError::Usage(format!(
            "cannot choose how kernels read the scene ({VARIABLE}={}): there is no such choice. Set it to image, buffer, \
             auto or off.",
            value.to_string_lossy()
        ))),
    }
}

/// The file of measurements; `None` if the platform has no cache folder.
fn file() -> Option<PathBuf> {
    Some(folders::cache()?.join(FILE))
}

/// The contents of the file.
#[derive(Default, Serialize, Deserialize)]
struct Entries {
    /// The latest last.
    #[serde(default)]
    adapters: Vec<Entry>,
}

/// A choice in the file.
#[derive(Serialize, Deserialize)]
struct Entry {
    #[serde(flatten)]
    key: Key,
    storage: Name,
    image_seconds: f64,
    buffer_seconds: f64,
}

/// What a choice is valid for.
#[derive(PartialEq, Serialize, Deserialize)]
struct Key {
    name: String,
    backend: String,
    /// With its version.
    driver: String,
    /// Version of the program.
    glimray: String,
}

/// A storage by its name.
#[derive(Clone, Copy, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Name {
    Image,
    Buffer,
}

impl From<Name> for Storage {
    fn from(name: Name) -> Self {
        match name {
            Name::Image => Self::Image,
            Name::Buffer => Self::Buffer,
        }
    }
}

impl From<Storage> for Name {
    fn from(storage: Storage) -> Self {
        match storage {
            Storage::Image => Self::Image,
            Storage::Buffer => Self::Buffer,
        }
    }
}

impl Key {
    fn of(gpu: &Gpu) -> Self {
        let adapter = gpu.adapter();
        Self {
            name: adapter.name.clone(),
            backend: adapter.backend.clone(),
            driver: adapter.driver.clone(),
            glimray: env!("CARGO_PKG_VERSION").into(),
        }
    }
}

impl Entry {
    fn new(gpu: &Gpu, storage: Storage, times: StorageTimes) -> Self {
        Self {
            key: Key::of(gpu),
            storage: storage.into(),
            image_seconds: times.image,
            buffer_seconds: times.buffer,
        }
    }

    /// The entry of an adapter in a file.
    fn find(file: &Path, gpu: &Gpu) -> Option<Self> {
        let key = Key::of(gpu);
        let mut entries = Entries::read(file).adapters.into_iter();
        entries.find(|entry| entry.key == key)
    }

    fn times(&self) -> StorageTimes {
        StorageTimes {
            image: self.image_seconds,
            buffer: self.buffer_seconds,
        }
    }

    /// Adds it to a file. If several processes do that at a time, the last one's stays.
    fn keep(self, file: &Path) {
        let mut entries = Entries::read(file);
        entries.adapters.retain(|entry| entry.key != self.key);
        entries.adapters.push(self);
        let too_many = entries.adapters.len().saturating_sub(MAX_ENTRIES);
        entries.adapters.drain(..too_many);
        let is_other = fs::metadata(file).is_ok_and(|found| !found.is_file());
        if let (Ok(text), false) = (toml::to_string(&entries), is_other) {
            let _ = file.parent().map(fs::create_dir_all);
            let _ = output::write(file, (HEADER.to_owned() + &text).as_bytes(), true);
        }
    }
}

impl Entries {
    /// The entries of a file; none if it cannot be used.
    fn read(file: &Path) -> Self {
        // A pipe would not end.
        let is_usable =
            fs::metadata(file).is_ok_and(|found| found.is_file() && found.len() <= MAX_BYTES);
        let text = is_usable.then(|| fs::read_to_string(file).ok()).flatten();
        text.and_then(|text| toml::from_str(&text).ok())
            .unwrap_or_default()
    }
}
