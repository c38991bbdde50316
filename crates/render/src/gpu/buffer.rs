//! Allocation with a memory budget: some drivers never report that memory has run out, so the planned total is
//! checked against a limit before anything is allocated.

use super::{Gpu, GpuError, fault};
use glimray_scene::bytes::size;

/// The default memory limit, in bytes.
pub const MEMORY_LIMIT_BYTES: u64 = 4 << 30;

/// The planned allocations, by name.
#[derive(Clone, Debug, Default)]
pub struct Ledger {
    entries: Vec<(&'static str, u64)>,
}

impl Ledger {
    /// Adds `bytes` for `what`.
    pub fn plan(&mut self, what: &'static str, bytes: u64) {
        self.entries.push((what, bytes));
    }

    /// The planned total, in bytes.
    pub fn total(&self) -> u64 {
        self.entries.iter().map(|(_, bytes)| bytes).sum()
    }

    /// Rejects a total above `limit` bytes, naming the largest entry.
    ///
    /// # Errors
    /// [`GpuError::Budget`] if the total is above the limit.
    pub fn check(&self, limit: u64) -> Result<(), GpuError> {
        let need = self.total();
        if need <= limit {
            return Ok(());
        }
        let largest = self.entries.iter().max_by_key(|(_, bytes)| *bytes);
        let what = largest.map_or(String::new(), |(what, bytes)| {
            format!("{what} {}", size(*bytes))
        });
        Err(GpuError::Budget { what, need, limit })
    }
}

/// Bytes that are written at a time: each is copied before the device gets it.
const STAGED: usize = 16 << 20;

impl Gpu {
    /// A buffer of at least 16 bytes, its contents undefined or zero.
    pub(crate) fn allocate(
        &self,
        what: &'static str,
        bytes: u64,
        usage: wgpu::BufferUsages,
    ) -> Result<wgpu::Buffer, GpuError> {
        if fault::should_fail(fault::Site::Allocation) {
            return Err(GpuError::OutOfMemory { what: what.into() });
        }
        self.scoped(what, || {
            self.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(what),
                size: bytes.max(16).next_multiple_of(4),
                usage,
                mapped_at_creation: false,
            })
        })
    }

    /// A storage buffer with `contents`; if they are empty, shaders read zeros.
    pub(crate) fn upload(
        &self,
        what: &'static str,
        contents: &[u8],
    ) -> Result<wgpu::Buffer, GpuError> {
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST;
        // WebGPU requires a binding to hold at least one element; 256 bytes hold any of our structs.
        let buffer = self.allocate(what, (contents.len() as u64).max(256), usage)?;
        self.write(&buffer, 0, contents)?;
        Ok(buffer)
    }

    /// Writes to a buffer in chunks, each submitted, so that the staging copies of earlier ones are freed.
    pub(crate) fn write(
        &self,
        buffer: &wgpu::Buffer,
        offset: u64,
        contents: &[u8],
    ) -> Result<(), GpuError> {
        self.scoped("write", || {
            for (i, part) in contents.chunks(STAGED).enumerate() {
                self.queue
                    .write_buffer(buffer, offset + (i * STAGED) as u64, part);
                if part.len() == STAGED {
                    self.gate.pass(|| self.queue.submit([]));
                }
            }
        })
    }

    /// A read-only image with rows of `width` texels and room for `bytes`, zero-initialised; with `layer_rows` one of
    /// layers of so many rows, or fewer if there is only one. `binding` is the usage in shaders.
    pub(crate) fn allocate_image(
        &self,
        what: &'static str,
        bytes: u64,
        (width, layer_rows): (u32, Option<u32>),
        (format, binding): (wgpu::TextureFormat, wgpu::TextureUsages),
    ) -> Result<wgpu::TextureView, GpuError> {
        if fault::should_fail(fault::Site::Allocation) {
            return Err(GpuError::OutOfMemory { what: what.into() });
        }
        let dimension = match layer_rows {
            None => wgpu::TextureViewDimension::D2,
            Some(_) => wgpu::TextureViewDimension::D2Array,
        };
        let rows = bytes.div_ceil(row_bytes(width, format)).max(1) as u32;
        let height = layer_rows.map_or(rows, |most| rows.min(most));
        // wgpu's GL backend takes a texture with one layer for one that is no array.
        let is_gl = self.adapter().backend == "gl";
        let least = if layer_rows.is_some() && is_gl { 2 } else { 1 };
        let size = wgpu::Extent3d {
            width,
            height,
            depth_or_array_layers: rows.div_ceil(height).max(least),
        };
        let texture = self.scoped(what, || {
            self.device.create_texture(&wgpu::TextureDescriptor {
                label: Some(what),
                size,
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: binding | wgpu::TextureUsages::COPY_DST,
                view_formats: &[],
            })
        })?;
        Ok(texture.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(dimension),
            ..Default::default()
        }))
    }

    /// A texture that shaders write and sample, zero-initialised. A side beyond the limit of the adapter is an error.
    pub(crate) fn allocate_screen(
        &self,
        width: u32,
        height: u32,
        format: wgpu::TextureFormat,
    ) -> Result<wgpu::TextureView, GpuError> {
        let limit = self.device.limits().max_texture_dimension_2d;
        let side = width.max(height);
        if side > limit {
            return Err(GpuError::Limit {
                name: "width or height of a picture in pixels",
                need: side.into(),
                limit: limit.into(),
                in_bytes: false,
            });
        }
        if fault::should_fail(fault::Site::Allocation) {
            return Err(GpuError::OutOfMemory {
                what: "screen".into(),
            });
        }
        let texture = self.scoped("screen", || {
            self.device.create_texture(&wgpu::TextureDescriptor {
                label: Some("screen"),
                size: extent(width, height),
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: wgpu::TextureUsages::STORAGE_BINDING
                    | wgpu::TextureUsages::TEXTURE_BINDING
                    | wgpu::TextureUsages::COPY_SRC
                    | wgpu::TextureUsages::COPY_DST,
                view_formats: &[],
            })
        })?;
        Ok(texture.create_view(&Default::default()))
    }

    /// Writes whole texels of an image, row by row, starting at texel index `first`.
    pub(crate) fn write_image(
        &self,
        image: &wgpu::TextureView,
        first: u64,
        contents: &[u8],
    ) -> Result<(), GpuError> {
        let mut staged = 0;
        let texture = image.texture();
        let (width, height) = (texture.width(), texture.height());
        let texel = row_bytes(1, texture.format()) as usize;
        let (mut x, mut y) = (
            (first % u64::from(width)) as u32,
            (first / u64::from(width)) as u32,
        );
        let mut rest = contents;
        self.scoped("write", || {
            while !rest.is_empty() {
                // The rest of a row, then whole rows of a layer, then the start of a row.
                let texels = rest.len() / texel;
                let (columns, rows) = match (x, texels / width as usize) {
                    (0, 0) => (texels as u32, 1),
                    (0, rows) => (
                        width,
                        rows.min((height - y % height) as usize)
                            .min((STAGED / (width as usize * texel)).max(1))
                            as u32,
                    ),
                    _ => (texels.min((width - x) as usize) as u32, 1),
                };
                let target = wgpu::TexelCopyTextureInfo {
                    texture,
                    mip_level: 0,
                    origin: wgpu::Origin3d {
                        x,
                        y: y % height,
                        z: y / height,
                    },
                    aspect: wgpu::TextureAspect::All,
                };
                let layout = wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(columns * texel as u32),
                    rows_per_image: None,
                };
                let (now, later) = rest.split_at((columns * rows) as usize * texel);
                (self.queue).write_texture(target, now, layout, extent(columns, rows));
                staged += now.len();
                if staged >= STAGED / 2 {
                    self.gate.pass(|| self.queue.submit([]));
                    staged = 0;
                }
                (x, y, rest) = (
                    (x + columns) % width,
                    y + (x + columns) / width * rows,
                    later,
                );
            }
        })
    }
}

fn row_bytes(width: u32, format: wgpu::TextureFormat) -> u64 {
    u64::from(format.block_copy_size(None).unwrap_or(16) * width)
}

fn extent(width: u32, height: u32) -> wgpu::Extent3d {
    wgpu::Extent3d {
        width,
        height,
        depth_or_array_layers: 1,
    }
}
