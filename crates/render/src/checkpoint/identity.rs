//! Identifies the job of a checkpoint; a different job cannot resume from it.

use super::{CheckpointError, ReadError, Reader, Renderer, Writer};
use crate::Fingerprint;
use std::io::{self, Read, Write};

/// Everything that the bits of the sums and their order in the file depend on.
pub struct Identity {
    /// The version of the program.
    program: String,
    /// The adapter, its backend and its driver: others may round differently.
    adapter: String,
    scene: Fingerprint,
    view: Fingerprint,
    /// The settings of the whole picture.
    settings: Fingerprint,
    /// x, y, width and height of the part to render.
    region: [u32; 4],
    /// The first sample to render, and the one after the last.
    samples: [u32; 2],
    /// Maximum side of film tiles.
    tile_side: u32,
}

impl Identity {
    pub fn of(renderer: &Renderer) -> Self {
        let adapter = renderer.adapter();
        let samples = renderer.settings.samples_to_render();
        Self {
            program: env!("CARGO_PKG_VERSION").into(),
            adapter: format!("{} [{}, {}]", adapter.name, adapter.backend, adapter.driver),
            scene: Fingerprint::of_scene(&renderer.scene),
            view: Fingerprint::of_view(&renderer.view),
            settings: renderer.settings.of_whole().fingerprint(),
            region: renderer.settings.region(),
            samples: [samples.start, samples.end],
            tile_side: renderer.policy.slicing.tile_side,
        }
    }

    /// Rejects the checkpoint of other work.
    pub fn check_same(&self, found: &Self) -> Result<(), CheckpointError> {
        let is_same = [
            ("version of the program", self.program == found.program),
            ("adapter", self.adapter == found.adapter),
            ("scene", self.scene == found.scene),
            ("view", self.view == found.view),
            ("settings", self.settings == found.settings),
            ("region", self.region == found.region),
            ("range of samples", self.samples == found.samples),
            ("size of film tiles", self.tile_side == found.tile_side),
        ];
        let differing = is_same.iter().filter(|(_, is_same)| !is_same);
        let differing: Vec<_> = differing.map(|(what, _)| *what).collect();
        match differing.is_empty() {
            true => Ok(()),
            false => Err(CheckpointError::Differs { differing }),
        }
    }

    pub fn write<W: Write>(&self, out: &mut Writer<W>) -> io::Result<()> {
        out.text(&self.program)?;
        out.text(&self.adapter)?;
        for Fingerprint(fingerprint) in [self.scene, self.view, self.settings] {
            out.bytes(&fingerprint.to_le_bytes())?;
        }
        let numbers = self.region.iter().chain(&self.samples);
        for number in numbers.chain([&self.tile_side]) {
            out.number(*number)?;
        }
        Ok(())
    }

    pub fn read<R: Read>(input: &mut Reader<R>) -> Result<Self, ReadError> {
        let (program, adapter) = (input.text()?, input.text()?);
        let mut fingerprint =
            || Ok::<_, ReadError>(Fingerprint(u128::from_le_bytes(input.array()?)));
        let [scene, view, settings] = [fingerprint()?, fingerprint()?, fingerprint()?];
        let mut numbers = [0; 7];
        for number in &mut numbers {
            *number = input.number()?;
        }
        let [x, y, width, height, start, end, tile_side] = numbers;
        Ok(Self {
            program,
            adapter,
            scene,
            view,
            settings,
            region: [x, y, width, height],
            samples: [start, end],
            tile_side,
        })
    }
}
