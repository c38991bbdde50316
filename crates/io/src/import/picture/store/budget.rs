//! How much of the pictures of a scene fits into memory, known from the headers of their files before any is decoded.

use super::{Pictures, Planned, Read};
use crate::import::picture::{Announced, Refused};
use glimray_scene::MAX_PICTURE_BYTES;

/// Bytes of files that are kept between the reading of their headers and their decoding. Others are read again.
const KEPT_BYTES: usize = 256 << 20;

/// Most bytes of texels that all files may announce together. What exceeds the memory for pictures is only decoded to be
/// halved.
const MOST_ANNOUNCED: u64 = 4 * MAX_PICTURE_BYTES as u64;

impl Planned {
    /// Bytes of the texels of its pictures, of which no side is longer than `limit`, halved so many times.
    pub(super) fn bytes(&self, limit: u32, halvings: u32) -> u64 {
        let announced = self.announced.unwrap_or_default();
        let longest = announced.width.max(announced.height);
        let for_limit = (0..31).take_while(|times| longest >> times > limit).count() as u32;
        let roles = self.roles.iter();
        roles
            .map(|role| announced.bytes(*role, for_limit + halvings))
            .sum()
    }
}

impl Pictures {
    /// Reads the headers of the pictures that are planned, and finds how many times each is halved so that all fit.
    pub(super) fn plan_sizes(&mut self, read: Read) {
        let mut kept_bytes = 0;
        for planned in self.planned.values_mut() {
            if planned.announced.is_some() {
                continue;
            }
            let file = read(&planned.place, &planned.name);
            let announced = file.as_deref().map_or(Announced::default(), Announced::of);
            planned.announced = Some(announced);
            if self.announced.insert(planned.place.clone()) {
                self.announced_bytes += planned.bytes(u32::MAX, 0);
            }
            planned.is_beyond = self.announced_bytes > MOST_ANNOUNCED;
            planned.file = match file {
                Ok(_) if planned.is_beyond => Some(Err(Refused::too_big(format!(
                    "{} is one picture too many: together they have more than {} GiB of texels",
                    planned.name,
                    MOST_ANNOUNCED >> 30
                )))),
                Ok(file) => {
                    kept_bytes += file.len();
                    (kept_bytes <= KEPT_BYTES).then(|| Ok(file.into_owned()))
                }
                Err(refused) => Some(Err(refused)),
            };
        }
        let limit = self.limit;
        let planned = || self.planned.values();
        let mut bytes = self.bytes as u64
            + planned()
                .map(|it| it.bytes(limit, it.halvings))
                .sum::<u64>();
        while bytes > MAX_PICTURE_BYTES as u64 {
            let sizes = self.planned.values_mut();
            let largest = sizes.max_by_key(|it| it.bytes(limit, it.halvings));
            let Some(largest) = largest else { break };
            let before = largest.bytes(limit, largest.halvings);
            largest.halvings += 1;
            let after = largest.bytes(limit, largest.halvings);
            if after >= before {
                break;
            }
            bytes -= before - after;
        }
    }
}
