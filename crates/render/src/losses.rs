//! Recovery from device loss.

use super::{
    Fetch, RenderError, Renderer, Stats,
    device::{self, Device},
    task::Task,
};
use crate::gpu::GpuError;

impl Renderer {
    /// Retries `attempt` on a new device after a loss; see [`Self::survives_losses`].
    pub(super) fn surviving_losses<T>(
        &mut self,
        mut attempt: impl FnMut(&mut Self) -> Result<T, GpuError>,
    ) -> Result<T, RenderError> {
        loop {
            match attempt(self) {
                Ok(done) => return Ok(done),
                Err(error) => self.recover_from(error)?,
            }
        }
    }

    /// Continues on another device after a loss that it survives. Any other error is returned.
    pub(super) fn recover_from(&mut self, error: GpuError) -> Result<(), RenderError> {
        match error {
            GpuError::Lost if self.survives_losses() => self.recover(),
            error => Err(error.into()),
        }
    }

    /// Whether a loss can be recovered from: the host has the sums of all finished slices, and the device
    /// can be replaced. Otherwise the caller gets the error.
    fn survives_losses(&self) -> bool {
        self.policy.host_copy && self.device.gpu.can_be_replaced()
    }

    /// Continues on another device after a loss.
    fn recover(&mut self) -> Result<(), RenderError> {
        self.stats.count_loss(self.earlier_losses)?;
        self.replace_device(self.device.fetch)
    }

    /// Continues on a device whose limits meet the needs of the view.
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

/// The device, or a replacement if it was lost during creation; the replacement may be lost in turn.
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
