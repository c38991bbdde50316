//! Denoises pictures by their features: `kernels/denoise.wesl`.

use super::{
    Features, PixelFeatures, RenderError, develop::check_memory, layouts::group_at,
    luminance::luminance, opacity::straight, pipelines,
};
use crate::{
    gpu::{Gpu, GpuError, Source, Timer},
    image::Image,
    threads,
};
use bytemuck::{bytes_of, cast_slice};
use wgpu::{BufferUsages, TextureFormat};

/// The distances of pixels that the passes after the first average.
const STRIDES: [u32; 5] = [1, 2, 4, 8, 16];
/// The least albedo that a picture is divided by.
const LEAST_ALBEDO: f32 = 0.02;
/// The largest signal; its square is finite.
const MOST: f32 = 1e15;
/// Stands for the variance of a single sample; `MOST_VARIANCE` of the kernel is between it and the square of the largest
/// signal.
const UNKNOWN_VARIANCE: f32 = 1e31;
const SIGNAL: TextureFormat = TextureFormat::Rgba32Float;
const GUIDES: TextureFormat = TextureFormat::Rgba32Uint;
const TEXEL_BYTES: u32 = 16;

/// A denoised picture.
pub struct Denoised {
    /// The picture.
    pub image: Image,
    /// How long the adapter took for the passes, by its timestamps; `None` if it has none.
    pub pass_seconds: Option<f64>,
}

impl Image {
    /// Denoises linear radiance with the features of its pixels, and opacity where these have transparency. Pixels that are not finite are
    /// replaced by what is around them.
    ///
    /// # Errors
    /// The device failed, a side exceeds the adapter's textures, or the features are those of another picture.
    pub fn denoised(&self, gpu: &Gpu, features: &Features) -> Result<Self, RenderError> {
        Ok(self.denoise(gpu, features)?.image)
    }

    /// As [`Self::denoised`], with the time that it took.
    ///
    /// # Errors
    /// As [`Self::denoised`].
    pub fn denoise(&self, gpu: &Gpu, features: &Features) -> Result<Denoised, RenderError> {
        let (width, height) = (self.width, self.height);
        let is_same = features.pixels.len() == self.pixels.len() && features.width == width;
        if !is_same || self.pixels.is_empty() {
            return Ok(Denoised {
                image: self.clone(),
                pass_seconds: None,
            });
        }
        check_memory(width, height)?;
        let limit = gpu.device.limits().max_texture_dimension_2d;
        let side = width.max(height);
        if side > limit {
            return Err(GpuError::Limit {
                name: "width or height of a picture in pixels",
                need: side.into(),
                limit: limit.into(),
            }
            .into());
        }
        let pixels = &features.pixels;
        let signals = threads::collect(pixels.len(), |at| signal(self.pixels[at], &pixels[at]));
        let guides = guides(features);
        let (filtered, mut pass_seconds) = filter(gpu, (width, height), &signals, &guides)?;
        let clear = match pixels.iter().any(|pixel| pixel.transparency > 0.0) {
            true => {
                let signals = threads::collect(pixels.len(), |at| clear(&pixels[at]));
                let (clear, seconds) = filter(gpu, (width, height), &signals, &guides)?;
                pass_seconds = pass_seconds.zip(seconds).map(|(a, b)| a + b);
                Some(clear)
            }
            false => None,
        };
        let color = |at: usize| {
            let albedo = albedo(&pixels[at]);
            let color = [0, 1, 2].map(|channel| filtered[at][channel] * albedo[channel]);
            let opacity = (clear.as_ref()).map_or(self.pixels[at][3], |clear| {
                1.0 - clear[at][0].clamp(0.0, 1.0)
            });
            straight(color, opacity)
        };
        Ok(Denoised {
            image: Self {
                width,
                height,
                pixels: threads::collect(pixels.len(), color),
            },
            pass_seconds,
        })
    }
}

/// The albedo by which a pixel is divided.
fn albedo(features: &PixelFeatures) -> [f32; 3] {
    (features.albedo).map(|channel| match channel.is_nan() {
        true => 1.0,
        false => channel.clamp(LEAST_ALBEDO, 1.0),
    })
}

/// A pixel divided by its albedo, and the variance of its luminance: negative if the pixel is not finite, and unknown
/// if it has a single sample.
fn signal([r, g, b, opacity]: [f32; 4], features: &PixelFeatures) -> [f32; 4] {
    let albedo = albedo(features);
    let [ar, ag, ab] = albedo;
    let luminance = luminance(albedo.map(f64::from)) as f32;
    let variance = features.variance / (luminance * luminance);
    if ![r, g, b, variance].iter().all(|number| number.is_finite()) {
        return [0.0, 0.0, 0.0, -1.0];
    }
    let [r, g, b] = [r * opacity / ar, g * opacity / ag, b * opacity / ab]
        .map(|channel| channel.clamp(0.0, MOST));
    let variance = match features.samples {
        1.0 => UNKNOWN_VARIANCE,
        _ => variance.clamp(0.0, MOST * MOST),
    };
    [r, g, b, variance]
}

/// The transparency of a pixel as a signal. Its variance is that of samples which are either opaque or not: the greatest
/// that the mean allows, where samples of the light on a catcher are alike.
fn clear(features: &PixelFeatures) -> [f32; 4] {
    let clear = features.transparency;
    let variance = clear * (1.0 - clear) / features.samples.max(1.0);
    [clear, clear, clear, variance]
}

/// The guides of all pixels: normal, slope of the depth, albedo, and depth.
fn guides(features: &Features) -> Vec<[u32; 4]> {
    let (width, height) = (features.width as usize, features.height as usize);
    let depth = |x: usize, y: usize| features.pixels[y * width + x].depth;
    // The smaller difference to the neighbours on both sides, so that an edge on one of them does not count.
    let slope = |own: f32, before: Option<f32>, after: Option<f32>| {
        let apart = |other: Option<f32>| other.map_or(f32::INFINITY, |other| (other - own).abs());
        let least = apart(before).min(apart(after));
        if least.is_finite() { least } else { 0.0 }
    };
    let guide = |index: usize| {
        let pixel = &features.pixels[index];
        let (x, y) = (index % width, index / width);
        let left = (x > 0).then(|| depth(x - 1, y));
        let right = (x + 1 < width).then(|| depth(x + 1, y));
        let above = (y > 0).then(|| depth(x, y - 1));
        let below = (y + 1 < height).then(|| depth(x, y + 1));
        let own = pixel.depth;
        let slope = slope(own, left, right).max(slope(own, above, below));
        let [x, y, z] = pixel.normal.map(snorm);
        let [r, g, b] = pixel.albedo.map(unorm);
        [
            x | y << 16,
            // The upper half of an f32.
            z | slope.to_bits() & 0xffff_0000,
            r | g << 8 | b << 16,
            if own.is_finite() { own.to_bits() } else { 0 },
        ]
    };
    threads::collect(features.pixels.len(), guide)
}

fn snorm(number: f32) -> u32 {
    let level = (number.clamp(-1.0, 1.0) * 32767.0).round() as i16;
    u32::from(level as u16)
}

fn unorm(number: f32) -> u32 {
    (number.clamp(0.0, 1.0) * 255.0).round() as u32
}

/// Runs all passes. Returns the filtered signal, and the seconds of the passes if the adapter has timestamps.
fn filter(
    gpu: &Gpu,
    (width, height): (u32, u32),
    signal: &[[f32; 4]],
    guides: &[[u32; 4]],
) -> Result<(Vec<[f32; 4]>, Option<f64>), GpuError> {
    let image = |format| gpu.allocate_screen(width, height, format);
    let mut images = [image(SIGNAL)?, image(SIGNAL)?];
    let guide_image = image(GUIDES)?;
    gpu.write_image(&images[0], 0, cast_slice(signal))?;
    gpu.write_image(&guide_image, 0, cast_slice(guides))?;
    let layout = layout(gpu);
    let timer = gpu.timer()?;
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    for (pass, stride) in [1].into_iter().chain(STRIDES).enumerate() {
        let (is_first, is_last) = (pass == 0, pass == STRIDES.len());
        let pipeline = pipelines::denoising(gpu, &layout, is_first)?;
        let stride = gpu.upload("stride", bytes_of(&stride))?;
        let [from, to] = &images;
        let resources = [
            (3, stride.as_entire_binding()),
            (4, wgpu::BindingResource::TextureView(from)),
            (5, wgpu::BindingResource::TextureView(&guide_image)),
            (6, wgpu::BindingResource::TextureView(to)),
        ];
        let group = group_at(gpu, &layout, &resources);
        let mut work = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some("denoise"),
            timestamp_writes: timer.writes_of(is_first, is_last),
        });
        work.set_pipeline(&pipeline);
        work.set_bind_group(3, &group, &[]);
        work.dispatch_workgroups(width.div_ceil(8), height.div_ceil(8), 1);
        drop(work);
        images.swap(0, 1);
    }
    read(gpu, encoder, &images[0], &timer)
}

/// Submits the work and reads back a signal, and the time that was measured.
fn read(
    gpu: &Gpu,
    mut encoder: wgpu::CommandEncoder,
    image: &wgpu::TextureView,
    timer: &Timer,
) -> Result<(Vec<[f32; 4]>, Option<f64>), GpuError> {
    let texture = image.texture();
    let (width, height) = (texture.width(), texture.height());
    let row = (TEXEL_BYTES * width).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let bytes = u64::from(row) * u64::from(height);
    let texels = gpu.allocate(
        "texels",
        bytes,
        BufferUsages::COPY_DST | BufferUsages::COPY_SRC,
    )?;
    let staging = gpu.allocate(
        "staging",
        bytes + Timer::BYTES as u64,
        BufferUsages::COPY_DST | BufferUsages::MAP_READ,
    )?;
    let target = wgpu::TexelCopyBufferInfo {
        buffer: &texels,
        layout: wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(row),
            rows_per_image: None,
        },
    };
    let size = texture.size();
    encoder.copy_texture_to_buffer(texture.as_image_copy(), target, size);
    let mut sources = Vec::from_iter(timer.resolve(&mut encoder));
    sources.push(Source {
        buffer: &texels,
        offset: 0,
        bytes,
    });
    gpu.submit_and_read(encoder, &sources, &staging, |bytes| {
        let (seconds, rows) = timer.split(bytes);
        let mut texels = Vec::with_capacity(width as usize * height as usize);
        for row in rows.chunks_exact(row as usize) {
            texels.extend_from_slice(cast_slice(&row[..(TEXEL_BYTES * width) as usize]));
        }
        (texels, seconds)
    })
}

/// The layout of bind group 3: stride, signal, guides, result.
fn layout(gpu: &Gpu) -> wgpu::BindGroupLayout {
    let texture = |sample_type| wgpu::BindingType::Texture {
        sample_type,
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    };
    let types = [
        wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Storage { read_only: true },
            has_dynamic_offset: false,
            min_binding_size: None,
        },
        texture(wgpu::TextureSampleType::Float { filterable: false }),
        texture(wgpu::TextureSampleType::Uint),
        wgpu::BindingType::StorageTexture {
            access: wgpu::StorageTextureAccess::WriteOnly,
            format: SIGNAL,
            view_dimension: wgpu::TextureViewDimension::D2,
        },
    ];
    let entries: Vec<_> = (3..)
        .zip(types)
        .map(|(binding, ty)| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::COMPUTE,
            ty,
            count: None,
        })
        .collect();
    gpu.device
        .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("denoise"),
            entries: &entries,
        })
}
