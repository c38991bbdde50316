//! Rendered pictures.

use crate::errors::Failure;
use crate::host::Session;
use crate::{Files, Progress, Ran, devices, words};
use glimray_app::picture_file;
use glimray_cli::embedded;
use glimray_scene::image::Image;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::path::PathBuf;

/// Bytes of a pixel.
const PIXEL_BYTES: usize = 16;

/// A rendered picture.
#[pyclass(frozen)]
pub struct Picture(embedded::Picture);

/// Renders a picture.
#[pyfunction]
pub fn render(
    py: Python,
    arguments: Vec<PathBuf>,
    files: Files,
    progress: Progress,
) -> PyResult<(Picture, Ran)> {
    let session = Session::new(files, progress);
    let render = move |host| embedded::render(host, &words(arguments));
    let ((picture, gpu), said) = session.run(py, render)?;
    py.detach(|| devices::keep(&picture.adapter(), &gpu));
    Ok((Picture(picture), said))
}

#[pymethods]
impl Picture {
    /// Width and height in pixels.
    fn size(&self) -> (u32, u32) {
        let Image { width, height, .. } = self.0.display();
        (*width, *height)
    }

    /// Pixels of linear radiance: four floats each.
    fn linear<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let (image, _) = Session::default().run(py, |host| self.0.linear(host))?;
        Ok(bytes(py, &image.pixels))
    }

    /// Pixels of display values: four floats each.
    fn display<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        bytes(py, &self.0.display().pixels)
    }

    /// A PNG file.
    fn png<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let png = py.detach(|| self.0.png());
        let png = png.map_err(|error| Failure::App(error).raised(py))?;
        Ok(PyBytes::new(py, &png))
    }

    /// Writes a file.
    fn save(&self, py: Python, path: PathBuf, quality: u8, clobber: bool) -> PyResult<()> {
        let save = |host| self.0.save(host, &path, quality, clobber);
        Session::default().run(py, save)?;
        Ok(())
    }

    /// The channels of a layer: their names, and the floats of each.
    fn layer<'py>(
        &self,
        py: Python<'py>,
        name: &str,
    ) -> PyResult<Vec<(&'static str, Bound<'py, PyBytes>)>> {
        let (layer, _) = Session::default().run(py, |host| self.0.layer(host, name))?;
        let channels = layer.channels.iter();
        let channels = channels.map(|channel| {
            let values = PyBytes::new(py, bytemuck::cast_slice(&channel.values));
            (channel.name, values)
        });
        Ok(channels.collect())
    }

    /// Whether pixels have opacity.
    fn has_opacity(&self) -> bool {
        self.0.has_opacity()
    }
}

/// A picture to compare: its size, its pixels of four floats, whether they are radiance, and whether they have opacity.
type Compared<'a> = ((u32, u32), &'a [u8], bool, bool);

/// RMSE, PSNR in decibels, FLIP, the largest difference in levels, its column and row, and the percentage of pixels that
/// differ by more than `tolerance` levels.
#[pyfunction]
#[expect(clippy::type_complexity, reason = "a tuple of Python")]
pub fn compare(
    py: Python,
    a: Compared,
    b: Compared,
    tolerance: f64,
) -> PyResult<(f64, f64, Option<f32>, f64, [u32; 2], f64)> {
    let compared = |(size, pixels, is_float, has_alpha): Compared| {
        Ok::<_, PyErr>(picture_file::Picture {
            image: image(size, pixels)?,
            is_float,
            has_alpha,
            notes: Vec::new(),
        })
    };
    let (a, b) = (compared(a)?, compared(b)?);
    let figures = py.detach(|| embedded::compare(&a, &b, tolerance));
    let embedded::Figures {
        rmse,
        flip,
        max_levels,
        max_at,
        beyond_percent,
    } = figures;
    let psnr = figures.psnr_db();
    Ok((rmse, psnr, flip, max_levels, max_at, beyond_percent))
}

/// An image of pixels of four floats.
pub fn image((width, height): (u32, u32), pixels: &[u8]) -> PyResult<Image> {
    let (pixels, rest) = pixels.as_chunks::<PIXEL_BYTES>();
    if pixels.len() as u64 != u64::from(width) * u64::from(height) || !rest.is_empty() {
        return Err(PyValueError::new_err("pixels do not fit the size"));
    }
    Ok(Image {
        width,
        height,
        pixels: pixels
            .iter()
            .map(|pixel| bytemuck::pod_read_unaligned(pixel))
            .collect(),
    })
}

/// Pixels as bytes.
pub fn bytes<'py>(py: Python<'py>, pixels: &[[f32; 4]]) -> Bound<'py, PyBytes> {
    PyBytes::new(py, bytemuck::cast_slice(pixels))
}
