//! The bytes of a screen of the GPU.

use eframe::wgpu;
use glimray::gpu::Gpu;
use glimray::render::Screen;

/// Width, height, and 8 bits of red, green and blue for each pixel.
#[derive(Clone, PartialEq)]
pub struct Bytes {
    pub size: (u32, u32),
    pub rgb: Vec<[u8; 3]>,
}

impl Bytes {
    /// Says where two pictures differ.
    #[track_caller]
    pub fn assert_same(&self, other: &Self, what: &str) {
        assert_eq!(self.size, other.size, "{what}: sizes");
        let count = self
            .rgb
            .iter()
            .zip(&other.rgb)
            .filter(|(a, b)| a != b)
            .count();
        assert_eq!(count, 0, "{what}: pixels that differ of {}", self.rgb.len());
    }
}

/// The contents of a screen.
pub fn on(screen: &Screen, gpu: &Gpu) -> Bytes {
    let (_, _, device, queue) = gpu.handles();
    let (width, height) = screen.size();
    let row = (4 * width).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: u64::from(row) * u64::from(height),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let mut encoder = device.create_command_encoder(&Default::default());
    let texture = screen.view().texture();
    encoder.copy_texture_to_buffer(
        texture.as_image_copy(),
        wgpu::TexelCopyBufferInfo {
            buffer: &buffer,
            layout: wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(row),
                rows_per_image: None,
            },
        },
        texture.size(),
    );
    queue.submit([encoder.finish()]);
    buffer.map_async(wgpu::MapMode::Read, .., |outcome| outcome.expect("a map"));
    device
        .poll(wgpu::PollType::wait_indefinitely())
        .expect("the device");
    let bytes = buffer.get_mapped_range(..).expect("mapped");
    let lines = bytes.chunks(row as usize);
    let rgb = lines
        .flat_map(|line| {
            line[..4 * width as usize]
                .chunks(4)
                .map(|p| [p[0], p[1], p[2]])
        })
        .collect();
    Bytes {
        size: (width, height),
        rgb,
    }
}
