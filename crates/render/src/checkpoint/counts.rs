//! The counts of the statistics, which go on with the picture. Times are those of a run.

use super::{ReadError, Reader, Writer, damaged};
use crate::{Rays, Stats};
use std::io::{self, Read, Write};

/// The counts of a picture so far.
pub struct Counts {
    nonfinite_samples: u64,
    cut_off_trees: u64,
    samples: u64,
    cut_throughput: f64,
    clamped_light: f64,
    kept_light: f64,
    rays: Option<Rays>,
}

impl Counts {
    pub fn of(stats: &Stats) -> Self {
        Self {
            nonfinite_samples: stats.nonfinite_samples,
            cut_off_trees: stats.cut_off_trees,
            samples: stats.samples,
            cut_throughput: stats.cut_throughput,
            clamped_light: stats.clamped_light,
            kept_light: stats.kept_light,
            rays: stats.rays,
        }
    }

    /// Replaces the counts of `stats`. Without `counts_rays` the rays are unknown from now on.
    pub fn put(self, stats: &mut Stats, counts_rays: bool) {
        stats.nonfinite_samples = self.nonfinite_samples;
        stats.cut_off_trees = self.cut_off_trees;
        stats.samples = self.samples;
        stats.cut_throughput = self.cut_throughput;
        stats.clamped_light = self.clamped_light;
        stats.kept_light = self.kept_light;
        stats.rays = self.rays.filter(|_| counts_rays);
    }

    pub fn write<W: Write>(&self, out: &mut Writer<W>) -> io::Result<()> {
        let whole = [self.nonfinite_samples, self.cut_off_trees, self.samples];
        out.words(&whole, u64::to_le_bytes)?;
        let light = [self.cut_throughput, self.clamped_light, self.kept_light];
        out.words(&light, f64::to_le_bytes)?;
        out.number(self.rays.is_some().into())?;
        let Some(rays) = &self.rays else {
            return Ok(());
        };
        let rays = [
            rays.primary,
            rays.primary_hits,
            rays.shadow,
            rays.shadow_blocked,
            rays.reflection,
            rays.reflection_hits,
            rays.refraction,
            rays.refraction_hits,
        ];
        out.words(&rays, u64::to_le_bytes)
    }

    pub fn read<R: Read>(input: &mut Reader<R>) -> Result<Self, ReadError> {
        fn whole<R: Read>(input: &mut Reader<R>) -> Result<u64, ReadError> {
            let number = u64::from_le_bytes(input.array()?);
            // Far more than can be counted; sums of smaller numbers do not overflow.
            match number < 1 << 62 {
                true => Ok(number),
                false => Err(damaged("its counts are too large")),
            }
        }
        fn light<R: Read>(input: &mut Reader<R>) -> Result<f64, ReadError> {
            let number = f64::from_le_bytes(input.array()?);
            match number.is_finite() {
                true => Ok(number),
                false => Err(damaged("its light is not finite")),
            }
        }
        Ok(Self {
            nonfinite_samples: whole(input)?,
            cut_off_trees: whole(input)?,
            samples: whole(input)?,
            cut_throughput: light(input)?,
            clamped_light: light(input)?,
            kept_light: light(input)?,
            rays: match input.number()? {
                0 => None,
                _ => Some(Rays {
                    primary: whole(input)?,
                    primary_hits: whole(input)?,
                    shadow: whole(input)?,
                    shadow_blocked: whole(input)?,
                    reflection: whole(input)?,
                    reflection_hits: whole(input)?,
                    refraction: whole(input)?,
                    refraction_hits: whole(input)?,
                }),
            },
        })
    }
}
