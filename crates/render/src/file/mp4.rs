//! MP4 films: H.264 video.

use std::io::Write;

use muxide::api::{Muxer, MuxerBuilder, VideoCodec};
use openh264::encoder::{
    Complexity, Encoder, EncoderConfig, FrameRate, FrameType, IntraFramePeriod, QpRange, RateControlMode, VuiConfig,
};
use openh264::formats::YUVSlices;
use openh264::{OpenH264API, Timestamp};

use super::error::FilmError;
use super::limits::{MIN_MP4_SIDE, MP4_SIDES};
use crate::picture::{Picture, Size};

/// Quantizer, the same for each picture: 0 is lossless, 51 the coarsest.
const QUANTIZER: u8 = 16;
/// Time between pictures that do not depend on others, to which players jump, s.
const INTRA_PERIOD: f64 = 2.0;

/// Checks that a film can have a size: pairs of pixels share their hue.
pub fn check(size: Size) -> Result<(), FilmError> {
    let Size { width, height } = size;
    let even = width.is_multiple_of(2) && height.is_multiple_of(2);
    let (long, short) = (width.max(height), width.min(height));
    let valid = even && short >= MIN_MP4_SIDE && long <= MP4_SIDES.0 && short <= MP4_SIDES.1;
    if valid { Ok(()) } else { Err(FilmError::Size(size)) }
}

/// MP4 film.
pub struct Mp4<W: Write> {
    encoder: Encoder,
    muxer: Muxer<W>,
    fps: f64,
    /// Pictures added.
    count: u32,
}

impl<W: Write> Mp4<W> {
    /// Begins a film of `fps` pictures a second.
    pub fn new(file: W, size: Size, fps: f64) -> Result<Self, FilmError> {
        let config = EncoderConfig::new()
            .complexity(Complexity::High)
            .max_frame_rate(FrameRate::from_hz(fps as f32))
            // The mode that takes its quantizer from the range below, and leaves out no picture.
            .rate_control_mode(RateControlMode::Bufferbased)
            .qp(QpRange::new(QUANTIZER, QUANTIZER))
            .skip_frames(false)
            .adaptive_quantization(false)
            .background_detection(false)
            .intra_frame_period(IntraFramePeriod::from_num_frames((INTRA_PERIOD * fps).ceil() as u32))
            // More threads would cut the picture into slices, and change the bytes.
            .num_threads(1)
            .vui(VuiConfig::bt709());
        let encoder = Encoder::with_api_config(OpenH264API::from_source(), config).map_err(failed)?;
        let muxer = MuxerBuilder::new(file)
            .video(VideoCodec::H264, size.width, size.height, fps)
            .with_fast_start(true)
            .build()
            .map_err(failed)?;
        Ok(Self { encoder, muxer, fps, count: 0 })
    }

    /// Adds a picture.
    pub fn add(&mut self, picture: &Picture) -> Result<(), FilmError> {
        let time = f64::from(self.count) / self.fps;
        let (stream, intra) = self.encode(picture)?;
        self.muxer.write_video(time, &stream, intra).map_err(failed)
    }

    /// Returns the next picture as H.264, and true if it depends on no other one.
    fn encode(&mut self, picture: &Picture) -> Result<(Vec<u8>, bool), FilmError> {
        let planes = Planes::new(picture);
        let time = Timestamp::from_millis((1e3 * f64::from(self.count) / self.fps) as u64);
        self.count += 1;
        let stream = self.encoder.encode_at(&planes.slices(), time).map_err(failed)?;
        Ok((stream.to_vec(), matches!(stream.frame_type(), FrameType::IDR | FrameType::I)))
    }

    /// Writes the rest and returns the file.
    pub fn finish(mut self) -> Result<W, FilmError> {
        self.muxer.finish_in_place().map_err(failed)?;
        Ok(self.muxer.into_writer())
    }
}

fn failed(error: impl std::fmt::Display) -> FilmError {
    FilmError::Encoder(error.to_string())
}

/// Luma of each pixel, and blue and red difference of each square of four (BT.709, video range).
struct Planes {
    width: usize,
    height: usize,
    luma: Vec<u8>,
    blue: Vec<u8>,
    red: Vec<u8>,
}

/// Bits after the point of the coefficients below.
const BITS: u32 = 16;
/// Coefficients of red, green and blue, times 2^16.
const LUMA: [i32; 3] = [11_966, 40_254, 4_064];
const BLUE: [i32; 3] = [-6_596, -22_189, 28_785];
const RED: [i32; 3] = [28_785, -26_145, -2_640];

impl Planes {
    fn new(picture: &Picture) -> Self {
        let (width, height) = (picture.size.width as usize, picture.size.height as usize);
        let pixel = |x: usize, y: usize| {
            let at = 3 * (y * width + x);
            [0, 1, 2].map(|k| i32::from(picture.rgb[at + k]))
        };
        let luma = (0..width * height).map(|i| scaled(LUMA, pixel(i % width, i / width), 16, 0)).collect();
        let square = |coefficients: [i32; 3]| {
            let square = |i: usize| {
                let (x, y) = (i % (width / 2) * 2, i / (width / 2) * 2);
                let corners = [pixel(x, y), pixel(x + 1, y), pixel(x, y + 1), pixel(x + 1, y + 1)];
                let sum = corners.into_iter().fold([0; 3], |sum, rgb| [0, 1, 2].map(|k| sum[k] + rgb[k]));
                scaled(coefficients, sum, 128, 2)
            };
            (0..width / 2 * (height / 2)).map(square).collect()
        };
        Self { width, height, luma, blue: square(BLUE), red: square(RED) }
    }

    fn slices(&self) -> YUVSlices<'_> {
        let half = self.width / 2;
        YUVSlices::new((&self.luma, &self.blue, &self.red), (self.width, self.height), (self.width, half, half))
    }
}

/// Weighted sum of the channels, rounded, plus an offset. `shift`: power of two by which the sum of
/// several pixels is divided.
fn scaled(coefficients: [i32; 3], rgb: [i32; 3], offset: i32, shift: u32) -> u8 {
    let bits = BITS + shift;
    let sum: i32 = coefficients.iter().zip(rgb).map(|(c, x)| c * x).sum();
    (((sum + (1 << (bits - 1))) >> bits) + offset).clamp(0, 255) as u8
}

#[cfg(test)]
mod tests {
    use openh264::decoder::Decoder;
    use openh264::formats::YUVSource;

    use super::*;

    /// White, black and the primaries have the values of the standard.
    #[test]
    fn planes_have_the_values_of_bt_709() {
        for (rgb, luma, blue, red) in [
            ([255; 3], 235, 128, 128),
            ([0; 3], 16, 128, 128),
            ([255, 0, 0], 63, 102, 240),
            ([0, 255, 0], 173, 42, 26),
            ([0, 0, 255], 32, 240, 118),
        ] {
            let picture = Picture { size: Size { width: 2, height: 2 }, rgb: [rgb; 4].concat() };
            let planes = Planes::new(&picture);
            assert_eq!((planes.luma[3], planes.blue[0], planes.red[0]), (luma, blue, red), "{rgb:?}");
        }
    }

    /// A square moves to the right; each decoded picture is the one that was encoded.
    #[test]
    fn pictures_come_back_as_they_were() {
        let size = Size { width: 96, height: 64 };
        let mut film = Mp4::new(Vec::new(), size, 30.0).unwrap();
        let mut decoder = Decoder::new().unwrap();
        for step in 0..6 {
            let wood = |i: usize| (20..40).contains(&(i / 96)) && (10 + 8 * step..30 + 8 * step).contains(&(i % 96));
            let colour = |i: usize| if wood(i) { [200, 150, 90] } else { [220, 205, 185] };
            let picture = Picture { size, rgb: (0..96 * 64).flat_map(colour).collect() };
            let (stream, intra) = film.encode(&picture).unwrap();
            assert_eq!(intra, step == 0);
            let decoded = decoder.decode(&stream).unwrap().unwrap();
            let expected = Planes::new(&picture).luma;
            let rows = decoded.y().chunks(decoded.strides().0).map(|row| &row[..96]).take(64);
            let errors = rows.flatten().zip(&expected).map(|(&a, &b)| u32::from(a.abs_diff(b)));
            assert!(errors.clone().max().unwrap() < 20 && errors.sum::<u32>() < 96 * 64, "picture {step}");
        }
    }

    /// A film of the largest and of the smallest size is encoded.
    #[test]
    fn films_of_the_largest_and_the_smallest_size_are_encoded() {
        for size in [Size { width: 2160, height: 3840 }, Size { width: 16, height: 16 }] {
            let mut film = Mp4::new(Vec::new(), size, 60.0).unwrap();
            film.add(&Picture { size, rgb: vec![90; 3 * (size.width * size.height) as usize] }).unwrap();
            assert_eq!(&film.finish().unwrap()[4..8], b"ftyp");
        }
    }

    #[test]
    fn odd_small_and_huge_sizes_are_refused() {
        for (width, height, valid) in [
            (1280, 720, true),
            (3840, 2160, true),
            (2160, 3840, true),
            (1281, 720, false),
            (14, 720, false),
            (3842, 2160, false),
            (3840, 2162, false),
        ] {
            assert_eq!(check(Size { width, height }).is_ok(), valid, "{width}x{height}");
        }
    }
}
