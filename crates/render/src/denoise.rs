//! Denoises pictures by their features, on the device: `kernels/demodulate.wesl` and `kernels/denoise.wesl`.

use super::{
    Features, PixelFeatures, RenderError,
    bindings::Buffers,
    film_pass::{add_film_pass, check_memory},
    layouts::{COLOR_FORMAT, GUIDE_FORMAT, Layouts, target},
    luminance::luminance,
    opacity::straight,
    overrides, pipelines,
    policy::Storage,
    settings::RenderSettings,
};
use crate::gpu::{Gpu, GpuError, Kernel, Source, Timer, Variant};
use bytemuck::{bytes_of, cast_slice};
use glimray_scene::{image::Image, threads};
use wgpu::{BindingResource::TextureView as View, BufferUsages, TextureView};

/// The distances of pixels that the passes after the first average.
const STRIDES: [u32; 5] = [1, 2, 4, 8, 16];
/// Stands for the variance of a single sample. `scene/demodulation.wesl` has the same.
const UNKNOWN_VARIANCE: f32 = 1e31;
const TEXEL_BYTES: u32 = 16;

/// A denoised picture.
pub struct Denoised {
    /// The picture.
    pub image: Image,
    /// How long the adapter took for the passes, by its timestamps; `None` if it has none.
    pub pass_seconds: Option<f64>,
}

/// Denoises linear radiance with the features of its pixels, and opacity if these have transparency. Pixels that are not
/// finite are replaced by what is around them.
///
/// # Errors
/// The device failed, or a side exceeds the adapter's textures. With the features of a picture of another size it is
/// returned as it is.
pub async fn denoise_async(
    image: &Image,
    gpu: &Gpu,
    features: &Features,
) -> Result<Denoised, RenderError> {
    let (width, height) = (image.width, image.height);
    let is_same = features.pixels.len() == image.pixels.len() && features.width == width;
    if !is_same || image.pixels.is_empty() {
        return Ok(Denoised {
            image: image.clone(),
            pass_seconds: None,
        });
    }
    let pixels = &features.pixels;
    let has_opacity = pixels.iter().any(|pixel| pixel.transparency > 0.0);
    let pixel_bytes = Denoiser::pixel_bytes(has_opacity) + 4 * u64::from(TEXEL_BYTES);
    check_memory(width, height, pixel_bytes)?;
    let variant = match Storage::usual(gpu) {
        Storage::Image => Variant::Image,
        Storage::Buffer => Variant::Buffer,
    };
    let denoiser = Denoiser::new(gpu, variant, (width, height), has_opacity)?;
    denoiser.write(gpu, image, pixels)?;
    let Filtered {
        colors,
        covers,
        pass_seconds,
    } = denoiser.filter(gpu).await?;
    let color = |at: usize| {
        let [r, g, b, _] = colors[at];
        let opacity = (covers.as_ref()).map_or(image.pixels[at][3], |covers| covers[at][0]);
        straight([r, g, b], opacity)
    };
    Ok(Denoised {
        image: Image {
            width,
            height,
            pixels: threads::collect(pixels.len(), color),
        },
        pass_seconds,
    })
}

/// The cover of a pixel of a transparent picture.
#[derive(Clone, Copy)]
struct Cover {
    opacity: f32,
    /// Variance of the opacity, for samples which are either opaque or not: the greatest that the mean allows, where samples of the
    /// light on a catcher are alike.
    opacity_variance: f32,
    albedo: [f32; 3],
    albedo_variance: f32,
    /// Variance of the luminance.
    variance: f32,
}

impl Cover {
    /// The cover of a pixel with these features, which are means over all samples, of which only some met what covers
    /// it. Without a cover all is 0.
    fn of(features: &PixelFeatures) -> Self {
        let opacity = 1.0 - features.transparency;
        let opacity_variance = opacity * (1.0 - opacity) / (features.samples - 1.0).max(1.0);
        let [r, g, b, _] = straight(features.radiance, opacity);
        // Catchers without a shadow have an albedo and no opacity.
        let most = |albedo: f32| (albedo / opacity.max(1e-4)).min(1.0);
        let [red, green, blue] = features.albedo.map(most);
        let of_cover = |variance: f32, color: [f32; 3]| {
            let color = luminance(color.map(f64::from)) as f32;
            let own = (variance - color * color * opacity_variance).max(0.0);
            straight([own / opacity, 0.0, 0.0], opacity)[0]
        };
        Self {
            opacity,
            opacity_variance,
            albedo: [red, green, blue],
            albedo_variance: of_cover(features.albedo_variance, [red, green, blue]),
            variance: of_cover(features.variance, [r, g, b]),
        }
    }
}

/// The result of the passes over a picture.
struct Filtered {
    /// Radiance times opacity.
    colors: Vec<[f32; 4]>,
    /// Covers, whose first numbers are opacities; `None` if only colours were filtered.
    covers: Option<Vec<[f32; 4]>>,
    /// By the adapter's timestamps; `None` if it has none.
    pass_seconds: Option<f64>,
}

/// The textures of a picture that is denoised. Bindings are those of group 3 in `bindings.wesl`.
pub struct Denoiser {
    variant: Variant,
    /// Radiance times opacity, and the variance of its mean luminance; every other signal while filtering.
    noisy: TextureView,
    albedos: TextureView,
    /// Normal and depth.
    surfaces: TextureView,
    guides: TextureView,
    /// The signal at first, and the result.
    signal: TextureView,
    /// Opacity and the variance of its mean; every other one while filtering. `None` if only colours are filtered.
    covers: Option<[TextureView; 2]>,
}

impl Denoiser {
    /// Bytes of its textures for a pixel.
    pub fn pixel_bytes(has_opacity: bool) -> u64 {
        let texture_count = if has_opacity { 7 } else { 5 };
        texture_count * u64::from(TEXEL_BYTES)
    }

    /// For a picture of this width and height, with this variant of the filter. `has_opacity` tells whether opacity is
    /// filtered too.
    pub fn new(
        gpu: &Gpu,
        variant: Variant,
        (width, height): (u32, u32),
        has_opacity: bool,
    ) -> Result<Self, GpuError> {
        let texture = |format| gpu.allocate_screen(width, height, format);
        let covers = match has_opacity {
            true => Some([texture(COLOR_FORMAT)?, texture(COLOR_FORMAT)?]),
            false => None,
        };
        Ok(Self {
            covers,
            variant,
            noisy: texture(COLOR_FORMAT)?,
            albedos: texture(COLOR_FORMAT)?,
            surfaces: texture(COLOR_FORMAT)?,
            guides: texture(GUIDE_FORMAT)?,
            signal: texture(COLOR_FORMAT)?,
        })
    }

    /// Width and height in pixels.
    pub fn size(&self) -> (u32, u32) {
        let texture = self.signal.texture();
        (texture.width(), texture.height())
    }

    /// The denoised picture.
    pub fn result(&self) -> &TextureView {
        &self.signal
    }

    /// Writes a picture and its features.
    fn write(&self, gpu: &Gpu, image: &Image, pixels: &[PixelFeatures]) -> Result<(), GpuError> {
        let write = |target, texel: &(dyn Fn(usize) -> [f32; 4] + Sync)| {
            let texels = threads::collect(pixels.len(), texel);
            gpu.write_image(target, 0, cast_slice(&texels))
        };
        let finite = |number: f32| if number.is_finite() { number } else { 0.0 };
        let covers = (self.covers.as_ref())
            .map(|_| threads::collect(pixels.len(), |at| Cover::of(&pixels[at])));
        let covers = covers.as_deref();
        write(&self.noisy, &|at| {
            let ([r, g, b, opacity], features) = (image.pixels[at], &pixels[at]);
            let variance = match features.samples {
                1.0 => UNKNOWN_VARIANCE,
                _ => covers.map_or(features.variance, |covers| covers[at].variance),
            };
            [r * opacity, g * opacity, b * opacity, variance]
        })?;
        write(&self.albedos, &|at| {
            let (albedo, variance) = match covers {
                Some(covers) => (covers[at].albedo, covers[at].albedo_variance),
                None => (pixels[at].albedo, pixels[at].albedo_variance),
            };
            let [r, g, b] = albedo.map(|it| match it.is_nan() {
                true => 1.0,
                false => it.clamp(-1.0, 1.0),
            });
            [r, g, b, finite(variance).max(0.0)]
        })?;
        if let (Some([target, _]), Some(covers)) = (&self.covers, covers) {
            let cover = |at: usize| [covers[at].opacity, 0.0, 0.0, covers[at].opacity_variance];
            write(target, &cover)?;
        }
        write(&self.surfaces, &|at| {
            let [x, y, z] = pixels[at].normal.map(finite);
            [x, y, z, finite(pixels[at].depth)]
        })
    }

    /// Adds the step that reads the film in the film buffer instead of a picture, for a grid of workgroups. The dispatch
    /// parameters are those of its film tile.
    pub fn read_film(
        &self,
        gpu: &Gpu,
        (layouts, buffers): (&Layouts, &Buffers),
        settings: &RenderSettings,
        grid: (u32, u32),
        encoder: &mut wgpu::CommandEncoder,
    ) -> Result<(), GpuError> {
        let resources = [
            (11, View(&self.noisy)),
            (12, View(&self.albedos)),
            (13, View(&self.surfaces)),
        ];
        let (layout, group) = target(gpu, Variant::Buffer, &resources);
        let overrides = overrides::film_rows(settings);
        let pipeline =
            pipelines::developing(gpu, layouts, Kernel::FILM_FEATURES, &layout, overrides)?;
        let groups = [&buffers.frame_group, &buffers.film_group, &group];
        add_film_pass(encoder, &pipeline, groups, grid);
        Ok(())
    }

    /// Adds the steps from a picture to the result.
    pub fn denoise(&self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder) -> Result<(), GpuError> {
        self.add_steps(gpu, None, encoder)
    }

    fn add_steps(
        &self,
        gpu: &Gpu,
        timer: Option<&Timer>,
        encoder: &mut wgpu::CommandEncoder,
    ) -> Result<(), GpuError> {
        let covers = self.covers.as_ref();
        let mut resources = vec![
            (6, View(&self.signal)),
            (7, View(&self.noisy)),
            (8, View(&self.albedos)),
            (9, View(&self.surfaces)),
            (10, View(&self.guides)),
        ];
        resources.extend(covers.map(|[first, _]| (14, View(first))));
        let (layout, group) = target(gpu, Variant::Buffer, &resources);
        let kernel = (Kernel::DEMODULATE, Variant::Buffer);
        let overrides = overrides::HAS_OPACITY(covers.is_some());
        let pipeline = pipelines::denoising(gpu, kernel, &layout, overrides)?;
        let mut steps = vec![(pipeline, group)];
        let variant = self.variant;
        let (mut from, mut to) = (&self.signal, &self.noisy);
        let mut cover = covers.map(|[first, second]| (first, second));
        for (pass, stride) in [1].into_iter().chain(STRIDES).enumerate() {
            let modulates = pass == STRIDES.len();
            let stride = gpu.upload("stride", bytes_of(&stride))?;
            let mut resources = vec![
                (3, stride.as_entire_binding()),
                (4, View(from)),
                (5, View(&self.guides)),
                (6, View(to)),
            ];
            resources.extend(modulates.then_some((8, View(&self.albedos))));
            if let Some((from, to)) = &mut cover {
                resources.extend([(14, View(from)), (15, View(to))]);
                std::mem::swap(from, to);
            }
            let (layout, group) = target(gpu, variant, &resources);
            let overrides = [
                overrides::HAS_OPACITY(covers.is_some()),
                overrides::FIRST_PASS(pass == 0),
                overrides::MODULATES(modulates),
            ];
            let overrides = overrides.concat();
            let kernel = (Kernel::DENOISE, variant);
            let pipeline = pipelines::denoising(gpu, kernel, &layout, overrides)?;
            steps.push((pipeline, group));
            (from, to) = (to, from);
        }
        let last = steps.len() - 1;
        let (width, height) = self.size();
        for (index, (pipeline, group)) in steps.iter().enumerate() {
            let mut work = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                label: Some("denoise"),
                timestamp_writes: timer
                    .and_then(|timer| timer.writes_of(index == 0, index == last)),
            });
            work.set_pipeline(pipeline);
            work.set_bind_group(3, group, &[]);
            work.dispatch_workgroups(width.div_ceil(8), height.div_ceil(8), 1);
        }
        Ok(())
    }

    /// Runs all steps.
    async fn filter(&self, gpu: &Gpu) -> Result<Filtered, GpuError> {
        let timer = gpu.timer()?;
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        self.add_steps(gpu, Some(&timer), &mut encoder)?;
        let (colors, pass_seconds) = read(gpu, encoder, &self.signal, &timer).await?;
        let covers = match &self.covers {
            Some([first, _]) => {
                let encoder = gpu.device.create_command_encoder(&Default::default());
                Some(read(gpu, encoder, first, &timer).await?.0)
            }
            None => None,
        };
        Ok(Filtered {
            colors,
            covers,
            pass_seconds,
        })
    }
}

/// Submits the work and reads back a signal, and the time that was measured.
async fn read(
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
    .await
}
