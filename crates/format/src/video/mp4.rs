//! MP4 files with H.264, made by openh264 (feature `video`): nothing else needs to be there.

use std::path::Path;

use mp4::{AvcConfig, Bytes, MediaConfig, Mp4Config, Mp4Sample, Mp4Writer, TrackConfig, TrackType};
use openh264::OpenH264API;
use openh264::encoder::{
    EncodedBitStream, Encoder, EncoderConfig, FrameRate, FrameType, IntraFramePeriod,
    RateControlMode,
};
use openh264::formats::{RgbSliceU8, YUVBuffer};

use super::{VideoError, VideoFile, VideoFormat};
use crate::scene_file::WholeFile;

/// Units of time per second; common rates of video divide it.
const TIME_SCALE: u32 = 90_000;
/// Pictures from one that stands alone to the next: how exactly players can be placed.
const INTRA_PERIOD: u32 = 100;
/// Of a unit in H.264: the lower bits of its first byte.
const TYPE_BITS: u8 = 0x1f;
const SEQUENCE_PARAMETERS: u8 = 7;
const PICTURE_PARAMETERS: u8 = 8;
/// Shortest side, pixels; the encoder refuses smaller pictures.
const MIN_SIDE: u32 = 16;
/// The track of the video.
const TRACK: u32 = 1;

pub(super) struct Mp4 {
    encoder: Encoder,
    /// Until the first picture tells what the track needs.
    file: Option<WholeFile>,
    writer: Option<Mp4Writer<WholeFile>>,
    format: VideoFormat,
    /// Periods of the rate so far.
    periods: u64,
}

impl Mp4 {
    pub(super) fn create(path: &Path, format: VideoFormat) -> Result<Self, VideoError> {
        let config = EncoderConfig::new()
            .max_frame_rate(FrameRate::from_hz(numbers::single(format.rate)))
            .rate_control_mode(RateControlMode::Off)
            .skip_frames(false)
            .intra_frame_period(IntraFramePeriod::from_num_frames(INTRA_PERIOD))
            // With one thread the same pictures are the same bytes.
            .num_threads(1);
        let encoder = Encoder::with_api_config(OpenH264API::from_source(), config)?;
        Ok(Self {
            encoder,
            file: Some(WholeFile::create(path)?),
            writer: None,
            format,
            periods: 0,
        })
    }

    /// Place of a period in time.
    fn time(&self, periods: u64) -> u64 {
        numbers::truncated_u64((periods as f64 * f64::from(TIME_SCALE) / self.format.rate).round())
    }
}

impl VideoFile for Mp4 {
    fn add(&mut self, picture: &[u8], periods: u64) -> Result<(), VideoError> {
        let (even, size) = even(picture, self.format.size);
        let picture = YUVBuffer::from_rgb_source(RgbSliceU8::new(&even, (size[0], size[1])));
        let stream = self.encoder.encode(&picture)?;
        let is_sync = matches!(stream.frame_type(), FrameType::IDR | FrameType::I);
        let units = Units::of(&stream);
        if let Some(file) = self.file.take() {
            self.writer = Some(begin(file, size, &units)?);
        }
        let (start, end) = (self.time(self.periods), self.time(self.periods + periods));
        self.periods += periods;
        let duration = u32::try_from(end - start).unwrap_or(u32::MAX);
        let bytes = Bytes::from(units.picture);
        let sample = Mp4Sample {
            start_time: start,
            duration,
            rendering_offset: 0,
            is_sync,
            bytes,
        };
        if let Some(writer) = &mut self.writer {
            writer.write_sample(TRACK, &sample)?;
        }
        Ok(())
    }

    fn finish(self: Box<Self>) -> Result<(), VideoError> {
        let Some(mut writer) = self.writer else {
            return Ok(());
        };
        writer.write_end()?;
        Ok(writer.into_writer().finish()?)
    }
}

/// The picture with even sides, as H.264 halves the colours, that the encoder takes: black pixels are added.
fn even(picture: &[u8], [width, height]: [u32; 2]) -> (Vec<u8>, [usize; 2]) {
    let [wide, high] = [width, height].map(|side| side.next_multiple_of(2).max(MIN_SIDE) as usize);
    let mut pixels = vec![0; wide * high * 3];
    for (from, to) in picture
        .chunks_exact(width as usize * 3)
        .zip(pixels.chunks_exact_mut(wide * 3))
    {
        to[..from.len()].copy_from_slice(from);
    }
    (pixels, [wide, high])
}

/// What the encoder made of a picture.
#[derive(Default)]
struct Units {
    sequence_parameters: Vec<u8>,
    picture_parameters: Vec<u8>,
    /// The other units, each after its length.
    picture: Vec<u8>,
}

impl Units {
    fn of(stream: &EncodedBitStream<'_>) -> Self {
        let mut units = Self::default();
        let layers = (0..stream.num_layers()).filter_map(|layer| stream.layer(layer));
        for layer in layers {
            for unit in (0..layer.nal_count()).filter_map(|unit| layer.nal_unit(unit)) {
                units.add(without_start_code(unit));
            }
        }
        units
    }

    fn add(&mut self, unit: &[u8]) {
        match unit.first().map(|first| first & TYPE_BITS) {
            Some(SEQUENCE_PARAMETERS) => self.sequence_parameters = unit.to_vec(),
            Some(PICTURE_PARAMETERS) => self.picture_parameters = unit.to_vec(),
            Some(_) => {
                self.picture
                    .extend(numbers::count_u32(unit.len()).to_be_bytes());
                self.picture.extend(unit);
            }
            None => {}
        }
    }
}

fn without_start_code(unit: &[u8]) -> &[u8] {
    let zeros = unit.iter().take_while(|byte| **byte == 0).count();
    unit.get(zeros + 1..).unwrap_or_default()
}

fn begin(
    file: WholeFile,
    size: [usize; 2],
    units: &Units,
) -> Result<Mp4Writer<WholeFile>, VideoError> {
    let brands = [*b"isom", *b"iso2", *b"avc1", *b"mp41"]
        .map(Into::into)
        .to_vec();
    let config = Mp4Config {
        major_brand: (*b"isom").into(),
        minor_version: 512,
        compatible_brands: brands,
        timescale: TIME_SCALE,
    };
    let mut writer = Mp4Writer::write_start(file, &config)?;
    let [width, height] = size.map(|side| u16::try_from(side).unwrap_or(u16::MAX));
    writer.add_track(&TrackConfig {
        track_type: TrackType::Video,
        timescale: TIME_SCALE,
        language: "und".into(),
        media_conf: MediaConfig::AvcConfig(AvcConfig {
            width,
            height,
            seq_param_set: units.sequence_parameters.clone(),
            pic_param_set: units.picture_parameters.clone(),
        }),
    })?;
    Ok(writer)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_reader_finds_the_pictures_with_their_times() {
        let folder = tempfile::tempdir().unwrap();
        let write = |name: &str| {
            let path = folder.path().join(name);
            let mut video = Mp4::create(
                &path,
                VideoFormat {
                    size: [35, 21],
                    rate: 20.0,
                },
            )
            .unwrap();
            for (shade, periods) in [(0, 1), (90, 3), (200, 2)] {
                video.add(&[shade; 35 * 21 * 3], periods).unwrap();
            }
            Box::new(video).finish().unwrap();
            std::fs::read(path).unwrap()
        };
        let bytes = write("a.mp4");
        assert_eq!(bytes, write("b.mp4"));
        let mut reader =
            mp4::Mp4Reader::read_header(std::io::Cursor::new(&bytes), bytes.len() as u64).unwrap();
        let track = &reader.tracks()[&TRACK];
        assert_eq!(
            (track.width(), track.height(), track.sample_count()),
            (36, 22, 3)
        );
        let starts: Vec<u64> = (1..=3)
            .map(|n| reader.read_sample(TRACK, n).unwrap().unwrap().start_time)
            .collect();
        assert_eq!(starts, [0, 4500, 18_000]);
        assert_eq!(reader.tracks()[&TRACK].duration().as_millis(), 300);
    }

    #[test]
    fn pictures_get_even_sides() {
        let (pixels, size) = even(&[7; 17 * 3], [17, 1]);
        assert_eq!(size, [18, 16]);
        assert!(pixels[..17 * 3].iter().all(|byte| *byte == 7));
        assert!(pixels.len() == 18 * 16 * 3 && pixels[17 * 3..].iter().all(|byte| *byte == 0));
    }
}
