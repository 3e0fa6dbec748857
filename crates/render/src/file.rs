//! Files: pictures as PNG, films as GIF and MP4.

mod error;
mod gif;
mod limits;
mod mp4;

use std::io::{self, Write};
use std::path::Path;

use crate::picture::{Picture, Size};

pub use error::FilmError;
pub use limits::{GIF_FPS, MP4_SIDES};

/// Format of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Single picture.
    Png,
    /// Film of up to 256 colours, in all browsers and documents.
    Gif,
    /// Film as H.264 video.
    Mp4,
}

impl Format {
    /// Returns the format of a file with this extension; none for an unknown one.
    ///
    /// ```
    /// use teeter_render::Format;
    ///
    /// assert_eq!(Format::of("tower.PNG".as_ref()), Some(Format::Png));
    /// assert_eq!(Format::of("tower.jpg".as_ref()), None);
    /// ```
    pub fn of(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()?.to_lowercase().as_str() {
            "png" => Some(Self::Png),
            "gif" => Some(Self::Gif),
            "mp4" => Some(Self::Mp4),
            _ => None,
        }
    }

    /// Returns true if a file of this format shows more than one picture.
    pub fn is_film(self) -> bool {
        self != Self::Png
    }

    /// Checks that this format has pictures of a size at a frame rate, 1/s.
    ///
    /// # Errors
    /// When it has not.
    pub fn check(self, size: Size, fps: f64) -> Result<(), FilmError> {
        match self {
            Self::Png => Ok(()),
            Self::Gif if fps > GIF_FPS => Err(FilmError::FrameRate(fps)),
            Self::Gif => Ok(()),
            Self::Mp4 => mp4::check(size),
        }
    }
}

/// File to which pictures are written one after the other.
pub struct Film<W: Write>(Kind<W>);

enum Kind<W: Write> {
    Png(W),
    Gif(Box<gif::Gif<W>>),
    Mp4(Box<mp4::Mp4<W>>),
}

impl<W: Write> Film<W> {
    /// Begins a file with pictures of a size, `fps` of them a second. A PNG file has one picture.
    ///
    /// ```
    /// use teeter_render::{Film, Format, Picture, Size};
    ///
    /// let size = Size { width: 16, height: 16 };
    /// let mut film = Film::new(Format::Gif, Vec::new(), size, 10.0)?;
    /// for grey in [50, 200] {
    ///     film.add(&Picture { size, rgb: vec![grey; 16 * 16 * 3] })?;
    /// }
    /// assert!(film.finish()?.starts_with(b"GIF89a"));
    /// # Ok::<(), teeter_render::FilmError>(())
    /// ```
    ///
    /// # Errors
    /// When the format does not have such pictures, see [`Format::check`], or the encoder fails.
    pub fn new(format: Format, file: W, size: Size, fps: f64) -> Result<Self, FilmError> {
        format.check(size, fps)?;
        Ok(Self(match format {
            Format::Png => Kind::Png(file),
            Format::Gif => Kind::Gif(Box::new(gif::Gif::new(file, size, fps)?)),
            Format::Mp4 => Kind::Mp4(Box::new(mp4::Mp4::new(file, size, fps)?)),
        }))
    }

    /// Adds the next picture.
    ///
    /// # Errors
    /// When the file cannot be written or the encoder fails.
    pub fn add(&mut self, picture: &Picture) -> Result<(), FilmError> {
        match &mut self.0 {
            Kind::Png(file) => Ok(png(file, picture)?),
            Kind::Gif(film) => Ok(film.add(picture)?),
            Kind::Mp4(film) => film.add(picture),
        }
    }

    /// Writes the rest and returns the file.
    ///
    /// # Errors
    /// When the file cannot be written or the encoder fails.
    pub fn finish(self) -> Result<W, FilmError> {
        match self.0 {
            Kind::Png(file) => Ok(file),
            Kind::Gif(film) => Ok(film.finish()?),
            Kind::Mp4(film) => film.finish(),
        }
    }
}

fn png(file: &mut impl Write, picture: &Picture) -> io::Result<()> {
    let mut encoder = png::Encoder::new(file, picture.size.width, picture.size.height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&picture.rgb)?;
    writer.finish()?;
    Ok(())
}
