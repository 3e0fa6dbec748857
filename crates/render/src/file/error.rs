//! Errors of films.

use std::io;

use super::limits::{GIF_FPS, MP4_SIDES};
use crate::picture::Size;

/// Film that cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum FilmError {
    /// Size that the format does not have.
    #[error("an MP4 film has sides of an even number of pixels, from 16 to {} by {}, not {size}", MP4_SIDES.0, MP4_SIDES.1, size = .0)]
    Size(Size),
    /// Frame rate that the format does not have.
    #[error("a GIF film has at most {GIF_FPS} pictures a second, not {0}")]
    FrameRate(f64),
    /// File that cannot be written.
    #[error(transparent)]
    Write(#[from] io::Error),
    /// Failure of the encoder.
    #[error("the video cannot be encoded: {0}")]
    Encoder(String),
}
