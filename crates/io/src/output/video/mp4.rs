//! H.264 in MP4, playable in browsers and QuickTime: constrained baseline profile, 8-bit 4:2:0, `avc1`
//! with the parameter sets in `avcC` only, the index before the frames, no edit list, and the colour
//! space given twice: in the stream (VUI) and in the file (`colr`).

use super::{Frames, Planes, VideoFormat, VideoOptions, failed};
use crate::output::OutputError;
use openh264::OpenH264API;
use openh264::encoder::{
    self as h264, Encoder, EncoderConfig, IntraFramePeriod, QpRange, RateControlMode, VuiConfig,
};
use openh264::formats::YUVSource;
use shiguredo_mp4::bitstream::h264::{
    H264NalUnitType, H264SampleEntryConfig, LengthSize, build_avc1_box, collect_nal_units,
    parse_annexb_nal_units,
};
use shiguredo_mp4::boxes::{SampleEntry, UnknownBox};
use shiguredo_mp4::mux::{
    Mp4FileMuxer, Mp4FileMuxerOptions, Sample, estimate_maximum_moov_box_size,
};
use shiguredo_mp4::{BoxSize, BoxType, TrackKind};
use std::fmt::Display;
use std::num::NonZeroU32;

/// The quantisation parameters of quality 100 and 1. OpenH264 accepts none below 12.
const FINEST_QP: u8 = 12;
const COARSEST_QP: u8 = 51;

/// Distance of key frames, to which players can seek.
const SECONDS_BETWEEN_KEYFRAMES: f64 = 2.0;

/// Code points of ITU-T H.273: BT.709's primaries and matrix, but sRGB's transfer function (13), because
/// frames are sRGB-encoded; with BT.709's (1), colour-managed players show them too bright.
const PRIMARIES: u16 = 1;
const TRANSFER: u16 = 13;
const MATRIX: u16 = 1;

/// The contents of the file.
pub(super) fn encode(mut frames: Frames, options: &VideoOptions) -> Result<Vec<u8>, OutputError> {
    let size = VideoFormat::Mp4.padded_size(frames.width, frames.height);
    let mut encoder = encoder(options).map_err(refused)?;
    let mut file = File::new(frames.count, options)?;
    for index in 0..frames.count {
        let planes = Planes::new(&frames.get(index)?, size);
        let stream = encoder.encode(&planes).map_err(refused)?.to_vec();
        file.append(&stream)?;
    }
    file.finish()
}

fn encoder(options: &VideoOptions) -> Result<Encoder, openh264::Error> {
    let rate = options.rate.as_f64();
    let keyframes = (rate * SECONDS_BETWEEN_KEYFRAMES).round().max(1.0) as u32;
    let qp = qp(options.quality);
    let vui = VuiConfig::bt709().transfer_characteristics(h264::TransferCharacteristics::Srgb);
    let config = EncoderConfig::new()
        // The only mode without skipped frames that respects the range: a constant parameter.
        .rate_control_mode(RateControlMode::Bufferbased)
        .qp(QpRange::new(qp, qp))
        .skip_frames(false)
        .max_frame_rate(h264::FrameRate::from_hz(rate as f32))
        .intra_frame_period(IntraFramePeriod::from_num_frames(keyframes))
        // These spend fewer bits on detail that camera footage would hide.
        .adaptive_quantization(false)
        .background_detection(false)
        .scene_change_detect(false)
        .num_threads(1)
        .vui(vui);
    Encoder::with_api_config(OpenH264API::from_source(), config)
}

/// Finer steps where differences are visible: the default quality is hard to distinguish from the source.
fn qp(quality: u8) -> u8 {
    let loss = f64::from(100 - quality.clamp(1, 100)) / 99.0;
    let range = f64::from(COARSEST_QP - FINEST_QP);
    FINEST_QP + (range * loss.powf(4.0 / 3.0)).round() as u8
}

impl YUVSource for Planes {
    fn dimensions(&self) -> (usize, usize) {
        (self.width, self.height)
    }

    fn strides(&self) -> (usize, usize, usize) {
        let chroma = self.width.div_ceil(2);
        (self.width, chroma, chroma)
    }

    fn y(&self) -> &[u8] {
        &self.y
    }

    fn u(&self) -> &[u8] {
        &self.u
    }

    fn v(&self) -> &[u8] {
        &self.v
    }
}

/// An MP4 file with one track, written frame by frame.
struct File {
    muxer: Mp4FileMuxer,
    bytes: Vec<u8>,
    /// Ticks per second and per frame.
    timescale: NonZeroU32,
    duration: u32,
}

impl File {
    fn new(count: usize, options: &VideoOptions) -> Result<Self, OutputError> {
        let (timescale, duration) = options.rate.parts();
        let muxer = Mp4FileMuxer::with_options(Mp4FileMuxerOptions {
            // Space is reserved for the index.
            reserved_moov_box_size: estimate_maximum_moov_box_size(&[count]),
            ..Mp4FileMuxerOptions::default()
        })
        .map_err(refused)?;
        Ok(Self {
            bytes: muxer.initial_boxes_bytes().to_vec(),
            muxer,
            timescale: NonZeroU32::new(timescale).unwrap_or(NonZeroU32::MIN),
            duration,
        })
    }

    /// Adds one frame in the encoder's format: NAL units after start codes.
    fn append(&mut self, stream: &[u8]) -> Result<(), OutputError> {
        let units = parse_annexb_nal_units(stream).map_err(refused)?;
        let keyframe = units
            .iter()
            .any(|unit| unit.nal_unit_type == H264NalUnitType::IdrSlice);
        let of = |kind| collect_nal_units(units.iter().copied(), kind);
        let owned = |units: Vec<&[u8]>| units.into_iter().map(<[u8]>::to_vec).collect::<Vec<_>>();
        let sample_entry = keyframe
            .then(|| {
                sample_entry(
                    &owned(of(H264NalUnitType::Sps)),
                    &owned(of(H264NalUnitType::Pps)),
                )
            })
            .transpose()?;

        let start = self.bytes.len();
        for unit in &units {
            if matches!(
                unit.nal_unit_type,
                H264NalUnitType::Sps | H264NalUnitType::Pps
            ) {
                continue;
            }
            let length = u32::try_from(unit.data.len()).map_err(refused)?;
            self.bytes.extend_from_slice(&length.to_be_bytes());
            self.bytes.extend_from_slice(unit.data);
        }
        let sample = Sample {
            track_kind: TrackKind::Video,
            sample_entry,
            keyframe,
            timescale: self.timescale,
            duration: self.duration,
            composition_time_offset: None,
            data_offset: start as u64,
            data_size: self.bytes.len() - start,
        };
        self.muxer.append_sample(&sample).map_err(refused)
    }

    fn finish(mut self) -> Result<Vec<u8>, OutputError> {
        let boxes = self.muxer.finalize().map_err(refused)?;
        for (offset, bytes) in boxes.offset_and_bytes_pairs() {
            let start = usize::try_from(offset).map_err(refused)?;
            let end = start + bytes.len();
            self.bytes.resize(self.bytes.len().max(end), 0);
            self.bytes[start..end].copy_from_slice(bytes);
        }
        Ok(self.bytes)
    }
}

/// The decoder configuration and the colour space.
fn sample_entry(sps: &[Vec<u8>], pps: &[Vec<u8>]) -> Result<SampleEntry, OutputError> {
    let length_size = LengthSize::FourBytes;
    let config = H264SampleEntryConfig { length_size };
    let mut entry = build_avc1_box(sps, pps, &config).map_err(refused)?;

    let box_type = BoxType::Normal(*b"colr");
    let mut payload = b"nclx".to_vec();
    for code in [PRIMARIES, TRANSFER, MATRIX] {
        payload.extend_from_slice(&code.to_be_bytes());
    }
    // Limited range.
    payload.push(0);
    entry.unknown_boxes.push(UnknownBox {
        box_type,
        box_size: BoxSize::with_payload_size(box_type, payload.len() as u64),
        payload,
    });
    Ok(SampleEntry::Avc1(entry))
}

fn refused(error: impl Display) -> OutputError {
    failed(VideoFormat::Mp4, error)
}
