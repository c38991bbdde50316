//! YUV4MPEG2: a line of text, then each frame's planes after a keyword. Described at
//! <https://wiki.multimedia.cx/index.php/YUV4MPEG2>. The format cannot specify the matrix, which is
//! BT.709's here.

use super::{FrameRate, Frames, Picture8, Planes};
use crate::output::OutputError;
use std::io::{self, Write};
use std::path::Path;

/// Streams frames as Y4M to any writer, for pipes. Odd sizes are allowed: chroma is then rounded up.
pub struct Y4mWriter<W: Write> {
    writer: W,
    width: u32,
    height: u32,
}

impl<W: Write> Y4mWriter<W> {
    /// Writes the header of a video of `width` × `height` pixels.
    ///
    /// # Errors
    /// The errors of `writer`.
    pub fn new(mut writer: W, width: u32, height: u32, rate: FrameRate) -> io::Result<Self> {
        let (frames, seconds) = rate.parts();
        writeln!(
            writer,
            "YUV4MPEG2 W{width} H{height} F{frames}:{seconds} Ip A1:1 C420mpeg2 \
             XYSCSS=420MPEG2 XCOLORRANGE=LIMITED"
        )?;
        Ok(Self {
            writer,
            width,
            height,
        })
    }

    /// Writes one frame.
    ///
    /// # Errors
    /// The errors of the writer, and [`io::ErrorKind::InvalidInput`] for a frame of another size.
    pub fn write(&mut self, picture: &Picture8) -> io::Result<()> {
        let size = (self.width, self.height);
        if (picture.width, picture.height) != size {
            let (width, height) = (picture.width, picture.height);
            return Err(io::Error::new(
                io::ErrorKind::InvalidInput,
                format!("a frame has {width}×{height} pixels instead of {size:?}"),
            ));
        }
        let planes = Planes::new(picture, size);
        self.writer.write_all(b"FRAME\n")?;
        for plane in [&planes.y, &planes.u, &planes.v] {
            self.writer.write_all(plane)?;
        }
        Ok(())
    }

    /// Flushes the writer.
    ///
    /// # Errors
    /// The errors of the writer.
    pub fn finish(mut self) -> io::Result<()> {
        self.writer.flush()
    }
}

pub(super) fn encode(
    mut frames: Frames,
    rate: FrameRate,
    path: &Path,
    file: &mut dyn Write,
) -> Result<(), OutputError> {
    let failed = |source| OutputError::Io {
        path: path.into(),
        source,
    };
    let mut writer = Y4mWriter::new(file, frames.width, frames.height, rate).map_err(failed)?;
    for index in 0..frames.count {
        writer.write(&frames.get(index)?).map_err(failed)?;
    }
    writer.finish().map_err(failed)
}
