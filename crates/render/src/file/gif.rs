//! GIF films: one palette for all pictures, and of each picture only the part that changes.

use std::io::{self, Write};

use color_quant::NeuQuant;
use gif::{DisposalMethod, Encoder, EncodingError, Frame, Repeat};

use crate::picture::{Picture, Size};

/// Colours of the palette; one more index is for pixels that do not change.
const COLOURS: usize = 255;
const UNCHANGED: u8 = 255;
/// Fraction of the pixels from which the palette is made: one in so many.
const PALETTE_STEP: i32 = 3;
/// Distance of neighbouring colours that dithering bridges, of 255.
const DITHER: i32 = 6;
/// Thresholds of an ordered dither, 0 to 15 (Bayer).
const BAYER: [[i32; 4]; 4] = [[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]];

/// GIF film.
pub struct Gif<W: Write> {
    encoder: Encoder<W>,
    fps: f64,
    /// Pictures added.
    count: u32,
    /// Palette of the first picture.
    palette: Option<Palette>,
    /// Indices of the pixels on the screen.
    shown: Vec<u8>,
    /// Last frame, which is written once its duration is known.
    pending: Option<Frame<'static>>,
}

impl<W: Write> Gif<W> {
    /// Begins a film of `fps` pictures a second.
    pub fn new(file: W, size: Size, fps: f64) -> io::Result<Self> {
        let mut encoder = Encoder::new(file, side(size.width), side(size.height), &[]).map_err(failed)?;
        encoder.set_repeat(Repeat::Infinite).map_err(failed)?;
        Ok(Self { encoder, fps, count: 0, palette: None, shown: Vec::new(), pending: None })
    }

    /// Adds a picture.
    pub fn add(&mut self, picture: &Picture) -> io::Result<()> {
        let delay = self.delay();
        self.count += 1;
        let palette = self.palette.get_or_insert_with(|| Palette::new(picture));
        let indices = palette.indices(picture);
        let changed = Rectangle::of_changes(&self.shown, &indices, picture.size.width as usize);
        match (&mut self.pending, changed) {
            (Some(pending), None) => pending.delay = pending.delay.saturating_add(delay),
            (_, changed) => {
                let all =
                    Rectangle { x: 0, y: 0, width: picture.size.width as usize, height: picture.size.height as usize };
                let frame = self.frame(changed.unwrap_or(all), &indices, picture.size.width as usize, delay);
                self.flush()?;
                self.pending = Some(frame);
            }
        }
        self.shown = indices;
        Ok(())
    }

    /// Writes the rest and returns the file.
    pub fn finish(mut self) -> io::Result<W> {
        self.flush()?;
        self.encoder.into_inner().map_err(failed)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.pending.take().map_or(Ok(()), |frame| self.encoder.write_frame(&frame).map_err(failed))
    }

    /// Duration of the next picture in hundredths of a second, rounded so that errors do not add
    /// up.
    fn delay(&self) -> u16 {
        let end = |count: u32| (100.0 * f64::from(count) / self.fps).round();
        (end(self.count + 1) - end(self.count)).min(f64::from(u16::MAX)) as u16
    }

    /// Returns a frame with a part of a picture, in which pixels that are shown already are
    /// transparent.
    fn frame(&self, part: Rectangle, indices: &[u8], width: usize, delay: u16) -> Frame<'static> {
        let mut buffer = Vec::with_capacity(part.width * part.height);
        for y in part.y..part.y + part.height {
            let from = y * width + part.x;
            let row = from..from + part.width;
            match self.shown.get(row.clone()) {
                Some(shown) => {
                    let pixels = indices[row].iter().zip(shown);
                    buffer.extend(pixels.map(|(&new, &old)| if new == old { UNCHANGED } else { new }));
                }
                None => buffer.extend_from_slice(&indices[row]),
            }
        }
        Frame {
            delay,
            dispose: DisposalMethod::Keep,
            transparent: Some(UNCHANGED),
            left: side(part.x as u32),
            top: side(part.y as u32),
            width: side(part.width as u32),
            height: side(part.height as u32),
            palette: self.palette.as_ref().map(|palette| palette.colours.clone()),
            buffer: buffer.into(),
            ..Frame::default()
        }
    }
}

/// Length in a GIF file; pictures have no longer sides.
fn side(length: u32) -> u16 {
    u16::try_from(length).unwrap_or(u16::MAX)
}

fn failed(error: EncodingError) -> io::Error {
    match error {
        EncodingError::Io(error) => error,
        other => io::Error::other(other),
    }
}

/// Part of a picture, px.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Rectangle {
    x: usize,
    y: usize,
    width: usize,
    height: usize,
}

impl Rectangle {
    /// Returns the smallest one with all pixels that differ; none where none does.
    fn of_changes(old: &[u8], new: &[u8], width: usize) -> Option<Self> {
        if old.len() != new.len() {
            return Some(Self { x: 0, y: 0, width, height: new.len() / width });
        }
        let differs = |row: usize| old[row * width..][..width] != new[row * width..][..width];
        let rows = 0..new.len() / width;
        let (top, bottom) = (rows.clone().find(|&row| differs(row))?, rows.rev().find(|&row| differs(row))?);
        let column = |x: usize| (top..=bottom).any(|row| old[row * width + x] != new[row * width + x]);
        let (left, right) = ((0..width).find(|&x| column(x))?, (0..width).rev().find(|&x| column(x))?);
        Some(Self { x: left, y: top, width: right - left + 1, height: bottom - top + 1 })
    }
}

/// Colours of a film.
struct Palette {
    quantizer: NeuQuant,
    /// Red, green and blue of each index; the last one is transparent.
    colours: Vec<u8>,
    /// Index of each colour of six bits a channel, once it is found.
    found: Vec<Option<u8>>,
}

impl Palette {
    /// Returns the palette of a picture.
    fn new(picture: &Picture) -> Self {
        let rgba: Vec<u8> = picture.rgb.chunks_exact(3).flat_map(|rgb| [rgb[0], rgb[1], rgb[2], 255]).collect();
        let quantizer = NeuQuant::new(PALETTE_STEP, COLOURS, &rgba);
        let mut colours = quantizer.color_map_rgb();
        colours.extend([0; 3]);
        Self { quantizer, colours, found: vec![None; 1 << 18] }
    }

    /// Returns the index of each pixel, dithered.
    fn indices(&mut self, picture: &Picture) -> Vec<u8> {
        let width = picture.size.width as usize;
        let pixel = |(i, rgb): (usize, &[u8])| {
            let offset = (BAYER[i / width % 4][i % width % 4] * 2 - 15) * DITHER / 32;
            self.index([rgb[0], rgb[1], rgb[2]].map(|channel| (i32::from(channel) + offset).clamp(0, 255) as u8))
        };
        picture.rgb.chunks_exact(3).enumerate().map(pixel).collect()
    }

    fn index(&mut self, rgb: [u8; 3]) -> u8 {
        let [r, g, b] = rgb.map(|channel| usize::from(channel >> 2));
        let quantizer = &self.quantizer;
        // Middle of the cell, so that the first pixel in it does not matter.
        let middle = rgb.map(|channel| (channel & !3) + 2);
        *self.found[(r << 12) | (g << 6) | b]
            .get_or_insert_with(|| quantizer.index_of(&[middle[0], middle[1], middle[2], 255]) as u8)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: Size = Size { width: 20, height: 10 };

    fn picture(grey: u8) -> Picture {
        Picture { size: SIZE, rgb: vec![grey; 600] }
    }

    fn decoded(film: Vec<u8>) -> Vec<(Frame<'static>, Vec<u8>)> {
        let mut options = gif::DecodeOptions::new();
        options.set_color_output(gif::ColorOutput::RGBA);
        let mut decoder = options.read_info(film.as_slice()).unwrap();
        let mut frames = Vec::new();
        while let Some(frame) = decoder.read_next_frame().unwrap() {
            frames.push((frame.clone(), frame.buffer.to_vec()));
        }
        frames
    }

    #[test]
    fn a_film_holds_the_parts_that_change_for_their_time() {
        let mut film = Gif::new(Vec::new(), SIZE, 30.0).unwrap();
        let mut spot = picture(100);
        film.add(&spot).unwrap();
        film.add(&spot).unwrap();
        // A pixel at 7, 4.
        spot.rgb[3 * (4 * 20 + 7)..][..3].copy_from_slice(&[255, 0, 0]);
        film.add(&spot).unwrap();
        let frames = decoded(film.finish().unwrap());
        assert_eq!(frames.len(), 2);
        let (first, second) = (&frames[0].0, &frames[1].0);
        assert_eq!((first.width, first.height, first.delay), (20, 10, 7));
        assert_eq!((second.left, second.top, second.width, second.height, second.delay), (7, 4, 1, 1, 3));
    }

    #[test]
    fn colours_come_back_within_the_dither() {
        let mut film = Gif::new(Vec::new(), SIZE, 10.0).unwrap();
        let mut picture = picture(0);
        for (i, pixel) in picture.rgb.chunks_exact_mut(3).enumerate() {
            pixel.copy_from_slice(&if i % 20 < 10 { [210, 160, 100] } else { [220, 205, 185] });
        }
        film.add(&picture).unwrap();
        let (_, rgba) = decoded(film.finish().unwrap()).remove(0);
        for (rgb, shown) in picture.rgb.chunks_exact(3).zip(rgba.chunks_exact(4)) {
            let error = rgb.iter().zip(shown).map(|(&a, &b)| a.abs_diff(b)).max().unwrap();
            assert!(error <= 8, "{rgb:?} {shown:?}");
        }
    }
}
