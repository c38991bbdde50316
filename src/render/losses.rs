//! Going on after the device was lost.

use super::{
    Fetch, RenderError, Renderer, Stats,
    device::{self, Device},
    task::Task,
};
use crate::gpu::GpuError;

impl Renderer {
    /// Repeats `attempt` on a fresh device when the old one is lost; see [`Self::survives_losses`].
    pub(super) fn surviving_losses<T>(
        &mut self,
        mut attempt: impl FnMut(&mut Self) -> Result<T, GpuError>,
    ) -> Result<T, RenderError> {
        loop {
            match attempt(self) {
                Err(GpuError::Lost) if self.survives_losses() => self.recover()?,
                other => return Ok(other?),
            }
        }
    }

    /// Whether the film on the host holds all finished slices, and the device is ours to replace. Else its
    /// loss is the caller's.
    pub(super) fn survives_losses(&self) -> bool {
        self.policy.host_copy && self.device.gpu.is_own()
    }

    /// Goes on with another device after a loss.
    pub(super) fn recover(&mut self) -> Result<(), RenderError> {
        self.stats.count_loss(self.earlier_losses)?;
        self.replace_device(self.device.fetch)
    }

    /// Goes on with a device whose limits serve the view.
    pub(super) fn replace_device(&mut self, fetch: Fetch) -> Result<(), RenderError> {
        let choice = self.device.gpu.choice().clone();
        let task = Task {
            scene: &self.scene,
            view: &self.view,
            settings: &self.settings,
            policy: &self.policy,
            film_rows: self.tiles.largest(),
        };
        let reopen = |stats: &mut Stats| device::reopen(&choice, fetch, task, stats);
        let device = reopen(&mut self.stats);
        self.device = or_replacement(device, &mut self.stats, self.earlier_losses, reopen)?;
        Ok(())
    }
}

/// The device, or another one if it was lost while it was made; that may be lost in turn.
pub fn or_replacement(
    mut device: Result<Device, GpuError>,
    stats: &mut Stats,
    earlier_losses: u32,
    mut reopen: impl FnMut(&mut Stats) -> Result<Device, GpuError>,
) -> Result<Device, RenderError> {
    while let Err(GpuError::Lost) = device {
        stats.count_loss(earlier_losses)?;
        device = reopen(stats);
    }
    Ok(device?)
}
